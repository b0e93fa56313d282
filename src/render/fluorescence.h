// Fluorescence: what a substrate sends back at other wavelengths than it was lit with. Sources:
// docs/format.md ("Fluorescence"), Donaldson 1954 (bispectral radiance factors), Hullin et al. 2010.
#pragma once

#include "scene/scene.h"
#include "spectrum/curve.h"

#include <vector>

namespace spectrad {

/// A bispectral matrix as read: radiance factors D[row][column], row = emission, column = excitation band
/// (both nm, ascending).
struct DonaldsonMatrix {
    std::vector<double> emission, excitation;
    std::vector<std::vector<double>> value;
};
/// CSV or text: first column emission_nm, then a column exNNN for each excitation band. Throws InputError
/// with file and line.
[[nodiscard]] DonaldsonMatrix readDonaldson(const std::string& file);

/// The diffuse part of a material with its fluorophores, seen through a coat that sends `inside` of diffuse
/// light back down.
class FluorescentBase {
  public:
    /// Throws InputError for parts that contradict each other; what was changed in a matrix goes to notes.
    FluorescentBase(const Material& material, double inside, Notes& notes);

    [[nodiscard]] bool isBlack() const { return black_; }
    /// ρ (1 − r) / (1 − ρ r), r the coat's reflectance from inside.
    [[nodiscard]] Curve reflectance() const;
    /// For each fluorophore ∫ M(λo, λi) E(λi) dλi over a light's irradiance E, as a curve over λo, coat
    /// included.
    [[nodiscard]] std::vector<Curve> reradiation(const Curve& light) const;

  private:
    struct Separable {
        Curve excitation;  ///< peak 1
        Curve emission;    ///< in energy, as given
        double factor;     ///< Q · strength ÷ that integral
        double strength;
        bool antiStokes;
    };
    struct Bispectral {
        std::vector<double> emission, bandCentre, bandFrom, bandTo;
        std::vector<std::vector<double>> value;  ///< diagonal and what lies below the excitation taken out
    };
    void addSeparable(const Fluorescence& part);
    /// Fluorophores that share a wavelength cannot each take all of it.
    void checkAbsorption(const Material& material, Notes& notes) const;
    void addMatrix(const Fluorescence& part, const Material& material, Notes& notes);
    [[nodiscard]] Curve glow(const Separable& part, const Curve& light) const;
    [[nodiscard]] Curve glow(const Bispectral& part, const Curve& light) const;
    [[nodiscard]] double amplified(double nm) const;

    Curve base_;
    double inside_;
    bool black_ = true;
    std::vector<Separable> separable_;
    std::vector<Bispectral> bispectral_;
};

}  // namespace spectrad
