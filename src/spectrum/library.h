// The spectra that ship with the program: folders of text files below spectra/, named by path without
// extension.
#pragma once

#include "spectrum/spectrum.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

/// One line of `spectrad info --list`.
struct LibraryEntry {
    std::string name;  ///< "illuminants/D65"; a column of a chart is an entry of its own:
                       ///< "charts/colorchecker/dark-skin"
    Quantity quantity = Quantity::unknown;
    std::string unit, title, source, licence;
    bool relative = false;
    std::vector<std::string> channels;
    double fromNm = 0, toNm = 0;
    size_t samples = 0;
    std::filesystem::path file;
};

class Library {
  public:
    /// The folder: $SPECTRAD_SPECTRA, else share/spectrad/spectra beside the program's folder, else spectra/
    /// of the source tree.
    static Library open();
    explicit Library(std::filesystem::path folder);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// The spectrum of that name, or nothing if there is none. Case counts. Throws InputError if its file is
    /// damaged.
    [[nodiscard]] std::optional<Spectrum> find(std::string_view name) const;
    /// All entries, sorted by name; reads the heads of all files.
    [[nodiscard]] std::vector<LibraryEntry> list() const;
    /// Only the names, for "did you mean".
    [[nodiscard]] std::vector<std::string> names() const;

  private:
    std::filesystem::path folder_;
};

}  // namespace spectrad
