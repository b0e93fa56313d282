// spectrad info FILM: the chain of a reversal film, with its curves.
#include "base/text.h"
#include "camera/film.h"
#include "cli/info.h"
#include "spectrum/library.h"
#include "spectrum/resolver.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>

namespace spectrad {

namespace {

constexpr std::array<const char*, 3> curveNames{"red", "green", "blue"};
constexpr std::array<const char*, 3> dyeNames{"cyan", "magenta", "yellow"};

Json described(const Film& film) {
    Json out{{"text", film.name},
             {"quantity", "film"},
             {"layers", film.layers.channels},
             {"projector", film.projectorName},
             {"curves", Json::object()}};
    for (size_t k = 0; k < 3; ++k) {
        const CharacteristicCurve& c = film.curves[k];
        out["curves"][curveNames[k]] = {{"dmin", c.dmin},
                                        {"dmax", c.dmax},
                                        {"slope", c.slope},
                                        {"centre", c.centre},
                                        {"shoulder", c.shoulder}};
    }
    return out;
}

void printCurve(const std::string& label, const Curve& curve) {
    const auto [least, most] = curve.bounds();
    const auto [from, to] = curve.range().value_or(std::pair{380.0, 780.0});
    printText(fmt::format("\n{}: {} to {} nm, values {} to {}\n", label, rounded(from, 6), rounded(to, 6),
                          rounded(least, 6), rounded(most, 6)));
    printText(plot(curve, from, to));
}

void printTable(const Film& film) {
    printText(fmt::format("film       {}\nprojector  {}\n", film.name, film.projectorName));
    for (size_t k = 0; k < 3; ++k) {
        const CharacteristicCurve& c = film.curves[k];
        printText(fmt::format("{:<10} densities {} to {}, slope {}, centre {}, shoulder {}\n", curveNames[k],
                              rounded(c.dmin, 6), rounded(c.dmax, 6), rounded(c.slope, 6),
                              rounded(c.centre, 6), rounded(c.shoulder, 6)));
    }
    for (size_t k = 0; k < 3; ++k)
        printCurve("layer " + film.layers.channels[k], film.layers.response[k]);
    for (size_t k = 0; k < 3; ++k)
        printCurve(std::string("density of ") + dyeNames[k], film.dyes[k]);
    printCurve("density of the base", film.base);
}

}  // namespace

void printFilmInfo(const std::string& name, const Library& library, bool json, Console& console) {
    const SpectrumResolver resolver(library, ".", false, console.notes());
    const Film film = filmFor(name, resolver, library);
    console.printNotes();
    if (json)
        printJson(described(film));
    else
        printTable(film);
}

}  // namespace spectrad
