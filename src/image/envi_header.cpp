#include "image/envi_header.h"

#include "base/text.h"
#include "image/channel_names.h"
#include "image/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad::envi {

namespace {

/// The next line of `text`, without its end.
std::string_view takeLine(std::string_view& text) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

struct UnitName {
    std::string_view name;    ///< in lower case
    std::string_view suffix;  ///< of a wave
};
constexpr std::array<UnitName, 20> unitNames{{{"nanometers", "nm"},
                                              {"nanometer", "nm"},
                                              {"nanometres", "nm"},
                                              {"nm", "nm"},
                                              {"micrometers", "um"},
                                              {"micrometer", "um"},
                                              {"microns", "um"},
                                              {"micron", "um"},
                                              {"um", "um"},
                                              {"millimeters", "mm"},
                                              {"millimeter", "mm"},
                                              {"mm", "mm"},
                                              {"centimeters", "cm"},
                                              {"centimeter", "cm"},
                                              {"cm", "cm"},
                                              {"meters", "m"},
                                              {"m", "m"},
                                              {"mhz", "MHz"},
                                              {"ghz", "GHz"},
                                              {"thz", "THz"}}};

constexpr std::array<std::string_view, 2> angstroms{"angstroms", "angstrom"};
constexpr std::array<std::string_view, 4> wavenumbers{"wavenumber", "wavenumbers", "cm-1", "cm^-1"};

template <size_t N>
bool isAmong(const std::array<std::string_view, N>& names, std::string_view unit) {
    return std::find(names.begin(), names.end(), unit) != names.end();
}

/// Nothing for what is no number, or in no unit that is known.
std::optional<double> inNm(std::string_view number, std::string_view unit) {
    if (isAmong(angstroms, unit)) {
        const auto value = parseDouble(number);
        return value ? std::optional(*value / 10) : std::nullopt;
    }
    if (isAmong(wavenumbers, unit)) {
        const auto value = parseDouble(number);
        return value && *value > 0 ? std::optional(1e7 / *value) : std::nullopt;
    }
    const auto known =
        std::find_if(unitNames.begin(), unitNames.end(), [&](auto& u) { return u.name == unit; });
    if (known == unitNames.end()) return std::nullopt;
    return parseWave(std::string(number).append(known->suffix), '.');
}

bool isKnownUnit(std::string_view unit) {
    return inNm("1", unit).has_value();
}

}  // namespace

Header Header::parse(std::string_view text, const std::filesystem::path& file) {
    Header header;
    header.file_ = file.string();
    if (startsWith(text, "\xef\xbb\xbf")) text.remove_prefix(3);  // a byte order mark
    int line = 1;
    if (trimmed(takeLine(text)) != "ENVI")
        throw InputError({header.file_, 1}, "an ENVI header begins with the line 'ENVI'");
    while (!text.empty()) {
        std::string_view content = takeLine(text);
        const SourceLocation where{header.file_, ++line};
        if (startsWith(content, ";") || trimmed(content).empty()) continue;
        const size_t equals = content.find('=');
        if (equals == std::string_view::npos || trimmed(content.substr(0, equals)).empty())
            throw InputError(where, "neither 'key = value' nor a comment");
        Field field{std::string(trimmed(content.substr(0, equals))),
                    std::string(trimmed(content.substr(equals + 1))), line};
        if (header.find(field.key)) throw InputError(where, "'" + printable(field.key) + "' is given twice");
        if (startsWith(field.value, "{")) {
            while (field.value.find('}') == std::string::npos) {
                if (text.empty())
                    throw InputError(where,
                                     "the list of '" + printable(field.key) + "' is not closed by '}'");
                field.value += '\n';
                field.value += takeLine(text);
                ++line;
            }
            field.value.erase(field.value.find('}'));
            field.value = trimmed(std::string_view(field.value).substr(1));
        }
        header.fields_.push_back(std::move(field));
    }
    return header;
}

