#include "image/channel_names.h"

#include "base/text.h"
#include "image/exr_limits.h"
#include "spectrum/si.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace spectrad {

namespace {

struct Prefix {
    std::string_view text;
    int exponent;
};
// f, a, z, y are not in the layout's table; they do no harm in reading.
constexpr std::array<Prefix, 20> prefixes{{{"Y", 24},  {"Z", 21},  {"E", 18},  {"P", 15},  {"T", 12},
                                           {"G", 9},   {"M", 6},   {"k", 3},   {"h", 2},   {"da", 1},
                                           {"d", -1},  {"c", -2},  {"m", -3},  {"u", -6},  {"n", -9},
                                           {"p", -12}, {"f", -15}, {"a", -18}, {"z", -21}, {"y", -24}}};

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Takes digits from the front of `text`.
std::string_view takeDigits(std::string_view& text) {
    const auto end = std::find_if_not(text.begin(), text.end(), isDigit);
    const std::string_view digits = text.substr(0, static_cast<size_t>(end - text.begin()));
    text.remove_prefix(digits.size());
    return digits;
}

/// mantissa · 10^exponent, rounded once: a prefix must not cost a digit ("S0.0,50000um" is exactly 500 nm).
double scaled(const std::string& mantissa, long long exponent) {
    return parseDouble(mantissa + "e" + std::to_string(exponent))
        .value_or(std::numeric_limits<double>::infinity());
}

/// The power of ten of a wave's unit in metres or hertz, or nothing.
std::optional<int> unitExponent(std::string_view unit, std::string_view base) {
    if (!unit.ends_with(base)) return std::nullopt;
    const std::string_view prefix = unit.substr(0, unit.size() - base.size());
    if (prefix.empty()) return 0;
    const auto known =
        std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& p) { return p.text == prefix; });
    if (known == prefixes.end()) return std::nullopt;
    return known->exponent;
}

}  // namespace

std::optional<double> parseWave(std::string_view text, char decimalMark) {
    const std::string_view whole = takeDigits(text);
    std::string_view fraction;
    if (text.starts_with(decimalMark)) {
        text.remove_prefix(1);
        fraction = takeDigits(text);
    }
    if (whole.empty() && fraction.empty()) return std::nullopt;
    const std::string mantissa =
        fmt::format("{}.{}", whole.empty() ? "0" : whole, fraction.empty() ? "0" : fraction);

    long long exponent = 0;
    if (text.starts_with('e') || text.starts_with('E')) {  // else an E is the prefix exa
        std::string_view rest = text.substr(1);
        const bool negative = rest.starts_with('-');
        if (negative || rest.starts_with('+')) rest.remove_prefix(1);
        if (const std::string_view digits = takeDigits(rest); !digits.empty()) {
            // An exponent of more than nine digits is as good as one of nine.
            exponent = parseInteger(digits).value_or(999999999);
            exponent = std::min<long long>(exponent, 999999999) * (negative ? -1 : 1);
            text = rest;
        }
    }
    if (const auto metres = unitExponent(text, "m")) return scaled(mantissa, exponent + *metres + 9);
    if (const auto hertz = unitExponent(text, "Hz"))
        return speedOfLight / scaled(mantissa, exponent + *hertz) * 1e9;
    return std::nullopt;
}

std::optional<SpectralChannel> parseChannelName(std::string_view name) {
    SpectralChannel channel;
    if (name.size() > 3 && name[0] == 'S' && name[1] >= '0' && name[1] <= '3' && name[2] == '.') {
        const auto nm = parseWave(name.substr(3), ',');
        if (!nm) return std::nullopt;
        channel.stokes = name[1] - '0';
        channel.nm = *nm;
        return channel;
    }
    if (!startsWith(name, "T.")) return std::nullopt;
    name.remove_prefix(2);
    const size_t dot = name.find('.');
    const auto nm = parseWave(name.substr(0, dot), ',');
    if (!nm) return std::nullopt;
    channel.kind = SpectralChannel::Kind::reflective;
    channel.nm = *nm;
    if (dot == std::string_view::npos) return channel;
    const auto emitted = parseWave(name.substr(dot + 1), ',');
    if (!emitted) return std::nullopt;
    channel.kind = SpectralChannel::Kind::reradiation;
    channel.emittedNm = *emitted;
    return channel;
}

std::vector<std::string> bandNames(const Wavelengths& grid, CubeKind kind) {
    const bool emissive = kind == CubeKind::radiance || kind == CubeKind::irradiance;
    const int decimals = decimalsToTellApart(grid);
    const size_t width = fmt::format("{:.{}f}", grid.nm.back(), decimals).size();
    std::vector<std::string> names;
    names.reserve(grid.size());
    for (double nm : grid.nm) {
        std::string number = fmt::format("{:0{}.{}f}", nm, width, decimals);
        std::replace(number.begin(), number.end(), '.', ',');  // a dot separates EXR's layers
        names.push_back((emissive ? "S0." : "T.") + number + "nm");
        if (names.back().size() > longestName ||
            (names.size() > 1 && names.back() <= names[names.size() - 2]))
            throw InputError(fmt::format(
                "wavelengths {} and {} nm are too close for the {} bytes of a channel's name",
                shortest(grid.nm[names.size() < 2 ? 0 : names.size() - 2]), shortest(nm), longestName));
    }
    return names;
}

}  // namespace spectrad
