#include "spectrum/resolver.h"

#include "base/files.h"
#include "base/text.h"
#include "spectrum/formula_text.h"
#include "spectrum/readers/reader.h"
#include "spectrum/role.h"
#include "spectrum/table_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

/// Whether `path`, links resolved, lies in `folder`; what does not exist is resolved as far as it does.
bool isBelow(const fs::path& path, const fs::path& folder) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
    if (error) return false;
    const fs::path base = fs::weakly_canonical(fs::absolute(folder, error), error);
    if (error) return false;
    const fs::path relative = whole.lexically_relative(base);
    return !relative.empty() && *relative.begin() != "..";
}

/// "lamp.csv#Patch 7": where the name could end and the column begin; the whole first.
std::vector<std::pair<std::string, std::string>> splitsOf(std::string_view text) {
    std::vector<std::pair<std::string, std::string>> result{{std::string(text), ""}};
    for (size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1))
        if (at > 0) result.emplace_back(text.substr(0, at), trimmed(text.substr(at + 1)));
    return result;
}

/// Whether a text that names nothing was meant for a file: it has a column or an extension of letters.
bool looksLikeFile(std::string_view text) {
    if (text.find('#') != std::string_view::npos) return true;
    const std::string extension = fs::path(std::string(text)).extension().string();
    return extension.size() >= 3 && extension.size() <= 5 &&
           std::isalpha(static_cast<unsigned char>(extension[1]));
}

/// Of the library; a detector's name does without them.
constexpr std::array<std::string_view, 2> detectorFolders{"observers/", "cameras/"};

bool looksLikePairs(std::string_view text) {
    const auto first = words(text);
    if (first.empty()) return false;
    const size_t colon = first.front().find(':');
    return colon != std::string_view::npos && parseDouble(first.front().substr(0, colon)).has_value();
}

}  // namespace

SpectrumResolver::SpectrumResolver(const Library& library, fs::path folder, bool restricted, Notes& notes)
    : library_(library),
      folder_(folder.empty() ? fs::path(".") : std::move(folder)),
      restricted_(restricted),
      notes_(notes) {}

void SpectrumResolver::define(const std::string& name, Spectrum spectrum, const SourceLocation& where) {
    const auto [found, isNew] = definitions_.try_emplace(name, Definition{std::move(spectrum), where});
    if (!isNew)
        throw InputError(
            where, fmt::format("spectrum '{}' is defined already{}", name,
                               found->second.where.str().empty() ? "" : ", at " + found->second.where.str()));
}

bool SpectrumResolver::isAllowed(const fs::path& path) const {
    return !restricted_ || isBelow(path, folder_);
}

bool SpectrumResolver::isOfLibrary(const Spectrum& spectrum) const {
    return !spectrum.files.empty() && isBelow(spectrum.files.front(), library_.folder());
}

fs::path SpectrumResolver::outputFile(const std::string& file, const SourceLocation& where) const {
    if (file.empty()) throw InputError(where, "a file without a name");
    const fs::path path = folder_ / file;  // an absolute name stays as it is
    if (!isAllowed(path))
        throw InputError(
            where, fmt::format("'{}' lies outside the scene's folder, which is not allowed here (--restrict)",
                               file));
    return path;
}

fs::path SpectrumResolver::findFile(const std::string& file, const SourceLocation& where) const {
    const fs::path path = outputFile(file, where);
    if (isFile(path)) return path;
    std::error_code ignored;
    if (fs::exists(path, ignored))
        throw InputError(where, fmt::format("'{}' is not a file (at {})", file, path.string()));
    std::vector<std::string> beside;
    for (const auto& entry : fs::directory_iterator(path.parent_path(), ignored))
        beside.push_back(entry.path().filename().string());
    throw InputError(where, fmt::format("cannot find the file '{}'{} (tried: {})", file,
                                        didYouMean(path.filename().string(), beside), path.string()));
}

std::optional<SpectrumResolver::FileUse> SpectrumResolver::fileUse(std::string_view text) const {
    for (auto& [file, column] : splitsOf(text)) {
        const fs::path path = folder_ / file;
        if (isAllowed(path) && isFile(path)) return FileUse{path, file, column};
    }
    return std::nullopt;
}

Spectrum SpectrumResolver::fromFile(const FileUse& use, Role role, const SourceLocation& where) const {
    Spectrum spectrum = tableSpectrum(readTable(use.path), use.file, use.column, role, where);
    spectrum.files = {use.path};
    return spectrum;
}

Spectrum SpectrumResolver::fromFormula(std::string_view text, Role role, const SourceLocation& where) const {
    ColourSource colours;
    colours.lift = [this](std::array<double, 3> rgb) {
        if (!lift_) lift_ = std::make_shared<const ColourLift>(library_);
        return lift_->fit(rgb);
    };
    colours.daylight = [this] {
        const auto lamp = library_.find("illuminants/D65");
        if (!lamp)
            throw InputError(library_.folder().string() +
                             ": the library lacks illuminants/D65, which colours are lifted with");
        return lamp->curve();
    };
    return formulaSpectrum(text, role == Role::light, colours, where);
}

Spectrum SpectrumResolver::definition(std::string_view name, Role role, const SourceLocation& where) const {
    const auto found = definitions_.find(name);
    used_.insert(found->first);
    const Spectrum& spectrum = found->second.spectrum;
    // Only here is it known whether a colour is a lamp's or a surface's.
    if (role == Role::light && spectrum.formula && isColourFormula(spectrum.text))
        return fromFormula(spectrum.text, role, where);
    return spectrum;
}

