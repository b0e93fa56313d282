// Turns every way of writing a spectrum (docs/format.md, "Spectra") into curves.
#pragma once

#include "spectrum/library.h"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace spectrad {

class ColourLift;
struct SpectrumTable;

/// Where a spectrum is used: what it must be, and so what lies outside its range and which numbers are
/// errors.
enum class Role {
    reflectance,    ///< 0…1, held outside its range
    transmittance,  ///< 0…1, held
    light,          ///< ≥ 0, zero outside
    detector,       ///< any sign, zero outside, any number of channels
    index,          ///< n > 0 or n and k ≥ 0, held; a formula such as "sellmeier:…" or "cauchy:…" too
    excitation,     ///< ≥ 0, zero outside, shape only
    emission,       ///< ≥ 0, zero outside, shape only
    any
};

/// Nothing is called as an observer is.
class UnknownObserver : public InputError {
  public:
    using InputError::InputError;
};

class SpectrumResolver {
  public:
    /// Files are looked for beside the scene (`folder`); with `restrictTo` set, no file outside that folder
    /// (after symbolic links are resolved) is read but the library's.
    SpectrumResolver(const Library& library, std::filesystem::path folder, bool restricted, Notes& notes);

    /// A <spectrum> of the scene. Throws InputError if the name is taken (with the first place).
    void define(const std::string& name, Spectrum spectrum, const SourceLocation& where);

    /// The first reading of `text` that exists, in the order of the format's table; a name that two readings
    /// could mean is a warning. Checks the quantity and range against the role. Throws InputError at `where`:
    /// unknown name (with the nearest), missing file (with the paths tried), missing column (with the columns
    /// there), bad formula, NaN or infinite values, negative ones, wrong quantity, several channels where one
    /// is meant.
    [[nodiscard]] Spectrum resolve(std::string_view text, Role role, const SourceLocation& where) const;
    /// A file named by file= and column= attributes, column by number or header ("" = the first after the
    /// wavelength, or all of them where the role takes several: detector, index, any).
    [[nodiscard]] Spectrum resolveFile(const std::string& file, const std::string& column, Role role,
                                       const SourceLocation& where) const;
    /// Checks `spectrum` against `role` and sets what lies outside its curves' range. Of a user's file with
    /// several columns a role that takes one gets the first; of a fluorophore's, its own.
    [[nodiscard]] Spectrum checked(Spectrum spectrum, Role role, const SourceLocation& where) const;

    /// Names of definitions that were never asked for, with their places.
    [[nodiscard]] std::vector<std::pair<std::string, SourceLocation>> unused() const;
    /// Turns "pass:…" and other scene-relative file names into paths: `file` beside the scene, checked
    /// against `restricted`.
    [[nodiscard]] std::filesystem::path findFile(const std::string& file, const SourceLocation& where) const;
    /// Whether a file may be read or written at all: below the scene's folder, where only that is allowed.
    [[nodiscard]] bool isAllowed(const std::filesystem::path& path) const;
    /// A file to write, beside the scene; checked against `restricted`.
    [[nodiscard]] std::filesystem::path outputFile(const std::string& file,
                                                   const SourceLocation& where) const;

  private:
    struct Definition {
        Spectrum spectrum;
        SourceLocation where;
    };
    /// A reading of a text that exists: what it is, in words for the warning, and how to get it.
    struct Reading {
        std::string what;
        std::function<Spectrum()> read;
    };
    struct FileUse {
        std::filesystem::path path;
        std::string file, column;
    };

    [[nodiscard]] std::vector<Reading> readings(std::string_view text, Role role,
                                                const SourceLocation& where) const;
    [[nodiscard]] Spectrum definition(std::string_view name, Role role, const SourceLocation& where) const;
    [[nodiscard]] std::optional<Spectrum> fromLibrary(std::string_view text, Role role) const;
    [[nodiscard]] std::optional<FileUse> fileUse(std::string_view text) const;
    [[nodiscard]] Spectrum fromFile(const FileUse& use, Role role, const SourceLocation& where) const;
    [[nodiscard]] Spectrum fromFormula(std::string_view text, Role role, const SourceLocation& where) const;
    [[noreturn]] void refuse(std::string_view text, Role role, const SourceLocation& where) const;
    [[nodiscard]] bool isOfLibrary(const Spectrum& spectrum) const;

    const Library& library_;
    std::filesystem::path folder_;
    bool restricted_;
    Notes& notes_;
    std::map<std::string, Definition, std::less<>> definitions_;
    mutable std::set<std::string, std::less<>> used_;
    mutable std::shared_ptr<const ColourLift> lift_;  ///< made when the first colour asks for it
};

}  // namespace spectrad
