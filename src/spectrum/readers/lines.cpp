#include "spectrum/readers/lines.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace spectrad {

namespace {

bool isUtf8(std::string_view text) {
    for (size_t at = 0; at < text.size();) {
        const size_t length = utf8Length(text, at);
        if (length == 0) return false;
        at += length;
    }
    return true;
}

std::string latin1ToUtf8(std::string_view text) {
    std::string result;
    result.reserve(text.size() + text.size() / 8);
    for (char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            result += c;
        } else {
            result += static_cast<char>(0xc0 | (byte >> 6));
            result += static_cast<char>(0x80 | (byte & 0x3f));
        }
    }
    return result;
}

void readHead(std::string_view comment, std::map<std::string, std::string>& head) {
    const size_t colon = comment.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view key = trimmed(comment.substr(0, colon)),
                           value = trimmed(comment.substr(colon + 1));
    if (!key.empty() && !value.empty()) head.emplace(key, value);
}

bool contains(const std::string& text, std::string_view piece) {
    return text.find(piece) != std::string::npos;
}

/// The unit that the header gives to the wavelengths where it is not nanometres; "" if it may be.
std::string_view foreignUnit(const std::string& name) {
    const std::string text = lowerCase(name);
    if (contains(text, "nm") || contains(text, "nano")) return "";
    if (contains(text, "um") && !contains(text, "num")) return "um";
    if (contains(text, "µm") || contains(text, "μm") || contains(text, "micro")) return "um";
    if (contains(text, "cm-1") || contains(text, "cm^-1") || contains(text, "wavenumber")) return "1/cm";
    if (contains(text, "angstrom") || contains(text, "ångstr")) return "angstrom";
    if (contains(text, "(ev)") || contains(text, "[ev]") || contains(text, "_ev")) return "eV";
    return "";
}

}  // namespace

TextLines linesOf(std::string_view text, const std::string& file) {
    if (startsWith(text, "\xff\xfe") || startsWith(text, "\xfe\xff"))
        throw InputError({file}, "is UTF-16 text; save it as UTF-8");
    if (text.find('\0') != std::string_view::npos)
        throw InputError({file}, "is a binary file, not a text file of spectra");
    if (startsWith(text, "\xef\xbb\xbf")) text.remove_prefix(3);
    const std::string converted = isUtf8(text) ? std::string(text) : latin1ToUtf8(text);

    TextLines result;
    int number = 0;
    for (std::string_view rest = converted; !rest.empty();) {
        ++number;
        const size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
        const std::string_view line = rest.substr(0, end);
        const bool two = end + 1 < rest.size() && rest[end] == '\r' && rest[end + 1] == '\n';
        rest.remove_prefix(std::min(rest.size(), end + (two ? 2 : 1)));
        const std::string_view content = trimmed(line);
        if (content.empty()) continue;
        if (content.front() == '#')
            readHead(content.substr(1), result.head);
        else
            result.rows.push_back({number, std::string(line)});
    }
    return result;
}

std::string withDecimalPoint(std::string cell) {
    if (std::count(cell.begin(), cell.end(), ',') == 1 && !contains(cell, "."))
        std::replace(cell.begin(), cell.end(), ',', '.');
    return cell;
}

static bool isNotFinite(const std::string& cell) {
    static constexpr std::array<std::string_view, 6> words{"nan",  "inf",   "infinity",
                                                           "#n/a", "#num!", "#div/0!"};
    std::string text = lowerCase(cell);
    if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.erase(0, 1);
    return std::find(words.begin(), words.end(), text) != words.end();
}

bool looksNumeric(const std::string& cell, bool decimalComma) {
    return parseDouble(decimalComma ? withDecimalPoint(cell) : cell).has_value() || isNotFinite(cell);
}

TableRows::TableRows(TextLines& lines, std::string file) : file_(std::move(file)) {
    table_.head = std::move(lines.head);
}

void TableRows::setHeader(std::vector<std::string> names, int line) {
    names_ = std::move(names);
    if (names_.size() < 2)
        throw InputError(
            {file_, line},
            fmt::format("the header names one column, '{}' (a spectrum needs wavelengths and values)",
                        names_.empty() ? "" : names_.front()));
    if (const auto unit = foreignUnit(names_.front()); !unit.empty())
        throw InputError(
            {file_, line},
            fmt::format("the first column '{}' is in {} (allowed: wavelengths in nm)", names_.front(), unit));
}

std::string TableRows::columnName(size_t column) const {
    const std::string name = column < names_.size() ? names_[column] : "";
    return name.empty() ? fmt::format("column {}", column + 1)
                        : fmt::format("column {} ('{}')", column + 1, name);
}

double TableRows::number(std::string cell, size_t column, int line, bool decimalComma) const {
    if (decimalComma) cell = withDecimalPoint(cell);
    if (cell.empty()) throw InputError({file_, line}, columnName(column) + " is empty");
    if (isNotFinite(cell))
        throw InputError({file_, line},
                         fmt::format("{} is '{}', not a finite number", columnName(column), cell));
    const auto value = parseDouble(cell);
    if (!value)
        throw InputError({file_, line}, fmt::format("{} is '{}', not a number", columnName(column), cell));
    return *value;
}

void TableRows::add(const std::vector<std::string>& cells, int line, bool decimalComma) {
    const size_t columns = !names_.empty() ? names_.size()
                           : rows_.empty() ? cells.size()
                                           : rows_.front().numbers.size();
    if (cells.size() < 2)
        throw InputError({file_, line},
                         "has one value (a spectrum needs a wavelength and a value in every row)");
    if (cells.size() != columns)
        throw InputError({file_, line},
                         fmt::format("has {} values where the rows above have {}", cells.size(), columns));
    Row row{line, {}};
    for (size_t c = 0; c < columns; ++c)
        row.numbers.push_back(number(cells[c], c, line, decimalComma));
    if (!(row.numbers.front() > 0))
        throw InputError({file_, line},
                         fmt::format("wavelength {} nm (allowed: above 0)", shortest(row.numbers.front())));
    rows_.push_back(std::move(row));
}

SpectrumTable TableRows::finish() {
    if (rows_.empty()) throw InputError({file_}, "holds no rows of numbers");
    std::stable_sort(rows_.begin(), rows_.end(),
                     [](const Row& a, const Row& b) { return a.numbers.front() < b.numbers.front(); });
    for (size_t i = 1; i < rows_.size(); ++i)
        if (rows_[i].numbers.front() == rows_[i - 1].numbers.front())
            throw InputError({file_, rows_[i].line},
                             fmt::format("{} nm stands in line {} already",
                                         shortest(rows_[i].numbers.front()), rows_[i - 1].line));
    // No spectrum of light ends below 10 nm; micrometres do.
    const double first = rows_.front().numbers.front(), last = rows_.back().numbers.front();
    if (last < 10)
        throw InputError({file_},
                         fmt::format("wavelengths from {} to {}: these look like micrometres (allowed: nm)",
                                     shortest(first), shortest(last)));
    const size_t columns = rows_.front().numbers.size();
    for (size_t c = 1; c < columns; ++c) {
        const std::string name = c < names_.size() ? names_[c] : "";
        table_.header.push_back(name.empty() ? fmt::format("column {}", c + 1) : name);
        std::vector<double>& column = table_.columns.emplace_back();
        for (const Row& row : rows_)
            column.push_back(row.numbers[c]);
    }
    for (const Row& row : rows_)
        table_.nm.push_back(row.numbers.front());
    return std::move(table_);
}

}  // namespace spectrad
