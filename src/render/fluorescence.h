// Fluorescence: what a substrate sends back at other wavelengths than it was lit with. Sources:
// docs/format.md ("Fluorescence"), Donaldson 1954 (bispectral radiance factors), Hullin et al. 2010.
#pragma once

#include "scene/scene.h"
#include "spectrum/curve.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spectrad {

/// What was changed in a matrix before it is used, and how the rest fares with energy.
struct MatrixChanges {
    std::string file;
    size_t zeroed = 0;       ///< cells whose emission lies below the excitation, set to zero
    double zeroedMost = 0;   ///< the largest of them
    size_t clipped = 0;      ///< negative reflectances on the diagonal, set to zero
    size_t columns = 0;      ///< excitation bands
    size_t tooMuch = 0;      ///< of them: send out more energy than they take in
    double mostEnergy = 0;   ///< energy out per energy in of the worst
    double mostPhotons = 0;  ///< photons out per photon in of the worst
};

/// A fluorophore in figures.
struct FluorophoreFigures {
    /// Wavelengths of the largest excitation (photons out per photon in) and of the largest emission (energy
    /// per nm, of a matrix in the column of the largest excitation). None for a shape without a peak.
    std::optional<double> excitationPeak, emissionPeak;
    /// Photons emitted per photon that the base does not reflect, for light at the excitation's peak.
    double yield = 0;
    std::optional<MatrixChanges> matrix;
    [[nodiscard]] std::optional<double> stokesShift() const {  ///< nm
        if (!excitationPeak || !emissionPeak) return std::nullopt;
        return *emissionPeak - *excitationPeak;
    }
};

/// How a coat lets exciting light in, where that is otherwise than what is emitted gets out.
struct Entry {
    double inside = 0;              ///< reflectance of diffuse light from below
    const Curve* weight = nullptr;  ///< one more factor of the light
};

/// The diffuse part of a material with its fluorophores, seen through a coat that sends `inside` of diffuse
/// light back down.
class FluorescentBase {
  public:
    /// Throws InputError for parts that contradict each other; what was changed in a matrix goes to notes.
    FluorescentBase(const Material& material, double inside, Notes& notes,
                    const std::optional<Entry>& entry = std::nullopt);

    [[nodiscard]] bool isBlack() const {
        return reflectsNothing() && separable_.empty() && bispectral_.empty();
    }
    [[nodiscard]] bool reflectsNothing() const { return black_; }
    /// M(λo, λi) = factor · x(λi) (1 − ρ(λi)) · λi · e(λo)
    struct Separable {
        Curve excitation;  ///< peak 1
        Curve emission;    ///< in energy, as given
        double factor;     ///< Q · strength ÷ that integral
        double strength, yield;
        bool antiStokes;
        size_t number;  ///< in the material
    };
    /// A Donaldson matrix: value[emission][band].
    struct Bispectral {
        std::vector<double> emission, bandCentre, bandFrom, bandTo;
        std::vector<std::vector<double>> value;  ///< diagonal and what lies below the excitation taken out
        MatrixChanges changes;
        [[nodiscard]] double width(size_t column) const { return bandTo[column] - bandFrom[column]; }
        /// Photons out per photon in of a column (energy: without the ratio of wavelengths).
        [[nodiscard]] double photonsOut(size_t column) const;
        [[nodiscard]] double energyOut(size_t column) const;
        size_t number = 0;  ///< in the material
    };
    [[nodiscard]] const std::vector<Separable>& separable() const { return separable_; }
    [[nodiscard]] const std::vector<Bispectral>& bispectral() const { return bispectral_; }
    /// ρ (1 − r) / (1 − ρ r), r the coat's reflectance from inside.
    [[nodiscard]] Curve reflectance() const;
    /// For each fluorophore ∫ M(λo, λi) E(λi) dλi over a light's irradiance E, as a curve over λo, coat
    /// included.
    [[nodiscard]] std::vector<Curve> reradiation(const Curve& light) const;
    /// One for each fluorophore, in the order of reradiation().
    [[nodiscard]] std::vector<FluorophoreFigures> figures() const;
    /// Of those fluorophores of the material alone whose numbers are listed.
    [[nodiscard]] std::vector<Curve> reradiation(const Curve& light, std::span<const size_t> parts) const;

  private:
    void addSeparable(const Fluorescence& part);
    /// Fluorophores that share a wavelength cannot each take all of it.
    void checkAbsorption(const Material& material, Notes& notes) const;
    void addMatrix(const Fluorescence& part, const Material& material, Notes& notes);
    /// Takes the diagonal as the base's reflectance.
    void takeDiagonal(const Fluorescence& part, const Material& material, const std::vector<double>& nm,
                      std::vector<double> value, MatrixChanges& changes, Notes& notes);
    [[nodiscard]] FluorophoreFigures figuresOf(const Separable& part) const;
    [[nodiscard]] FluorophoreFigures figuresOf(const Bispectral& part) const;
    [[nodiscard]] Curve glow(const Separable& part, const Curve& light) const;
    [[nodiscard]] Curve glow(const Bispectral& part, const Curve& light) const;

    Curve base_;
    double inside_;
    double insideIn_;  ///< the same for exciting light
    std::optional<Curve> weightIn_;
    bool black_ = true;
    std::vector<Separable> separable_;
    std::vector<Bispectral> bispectral_;
};

}  // namespace spectrad
