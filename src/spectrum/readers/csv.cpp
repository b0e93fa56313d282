#include "base/text.h"
#include "spectrum/readers/lines.h"

#include <algorithm>

namespace spectrad {

/// Cells of one line, trimmed; a cell in double quotes may hold separators, and "" for a quote.
static std::vector<std::string> cellsOf(std::string_view line, char separator) {
    std::vector<std::string> cells;
    std::string cell;
    bool quoted = false, wasQuoted = false;
    const auto close = [&] {
        cells.emplace_back(wasQuoted ? std::string_view(cell) : trimmed(cell));
        cell.clear();
        wasQuoted = false;
    };
    for (size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted) {
            if (c != '"')
                cell += c;
            else if (i + 1 < line.size() && line[i + 1] == '"')
                cell += line[++i];
            else
                quoted = false;
        } else if (c == '"' && trimmed(cell).empty() && !wasQuoted) {
            cell.clear();
            quoted = wasQuoted = true;
        } else if (c == separator) {
            close();
        } else if (!wasQuoted || trimmed(std::string_view(&c, 1)).size() == 1) {
            cell += c;
        }
    }
    close();
    return cells;
}

SpectrumTable readCsv(std::string_view text, const std::string& file) {
    TextLines lines = linesOf(text, file);
    TableRows rows(lines, file);
    // Where a semicolon separates, a comma is a decimal comma: what spreadsheets write in half of Europe.
    const bool semicolons = std::any_of(lines.rows.begin(), lines.rows.end(), [](const TextLine& line) {
        return line.text.find(';') != std::string::npos;
    });
    size_t width = 0;
    bool first = true;
    for (const TextLine& line : lines.rows) {
        std::vector<std::string> cells = cellsOf(line.text, semicolons ? ';' : ',');
        if (first) {
            // Spreadsheets end lines with separators of empty columns; a column counts as far as the first
            // line goes.
            while (!cells.empty() && cells.back().empty())
                cells.pop_back();
            width = cells.size();
        } else {
            while (cells.size() > width && cells.back().empty())
                cells.pop_back();
        }
        if (first && !looksNumeric(cells.empty() ? "" : cells.front(), semicolons))
            rows.setHeader(std::move(cells), line.number);
        else
            rows.add(cells, line.number, semicolons);
        first = false;
    }
    return rows.finish();
}

}  // namespace spectrad
