// Reading a film's file, and choosing a film by name.
#include "base/files.h"
#include "base/text.h"
#include "camera/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace spectrad {

namespace {

struct Line {
    std::vector<std::string> words;  ///< the first is the setting
    std::vector<SourceLocation> where;
};

const std::vector<std::string>& settings() {
    static const std::vector<std::string> names{"layers", "dyes",  "balance", "projector",
                                                "red",    "green", "blue"};
    return names;
}

/// Lines by setting; what follows `#` is a comment.
std::map<std::string, Line> linesOf(std::string_view text, const std::string& file) {
    std::map<std::string, Line> result;
    int number = 0;
    for (std::string_view line : split(text, '\n')) {
        ++number;
        line = line.substr(0, line.find('#'));
        Line parts;
        for (const std::string_view word : words(line)) {
            parts.words.emplace_back(word);
            parts.where.push_back({file, number, static_cast<int>(word.data() - line.data()) + 1});
        }
        if (parts.words.empty()) continue;
        const std::string key = parts.words.front();
        const SourceLocation where = parts.where.front();
        if (std::find(settings().begin(), settings().end(), key) == settings().end())
            throw InputError(where, fmt::format("unknown setting '{}' of a film (allowed: {}){}", key,
                                                fmt::join(settings(), ", "), didYouMean(key, settings())));
        if (!result.emplace(key, std::move(parts)).second)
            throw InputError(where, fmt::format("'{}' is given twice", key));
    }
    for (const std::string& needed : settings())
        if (!result.count(needed))
            throw InputError(SourceLocation{file}, fmt::format("a film needs a line '{}'", needed));
    return result;
}

Spectrum spectrumIn(const Line& line, Role role, const SpectrumResolver& resolver) {
    if (line.words.size() != 2)
        throw InputError(line.where.front(), fmt::format("'{}' needs one spectrum", line.words.front()));
    return resolver.resolve(line.words[1], role, line.where[1]);
}

double numberIn(const Line& line, size_t index, const char* what, double least, double most) {
    const auto value = parseDouble(line.words[index]);
    if (!value || *value < least || *value > most)
        throw InputError(line.where[index],
                         fmt::format("'{}' is no {} (allowed: {} to {})", line.words[index], what,
                                     shortest(least), shortest(most)));
    return *value;
}

CharacteristicCurve curveIn(const Line& line) {
    constexpr size_t count = 6;
    if (line.words.size() != count)
        throw InputError(
            line.where.front(),
            fmt::format("'{}' needs five numbers: dmin dmax slope centre shoulder", line.words.front()));
    CharacteristicCurve curve{numberIn(line, 1, "density", 0, 10), numberIn(line, 2, "density", 0, 10),
                              numberIn(line, 3, "slope", 0.01, 100),
                              numberIn(line, 4, "log exposure", -10, 10),
                              numberIn(line, 5, "shoulder", 0.01, 100)};
    if (curve.dmax <= curve.dmin) throw InputError(line.where[2], "dmax must be above dmin");
    return curve;
}

/// The text after "films/" or before ".film" is enough.
std::filesystem::path libraryFile(const std::string& name, const Library& library) {
    for (const char* folder : {"", "films/"}) {
        const std::filesystem::path path = library.folder() / (folder + name + ".film");
        if (isFile(path)) return path;
    }
    return {};
}

}  // namespace

Film parseFilm(std::string_view text, const std::string& file, const SpectrumResolver& resolver) {
    const std::map<std::string, Line> lines = linesOf(text, file);
    Film film;
    film.name = file;
    film.layers = detectorFrom(spectrumIn(lines.at("layers"), Role::detector, resolver));
    film.layers.name = file;
    if (film.layers.channels != std::vector<std::string>{"R", "G", "B"})
        throw InputError(lines.at("layers").where[1], "a film's layers have the channels R, G, B");
    const Spectrum dyes = spectrumIn(lines.at("dyes"), Role::any, resolver);
    if (dyes.channels != std::vector<std::string>{"C", "M", "Y", "base"})
        throw InputError(lines.at("dyes").where[1], "a film's dyes have the channels C, M, Y, base");
    for (size_t k = 0; k < 3; ++k)
        film.dyes[k] = dyes.curves[k].withOutside(Outside::hold);
    film.base = dyes.curves[3].withOutside(Outside::hold);
    film.balance = spectrumIn(lines.at("balance"), Role::light, resolver).curve();
    const Spectrum projector = spectrumIn(lines.at("projector"), Role::light, resolver);
    film.projector = projector.curve();
    film.projectorName = projector.text;
    film.curves = {curveIn(lines.at("red")), curveIn(lines.at("green")), curveIn(lines.at("blue"))};
    return film;
}

bool isFilm(const std::string& name, const Library& library) {
    return name.ends_with(".film") || (!name.empty() && !libraryFile(name, library).empty());
}

std::vector<std::string> filmNames(const Library& library) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& file : std::filesystem::directory_iterator(library.folder() / "films", none))
        if (file.path().extension() == ".film") names.push_back("films/" + file.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

Detector detectorOrFilmMeant(const std::string& name, const SpectrumResolver& resolver,
                             const Library& library) {
    try {
        return detectorFor(name, resolver, {});
    } catch (const UnknownObserver&) {
        std::vector<std::string> films = filmNames(library);
        for (size_t i = films.size(); i-- > 0;)
            films.push_back(films[i].substr(films[i].find('/') + 1));
        const std::string hint = didYouMean(name, films);
        if (hint.empty()) throw;
        throw InputError("unknown observer '" + name + "'" + hint);
    }
}

Film filmFor(const std::string& name, const SpectrumResolver& resolver, const Library& library) {
    const std::filesystem::path shipped = libraryFile(name, library);
    const std::filesystem::path path = shipped.empty() ? resolver.findFile(name, {}) : shipped;
    Film film = parseFilm(readFile(path, 1u << 20), path.string(), resolver);
    film.name = film.layers.name = name;
    return film;
}

}  // namespace spectrad