/// The library's spectrum of that name; a detector's folder need not be said.
std::optional<Spectrum> SpectrumResolver::fromLibrary(std::string_view text, Role role) const {
    if (auto found = library_.find(text)) return found;
    if (role != Role::detector || text.find('/') != std::string_view::npos) return std::nullopt;
    for (std::string_view folder : detectorFolders)
        if (auto found = library_.find(std::string(folder) + std::string(text))) return found;
    return std::nullopt;
}

std::vector<SpectrumResolver::Reading> SpectrumResolver::readings(std::string_view text, Role role,
                                                                  const SourceLocation& where) const {
    std::vector<Reading> found;
    if (definitions_.find(text) != definitions_.end())
        found.push_back({fmt::format("the scene's spectrum '{}'", text),
                         [=, this] { return definition(text, role, where); }});
    if (const auto spectrum = fromLibrary(text, role))
        found.push_back({fmt::format("the library's '{}'", spectrum->text), [=] { return *spectrum; }});
    if (const auto use = fileUse(text))
        found.push_back({fmt::format("the file {}", use->path.string()),
                         [=, this] { return fromFile(*use, role, where); }});
    if (isFormula(text))
        found.push_back(
            {fmt::format("the formula '{}'", text), [=, this] { return fromFormula(text, role, where); }});
    else if (looksLikePairs(text))
        found.push_back({fmt::format("the pairs '{}'", text), [=] { return pairsSpectrum(text, where); }});
    else if (const auto number = parseDouble(text); number && role == Role::index)
        found.push_back(
            {fmt::format("the number {}", text), [=] { return constantSpectrum(text, *number); }});
    return found;
}

Spectrum SpectrumResolver::resolve(std::string_view text, Role role, const SourceLocation& where) const {
    text = trimmed(text);
    if (text.empty()) throw InputError(where, "a spectrum without a name or value");
    const std::vector<Reading> found = readings(text, role, where);
    if (found.empty()) refuse(text, role, where);
    if (found.size() > 1)
        notes_.warn(where, fmt::format("'{}' could mean {} or {}; the first is taken", text, found[0].what,
                                       found[1].what));
    Spectrum spectrum = found.front().read();
    spectrum.text = text;
    return checked(std::move(spectrum), role, where);
}

Spectrum SpectrumResolver::resolveFile(const std::string& file, const std::string& column, Role role,
                                       const SourceLocation& where) const {
    Spectrum spectrum = fromFile({findFile(file, where), file, column}, role, where);
    spectrum.text = column.empty() ? file : file + "#" + column;
    return checked(std::move(spectrum), role, where);
}

Spectrum SpectrumResolver::checked(Spectrum spectrum, Role role, const SourceLocation& where) const {
    if (!takesChannels(role) && spectrum.curves.size() > 1) {
        auto channel = channelFor(role, spectrum.channels);
        if (!channel && !spectrum.files.empty() && !isOfLibrary(spectrum)) channel = 0;
        if (channel) spectrum = oneChannel(std::move(spectrum), *channel);
    }
    return fitted(std::move(spectrum), role, where);
}

std::vector<std::pair<std::string, SourceLocation>> SpectrumResolver::unused() const {
    std::vector<std::pair<std::string, SourceLocation>> result;
    for (const auto& [name, definition] : definitions_)
        if (!used_.contains(name)) result.emplace_back(name, definition.where);
    return result;
}

/// Says what the text might have been meant for.
void SpectrumResolver::refuse(std::string_view text, Role role, const SourceLocation& where) const {
    if (looksLikeFile(text) && text.find(':') == std::string_view::npos) {
        const auto splits = splitsOf(text);
        (void)findFile(splits[splits.size() > 1 ? 1 : 0].first,
                       where);  // throws: it is not there, or not allowed
    }
    if (parseDouble(text))
        throw InputError(
            where,
            fmt::format("unknown spectrum '{}' (for one value at all wavelengths: constant:{})", text, text));
    const size_t colon = text.find(':');
    if (colon != std::string_view::npos && text.find('/') == std::string_view::npos) {
        const std::string_view name = trimmed(text.substr(0, colon));
        throw InputError(where,
                         fmt::format("unknown formula '{}'{} (allowed: {}, or pairs nm:value)", name,
                                     didYouMean(name, formulaNames()), fmt::join(formulaNames(), ", ")));
    }
    std::vector<std::string> known = library_.names();
    const std::string end = "/" + std::string(text);
    std::string hint;
    for (const std::string& name : known)
        if (hint.empty() && name.size() > end.size() &&
            name.compare(name.size() - end.size(), end.size(), end) == 0)
            hint = fmt::format(" (did you mean '{}'?)", name);
    for (const auto& [name, definition] : definitions_)
        known.push_back(name);
    // A sensor's curve is a spectrum; who looks is an observer, whose folder need not be said.
    const bool observer = role == Role::detector && text.find('/') == std::string_view::npos;
    if (observer)
        for (const std::string_view folder : detectorFolders)
            for (const std::string& name : library_.names())
                if (name.starts_with(folder)) known.push_back(name.substr(folder.size()));
    if (hint.empty()) hint = didYouMean(text, known);
    const std::string message = fmt::format(
        "unknown {} '{}'{}: neither the scene nor the library has it, nor is it a file beside the scene",
        observer ? "observer" : "spectrum", text, hint);
    if (observer) throw UnknownObserver(where, message);
    throw InputError(where, message);
}

}  // namespace spectrad
