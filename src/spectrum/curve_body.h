// What a Curve is made of; private to the files that make curves (curve.cpp, formulae.cpp).
#pragma once

#include "spectrum/curve.h"

namespace spectrad {

using NmRange = std::pair<double, double>;

struct Curve::Body {
    virtual ~Body() = default;
    [[nodiscard]] virtual double at(double nm, Outside outside) const = 0;
    /// at() for ascending wavelengths; tables walk along instead of searching for each.
    virtual void values(std::span<const double> nm, std::span<double> out, Outside outside) const {
        for (size_t i = 0; i < nm.size(); ++i)
            out[i] = at(nm[i], outside);
    }
    /// Ascending, strictly inside (from, to).
    virtual void appendBreaks(double from, double to, Outside outside, std::vector<double>& out) const = 0;
    [[nodiscard]] virtual std::optional<NmRange> range() const { return std::nullopt; }
    /// Outside it the curve adds nothing to an integral over all wavelengths; nothing if there is no such
    /// range.
    [[nodiscard]] virtual std::optional<NmRange> support(Outside outside) const {
        return outside == Outside::zero ? range() : std::nullopt;
    }
    [[nodiscard]] virtual std::span<const SpectralLine> lines() const { return {}; }
    [[nodiscard]] virtual std::span<const double> sampleWavelengths() const { return {}; }
    [[nodiscard]] virtual std::span<const double> sampleValues() const { return {}; }
    [[nodiscard]] virtual bool isConstant(Outside) const { return false; }
    /// A scaled copy, for bodies that hand out what they hold (samples, lines); the others are scaled by the
    /// Curve.
    [[nodiscard]] virtual std::shared_ptr<const Body> scaled(double) const { return nullptr; }
};

/// Appends abscissae inside (from, to) that cut it until a 4-point Gauss rule integrates f(λ) λ^k, k = 0…2,
/// over each piece within 1e-11 of |f|'s maximum there; at most 256 pieces.
void appendSmoothBreaks(const std::function<double(double)>& f, double from, double to,
                        std::vector<double>& out);

}  // namespace spectrad
