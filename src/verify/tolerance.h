// How wrong an image may be.
#pragma once

#include "verify/certificate.h"

#include <string>
#include <string_view>

namespace spectrad {

/// "0.5": ΔE00 of 99 % of the pixels; "max:0.5": of all; "1%rad", "max:1%rad": the largest error of a pixel's
/// bands ÷ the image's largest value in that band, in percent.
struct Tolerance {
    double bound = 0;       ///< ΔE00, or a share (0.01 of 1 %)
    bool all = false;       ///< else 99 % of the pixels
    bool radiance = false;  ///< of bands, else ΔE00

    [[nodiscard]] std::string words() const;  ///< "CIEDE2000 of 99 % of the pixels within 0.5"
};
/// Throws UsageError.
[[nodiscard]] Tolerance parseTolerance(std::string_view text);

/// What a certificate says of it.
enum class Verdict {
    proven,  ///< within the bound with the certificate's confidence
    open,    ///< neither proven nor refuted by this sample
    refuted  ///< beyond
};
[[nodiscard]] Verdict judged(const Certificate& certificate, const Tolerance& tolerance);
[[nodiscard]] std::string_view name(Verdict verdict);

}  // namespace spectrad
