// Reversal film as a chain: sensitivities of three layers → exposures → characteristic curves → amounts of
// dye → the transparency's spectrum under a projector's lamp → an eye. Layers do not influence each other.
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// Density over log10 of relative exposure (1: a grey card of 18 % as the light meter wants it), falling:
/// D = dmin + (dmax − dmin) (1 + 10^(slope (lg H − centre)))^(−shoulder).
struct CharacteristicCurve {
    double dmin = 0, dmax = 3, slope = 1.5, centre = 0, shoulder = 1;
    [[nodiscard]] double density(double exposure) const;
};

struct Film {
    std::string name;
    Detector layers;            ///< R, G, B: relative sensitivities
    std::array<Curve, 3> dyes;  ///< cyan, magenta, yellow: spectral density of one unit
    Curve base;                 ///< density of what is no dye
    Curve balance;              ///< the light whose neutrals expose the layers alike
    std::string projectorName;
    Curve projector;  ///< lamp, its shape
    std::array<CharacteristicCurve, 3>
        curves;  ///< of the red, green and blue layer: equivalent neutral densities
};

/// A film's text file, one setting a line, `#` starts a comment (docs/format.md, "Films"); spectra are named
/// as in scenes. `file` is what errors call it. Throws InputError with file and line.
[[nodiscard]] Film parseFilm(std::string_view text, const std::string& file,
                             const SpectrumResolver& resolver);
/// Whether an observer's name means a film: it ends in ".film", or the library has NAME.film.
[[nodiscard]] bool isFilm(const std::string& name, const Library& library);
/// The library's films, "films/generic-reversal", sorted.
[[nodiscard]] std::vector<std::string> filmNames(const Library& library);
/// detectorFor(), for a name that might have been a film's: where there is nothing of that name but a film is
/// called nearly so, the InputError says which.
[[nodiscard]] Detector detectorOrFilmMeant(const std::string& name, const SpectrumResolver& resolver,
                                           const Library& library);
/// The film of the library, or in a file. Throws InputError.
[[nodiscard]] Film filmFor(const std::string& name, const SpectrumResolver& resolver, const Library& library);

/// A film in a projector, looked at by an eye. Dye amounts are balanced so that equal equivalent neutral
/// densities of 1 look neutral: without colour beside the lamp.
class FilmProjection {
  public:
    /// Throws InputError for an eye without X Y Z, and for dyes that cannot make a neutral.
    FilmProjection(Film film, const Detector& eye);

    /// Looks at the same film with another lamp or another eye (nothing: the film's own lamp, `standard`).
    /// The dyes stay those that the film was made with. Throws InputError as above.
    void project(const Spectrum* lamp, const Detector* eye, const Detector& standard);

    /// Relative exposures of the layers for their channels, where a luminance of `whiteLuminance` cd/m² under
    /// the balancing light is a white diffuser; `ev` stops more.
    [[nodiscard]] Triple exposures(const std::vector<double>& channels, double whiteLuminance,
                                   double ev) const;
    /// The luminance under the balancing light that exposes the green layer so: what a meter reads.
    [[nodiscard]] double metered(double greenChannel) const { return greenChannel / perLuminance_[1]; }
    [[nodiscard]] Triple densities(const Triple& exposures) const;  ///< equivalent neutral densities, R G B
    /// Transmittance of the transparency at a wavelength.
    [[nodiscard]] double transmittance(const Triple& densities, double nm) const;
    /// What the eye sees, relative to the lamp without film at Y = 1.
    [[nodiscard]] Triple xyz(const Triple& densities) const;
    [[nodiscard]] const Triple& lamp() const { return lamp_; }  ///< X Y Z of the lamp, Y = 1
    [[nodiscard]] const Film& film() const { return film_; }
    [[nodiscard]] const Triple& dyePerDensity() const { return amount_; }

  private:
    void light(const Detector& eye);  ///< nodes and lamp for the projector
    [[nodiscard]] Triple seen(const Triple& dyes) const;
    void balanceDyes();

    Film film_;
    Triple perLuminance_{};  ///< channel values of the balancing light at 1 cd/m² from a white diffuser
    Triple lamp_{};
    Triple amount_{1, 1, 1};  ///< units of dye for an equivalent neutral density of 1
    struct Node {
        std::array<double, 3> dye;  ///< densities of a unit
        double base;
        Triple weight;  ///< lamp × eye under a hat about the node
    };
    std::vector<Node> nodes_;
};

}  // namespace spectrad
