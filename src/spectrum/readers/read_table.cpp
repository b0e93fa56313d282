#include "base/files.h"
#include "base/text.h"
#include "spectrum/readers/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace spectrad {

namespace {

constexpr std::uintmax_t sizeLimit = 1u << 28;  // bytes; a spectrum of a million rows has a tenth of it
constexpr std::string_view formats = "(allowed: text of comma-separated values or columns: .csv, .spd, .txt)";

struct Magic {
    std::string_view start, name;
};
constexpr std::array<Magic, 9> magics{{{"\x76\x2f\x31\x01", "an OpenEXR image"},
                                       {"\x89PNG", "a PNG image"},
                                       {"\xff\xd8\xff", "a JPEG image"},
                                       {"%PDF", "a PDF document"},
                                       {"PK\x03\x04", "a zip archive or spreadsheet"},
                                       {"\xd0\xcf\x11\xe0", "a spreadsheet"},
                                       {"\x89HDF", "an HDF5 file"},
                                       {"<", "XML or HTML"},
                                       {"{", "JSON"}}};

void refuseOtherFormats(std::string_view text, const std::string& file) {
    for (const Magic& magic : magics)
        if (startsWith(text, magic.start))
            throw InputError({file}, fmt::format("is {}, not a table of spectra {}", magic.name, formats));
    if (text.find('\0') != std::string_view::npos && !startsWith(text, "\xff\xfe") &&
        !startsWith(text, "\xfe\xff"))
        throw InputError({file}, fmt::format("is a binary file {}", formats));
}

/// Whether separators cut the lines: a semicolon, or a comma that is not between the digits of one number
/// ("400 0,5").
bool isSeparated(const std::string& line) {
    if (line.find(';') != std::string::npos) return true;
    if (line.find(',') == std::string::npos) return false;
    const auto cells = words(line);
    const bool columns =
        cells.size() > 1 && std::all_of(cells.begin(), cells.end(), [](std::string_view cell) {
            return looksNumeric(std::string(cell), true);
        });
    return !columns;
}

}  // namespace

SpectrumTable readTable(const std::filesystem::path& path) {
    const std::string text = readFile(path, sizeLimit), file = path.string();
    refuseOtherFormats(text, file);
    const TextLines lines = linesOf(text, file);
    if (lines.rows.empty()) throw InputError({file}, "holds no rows of numbers");
    // The last line: a header may have commas or blanks in its names, numbers have only what separates them.
    const std::string& row = lines.rows.back().text;
    if (isSeparated(row)) return readCsv(text, file);
    const auto cells = words(row);
    if (cells.size() > 1 && looksNumeric(std::string(cells.front()), true)) return readColumns(text, file);
    // Neither: the extension says what it should have been, so that the reader can say what is wrong with
    // which line.
    const std::string extension = path.extension().string();
    if (extension == ".csv" || extension == ".CSV") return readCsv(text, file);
    if (extension == ".spd" || extension == ".txt" || extension == ".SPD" || extension == ".TXT")
        return readColumns(text, file);
    throw InputError({file}, fmt::format("is not a table of spectra {}", formats));
}

}  // namespace spectrad
