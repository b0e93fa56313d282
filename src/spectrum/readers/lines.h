// What the readers of text files share: lines whatever their ends and encoding, and rows that become a table.
#pragma once

#include "spectrum/readers/reader.h"

#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

struct TextLine {
    int number;  ///< from 1
    std::string text;
};

struct TextLines {
    std::map<std::string, std::string> head;  ///< "# key: value"; of a key's several values the first
    std::vector<TextLine> rows;               ///< neither blank nor a comment
};

/// Takes UTF-8 with or without byte-order mark, or Latin-1 (made UTF-8); lines end in LF, CR LF or CR. Throws
/// InputError for UTF-16 and for bytes of 0.
[[nodiscard]] TextLines linesOf(std::string_view text, const std::string& file);

/// Collects rows of cells into a table: checks every number, sorts by wavelength, refuses duplicates.
class TableRows {
  public:
    TableRows(TextLines& lines, std::string file);
    /// `names`: of all columns, the wavelength's first; none for a file without a header line.
    void setHeader(std::vector<std::string> names, int line);
    /// Cells of one row; `decimalComma` reads "0,5" as 0.5.
    void add(const std::vector<std::string>& cells, int line, bool decimalComma);
    [[nodiscard]] SpectrumTable finish();

  private:
    struct Row {
        int line;
        std::vector<double> numbers;
    };
    [[nodiscard]] std::string columnName(size_t column) const;
    [[nodiscard]] double number(std::string cell, size_t column, int line, bool decimalComma) const;

    std::string file_;
    SpectrumTable table_;
    std::vector<std::string> names_;
    std::vector<Row> rows_;
};

/// "0,5" as "0.5"; a cell with a point already, or several commas, stays as it is.
[[nodiscard]] std::string withDecimalPoint(std::string cell);
/// Whether a cell is a number, be it nan or inf: where a file's header ends.
[[nodiscard]] bool looksNumeric(const std::string& cell, bool decimalComma);

}  // namespace spectrad