const Field* Header::find(std::string_view key) const {
    const std::string wanted = lowerCase(key);
    for (const Field& field : fields_)
        if (lowerCase(field.key) == wanted) return &field;
    return nullptr;
}

long long Header::integer(std::string_view key, long long least, long long most,
                          std::optional<long long> otherwise) const {
    const Field* field = find(key);
    if (!field && otherwise) return *otherwise;
    if (!field) throw InputError({file_}, fmt::format("'{}' is missing", key));
    const auto value = parseInteger(field->value);
    if (!value || *value < least || *value > most)
        throw InputError(where(*field), fmt::format("{} is '{}' (allowed: {} to {})", key,
                                                    printable(field->value), least, most));
    return *value;
}

std::optional<double> Header::number(std::string_view key) const {
    const Field* field = find(key);
    if (!field) return std::nullopt;
    const auto value = parseDouble(field->value);
    if (!value)
        throw InputError(where(*field),
                         fmt::format("{} is '{}' (allowed: a number)", key, printable(field->value)));
    return value;
}

std::vector<double> Header::numbers(std::string_view key, size_t count) const {
    const Field* field = find(key);
    std::vector<double> values;
    if (!field) return values;
    for (std::string_view item : split(field->value, ',')) {
        const auto value = parseDouble(item);
        if (!value)
            throw InputError(where(*field),
                             fmt::format("'{}' in {} (allowed: numbers)", printable(item), key));
        values.push_back(*value);
    }
    if (values.size() != count)
        throw InputError(where(*field),
                         fmt::format("{} has {} numbers for {} bands", key, values.size(), count));
    return values;
}

std::vector<double> wavelengthsNm(const Header& header, size_t bands, Notes& notes) {
    const Field* list = header.find("wavelength");
    if (!list)
        throw InputError(SourceLocation{header.where({}).file}, "has no wavelengths ('wavelength = {…}')");
    const Field* units = header.find("wavelength units");
    std::string unit = units ? lowerCase(units->value) : "unknown";
    const bool stated = unit != "unknown" && !unit.empty();
    if (stated && !isKnownUnit(unit))
        throw InputError(header.where(*units),
                         fmt::format("wavelength units '{}' (allowed: Nanometers, Micrometers, Millimeters, "
                                     "Centimeters, Meters, Angstroms, Wavenumber, MHz, GHz, THz)",
                                     printable(units->value)));
    if (!stated) unit = "nm";
    std::vector<double> nm;
    for (std::string_view item : split(list->value, ',')) {
        const auto value = inNm(item, unit);
        if (!value || !std::isfinite(*value) || *value <= 0)
            throw InputError(header.where(*list),
                             fmt::format("'{}' is no wavelength above 0", printable(item)));
        constexpr double likelyMicrometres = 100;
        if (!stated && *value < likelyMicrometres)
            throw InputError(header.where(*list),
                             fmt::format("'wavelength units' are missing, and {} may well be micrometres: "
                                         "add 'wavelength units = Micrometers' or Nanometers",
                                         printable(item)));
        nm.push_back(*value);
    }
    if (nm.size() != bands)
        throw InputError(header.where(*list), fmt::format("{} wavelengths for {} bands", nm.size(), bands));
    if (!stated) notes.warn(header.where(*list), "no wavelength units; read as nanometres");
    return nm;
}

std::string encoded(std::string_view text) {
    std::string ascii;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool atEnd = i == 0 || i + 1 == text.size();
        const bool plain = c > ' ' && c <= '~' && c != '{' && c != '}' && c != '%' && c != '=';
        ascii += plain || (c == ' ' && !atEnd) ? std::string(1, c)
                                               : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return ascii;
}

std::string decoded(std::string_view text) {
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = high >= 0 ? hexDigit(text[i + 2]) : -1;
        if (low >= 0) i += 2;
        plain += low >= 0 ? static_cast<char>(high * 16 + low) : text[i];
    }
    return plain;
}

}  // namespace spectrad::envi
