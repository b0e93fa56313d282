// Chromatic adaptation by scaling cone-like responses (von Kries), complete: the old white becomes the new
// one.
#include "base/text.h"
#include "colour/colour.h"

#include <vector>

namespace spectrad {

/// XYZ → cone-like responses.
static constexpr Matrix3 cat16Cones{
    {{0.401288, 0.650173, -0.051461},  // Li et al., Color Res. Appl. 42 (2017), 703–718
     {-0.250268, 1.204414, 0.045854},
     {-0.002079, 0.048952, 0.953127}}};
static constexpr Matrix3 bradfordCones{{{0.8951, 0.2664, -0.1614},  // Lam 1985; as in ICC.1
                                        {-0.7502, 1.7135, 0.0367},
                                        {0.0389, -0.0685, 1.0296}}};
static constexpr Matrix3 huntPointerEstevezCones{
    {{0.40024, 0.70760, -0.08081},  // Fairchild, Color Appearance Models
     {-0.22630, 1.16532, 0.04570},
     {0, 0, 0.91822}}};

Adaptation parseAdaptation(std::string_view text) {
    if (text == "cat16") return Adaptation::cat16;
    if (text == "bradford") return Adaptation::bradford;
    if (text == "vonkries") return Adaptation::vonKries;
    if (text == "none") return Adaptation::none;
    const std::vector<std::string> known{"cat16", "bradford", "vonkries", "none"};
    throw UsageError("unknown adaptation '" + std::string(text) +
                     "' (allowed: cat16, bradford, vonkries, none)" + didYouMean(text, known));
}

static Triple coneResponses(const Matrix3& cones, const Triple& white) {
    if (!(white[1] > 0)) throw InputError("a white without luminance cannot be adapted to");
    const Triple response = cones * Triple{white[0] / white[1], 1, white[2] / white[1]};
    for (double r : response)
        if (!(r > 0))
            throw InputError(
                "a white of chromaticity x = " + rounded((*chromaticity(white))[0], 4) +
                ", y = " + rounded((*chromaticity(white))[1], 4) +
                " is too saturated for this adaptation (allowed: another method, another white, or none)");
    return response;
}

Matrix3 adaptation(Adaptation method, const Triple& from, const Triple& to) {
    if (method == Adaptation::none) return diagonal({1, 1, 1});
    const Matrix3& cones = method == Adaptation::cat16      ? cat16Cones
                           : method == Adaptation::bradford ? bradfordCones
                                                            : huntPointerEstevezCones;
    const Triple source = coneResponses(cones, from), target = coneResponses(cones, to);
    return inverse(cones) * diagonal({target[0] / source[0], target[1] / source[1], target[2] / source[2]}) *
           cones;
}

}  // namespace spectrad
