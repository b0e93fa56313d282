// An object looked at: a light and a detector, and the differences between two objects there.
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"
#include "colour/observe.h"

#include <string>
#include <vector>

namespace spectrad {

/// A light and who looks. Signals are relative: a white diffuser has Y = 1 (its largest channel for a
/// camera).
class Viewing {
  public:
    /// `standard`: CIE 1931, for the colours of a detector that has no X Y Z. Throws InputError where the
    /// detector sees nothing of the light.
    Viewing(std::string name, Curve light, Detector detector, const Detector& standard);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] size_t size() const { return detector_.size(); }
    /// The detector's channels of a reflectance, integrated exactly.
    [[nodiscard]] std::vector<double> signals(const Curve& reflectance) const;
    /// CIELAB of it against the white diffuser.
    [[nodiscard]] Triple lab(const Curve& reflectance) const;
    [[nodiscard]] Triple labOf(const Triple& xyz) const;
    [[nodiscard]] Triple xyz(const Curve& reflectance) const;
    /// The integrals of light × response under each hat of the wavelengths, [channel][wavelength]; the
    /// outermost take what lies beyond, where reflectances are held. So signals = weights · nodal values.
    [[nodiscard]] std::vector<std::vector<double>> weights(const std::vector<double>& nm) const;

  private:
    std::string name_;
    Curve light_;
    Detector detector_;
    XyzMatrix toXyz_;
    double scale_ = 1;
    Triple white_{};
};

/// ΔE00 of two reflectances there.
[[nodiscard]] double difference(const Viewing& viewing, const Curve& a, const Curve& b);

/// CIE special metamerism index (CIE 015:2018, 8.2: change in illuminant; the same for a change of observer):
/// the difference under the test viewing, after the small one left under the reference is taken out by X, Y
/// and Z in proportion. In ΔE*ab as the standard has it, and in ΔE00.
struct MetamerismIndex {
    double deltaE76 = 0, deltaE00 = 0;
};
[[nodiscard]] MetamerismIndex specialMetamerismIndex(const Viewing& reference, const Viewing& test,
                                                     const Curve& a, const Curve& b);

}  // namespace spectrad
