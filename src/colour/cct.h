// Correlated colour temperature and Duv: the nearest point of the Planckian locus in the CIE 1960 (u, v)
// diagram.
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"

#include <optional>
#include <vector>

namespace spectrad {

/// Correlated colour temperature, K, and Duv: the distance from the Planckian locus in (u, v), positive above
/// it.
struct Cct {
    double kelvin, duv;
};

/// The chromaticities of black bodies as one observer sees them: integrals of Planck's law (CODATA 2018
/// constants, as Curve::blackbody) with the observer's curves, so that a black body comes back with its own
/// temperature and no Duv. The nearest point is solved for, where Ohno (2014, Leukos 10, 47–55) interpolates
/// a table: temperatures agree to 1.5e-5 up to 15 000 K and Duv to 1e-6, once the same c₂ is used. (Programs
/// with the c₂ of ITS-90, 1.4388e-2 m·K, say 1.6e-5 more: 0.1 K at 6500 K.) The CIE defines both figures for
/// the 1931 observer.
class PlanckianLocus {
  public:
    /// Integrates the table of the locus, in a few milliseconds. Throws InputError unless `observer` is
    /// tristimulus.
    explicit PlanckianLocus(const Detector& observer);

    /// Nothing for black, where |Duv| > 0.05 makes the figure meaningless (CIE 015:2018, 9.4), and beyond
    /// 800…1 000 000 K.
    [[nodiscard]] std::optional<Cct> nearest(const Triple& xyz) const;
    /// u, v of the black body of that temperature, K.
    [[nodiscard]] std::array<double, 2> at(double kelvin) const;

  private:
    /// A point of the locus and its derivative by reciprocal temperature.
    struct Point {
        double u, v, du, dv;
    };
    [[nodiscard]] Point point(double mired) const;

    /// A node of the quadrature: the wavelength in nm, the observer's curves times the node's weight and λ⁻⁴.
    struct Node {
        double nm;
        Triple weight;
    };
    std::vector<Node> nodes_;
    std::vector<Point> table_;  ///< equidistant in reciprocal temperature, where the locus is smoothest
};

}  // namespace spectrad
