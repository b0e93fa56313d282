// A curve over wavelength, kept as it was measured: a table (linear between its samples), a formula, or
// spectral lines.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace spectrad {

/// A line of no width: a delta function at `nm` with integral `integral`.
struct SpectralLine {
    double nm;
    double integral;
};

/// What lies outside the range of a table: nothing (lights, detectors) or its end values (reflectance, index
/// …).
enum class Outside { zero, hold };

/// Value type; copies share the samples. Between neighbouring breaks() a curve is smooth enough for the
/// quadrature of projection.h: exactly linear for tables, within 1e-11 of its maximum for formulae.
class Curve {
  public:
    Curve();  ///< zero everywhere

    /// nm ascending (two equal neighbours are a jump), same length as value, at least one sample; linear
    /// between. One sample is a constant on a range of no width.
    static Curve table(std::vector<double> nm, std::vector<double> value, Outside outside = Outside::zero);
    static Curve constant(double value);
    static Curve line(double nm, double integral = 1);
    static Curve rectangle(double centre, double width);  ///< unit integral
    static Curve gaussian(double centre, double fwhm);    ///< peak 1
    static Curve blackbody(double kelvin);  ///< Planck's radiance, W·m⁻²·sr⁻¹·nm⁻¹ (CODATA 2018, vacuum)
    static Curve daylight(double kelvin);  ///< CIE D series, 4000…25000 K, 100 at 560 nm
    /// Any formula; `breaks(from, to, out)` appends where [from, to] must be cut so that a 4-point Gauss rule
    /// is exact enough.
    static Curve formula(std::function<double(double)> at,
                         std::function<void(double, double, std::vector<double>&)> breaks,
                         std::optional<std::pair<double, double>> range = std::nullopt);
    /// f(a(λ), b(λ), …) of curves without lines (for Fresnel reflectance of an index …). f must be smooth;
    /// breaks are those of the inputs and whatever f needs between them. Outside their ranges it is f of the
    /// inputs' own outside values.
    static Curve combined(std::vector<Curve> inputs, std::function<double(std::span<const double>)> f);

    [[nodiscard]] double at(double nm) const;  ///< without the lines; at a jump the mean of both sides
    /// at() for many ascending wavelengths at once: linear in their number plus the samples'.
    void values(std::span<const double> nm, std::span<double> out) const;
    [[nodiscard]] std::span<const SpectralLine> lines() const;
    /// Appends the abscissae in (from, to) where the curve is not smooth, ascending.
    void appendBreaks(double from, double to, std::vector<double>& out) const;

    /// Where the curve is tabulated or (practically) not zero; nothing for one that goes on everywhere
    /// (constant, blackbody).
    [[nodiscard]] std::optional<std::pair<double, double>> range() const;
    /// What an integral over all wavelengths needs to cover: range() where the curve is zero outside, all
    /// that matters of a blackbody (to 1e-15 of its total); nothing for a constant or a curve held beyond its
    /// range.
    [[nodiscard]] std::optional<std::pair<double, double>> support() const;
    /// The samples of a table; empty for formulae.
    [[nodiscard]] std::span<const double> sampleWavelengths() const;
    [[nodiscard]] std::span<const double> sampleValues() const;

    [[nodiscard]] Curve scaled(double factor) const;
    [[nodiscard]] Curve withOutside(Outside outside) const;
    [[nodiscard]] Outside outside() const;
    [[nodiscard]] bool isConstant() const;  ///< the same value at every wavelength
    /// Smallest and largest value over samples (tables), or over the breaks of the range, else of 200…20 000
    /// nm (formulae); zero outside a range does not count.
    [[nodiscard]] std::pair<double, double> bounds() const;

    struct Body;  // one of the kinds; curve.cpp

  private:
    explicit Curve(std::shared_ptr<const Body> body) : body_(std::move(body)) {}
    std::shared_ptr<const Body> body_;
    double scale_ = 1;
    Outside outside_ = Outside::zero;
};

}  // namespace spectrad
