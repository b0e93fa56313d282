// Materials in figures, for those who have to trust them: what was measured, what was changed, how large the
// errors of approximations are.
#pragma once

#include "render/fluorescence.h"
#include "scene/scene.h"
#include "spectrum/wavelengths.h"

#include <optional>
#include <string>
#include <vector>

namespace spectrad {

class Library;

/// The largest total (reflected and emitted) radiance factor over the output's bands under one light, of the
/// diffuse part without its coat. Bands where the light has less than a hundredth of its largest do not
/// count.
struct PeakRadianceFactor {
    std::string light;
    double nm = 0, value = 0;
};

/// How a coat's or metal's Fresnel reflectance is put together.
struct FresnelFigures {
    enum class Model { exact, schlick } model = Model::exact;
    size_t terms = 0;
    /// Exact: largest error as a share of the reflectance, over angles and the bands' wavelengths. Schlick:
    /// largest difference from the exact reflectance.
    double error = 0;
};

/// In uniform white light of radiance 1: what the material sends back, over its bands and all views, without
/// fluorescence; and of the light on its facets how much bounces on among them, which a model without
/// compensation loses.
struct FurnaceFigures {
    double least = 0, most = 0;
    double bouncing = 0;
};

struct MaterialReport {
    std::string name;
    std::vector<std::string> lobes;  ///< elements of the material, in the schema's order
    size_t terms = 0;                ///< under one light
    std::vector<FluorophoreFigures> fluorescence;
    std::vector<PeakRadianceFactor> peaks;
    std::optional<FresnelFigures> fresnel;
    std::optional<FurnaceFigures> furnace;  ///< none for what a texture colours, and for what only glows
};

/// One for each material of the scene that has a lobe; the built-in grey, without a name, where a surface
/// wears it. `grid`: the bands of the image.
[[nodiscard]] std::vector<MaterialReport> reportMaterials(const Scene& scene, const Wavelengths& grid,
                                                          const Library& library);

}  // namespace spectrad
