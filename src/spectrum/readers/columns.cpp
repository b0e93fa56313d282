#include "base/text.h"
#include "spectrum/readers/lines.h"

namespace spectrad {

static std::vector<std::string> toStrings(const std::vector<std::string_view>& pieces) {
    std::vector<std::string> result;
    for (std::string_view piece : pieces)
        if (!piece.empty()) result.emplace_back(piece);
    return result;
}

/// Names of the columns: separated as the numbers are, unless tabs separate names that hold blanks ("Patch
/// 7").
static std::vector<std::string> headerOf(std::string_view line) {
    return toStrings(line.find('\t') != std::string_view::npos ? split(line, '\t') : words(line));
}

SpectrumTable readColumns(std::string_view text, const std::string& file) {
    TextLines lines = linesOf(text, file);
    TableRows rows(lines, file);
    bool first = true;
    for (const TextLine& line : lines.rows) {
        const std::string_view content = std::string_view(line.text).substr(0, line.text.find('#'));
        std::vector<std::string> cells = toStrings(words(content));
        if (first && !looksNumeric(cells.front(), true))
            rows.setHeader(headerOf(content), line.number);
        else
            rows.add(cells, line.number, true);
        first = false;
    }
    return rows.finish();
}

}  // namespace spectrad
