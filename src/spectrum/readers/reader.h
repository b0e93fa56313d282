// Files of spectra. One small file a format beside this one; readTable() picks by content and extension.
#pragma once

#include "spectrum/spectrum.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// A file of curves over one wavelength column: columns[c][row] belongs to header[c]; nm ascending, all
/// values finite.
struct SpectrumTable {
    std::map<std::string, std::string> head;  ///< "# key: value" lines
    std::vector<std::string> header;          ///< names of the value columns (without the wavelength's)
    std::vector<double> nm;
    std::vector<std::vector<double>> columns;
};

/// Comma- or semicolon-separated values, with or without a header line; first column is the wavelength in nm.
/// `file` names the source in errors ("file:line: …").
[[nodiscard]] SpectrumTable readCsv(std::string_view text, const std::string& file);
/// Two (or more) columns separated by blanks or tabs, '#' comments: .spd and .txt.
[[nodiscard]] SpectrumTable readColumns(std::string_view text, const std::string& file);
/// "400:0.1 500:0.25 …" — pairs nm:value.
[[nodiscard]] SpectrumTable readPairs(std::string_view text, const SourceLocation& where);

/// Reads a file by what it is. Throws InputError.
[[nodiscard]] SpectrumTable readTable(const std::filesystem::path& path);

}  // namespace spectrad
