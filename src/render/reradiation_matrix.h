// A material's reflection and fluorescence as one Donaldson matrix, whatever it was written as.
#pragma once

#include "image/bispectral.h"
#include "scene/scene.h"

#include <span>
#include <string>
#include <vector>

namespace spectrad {

/// Radiance factors of the material's diffuse part, in the meaning of docs/format.md ("Fluorescence"): a cell
/// for each pair of the wavelengths (nm, ascending, at least two) whose emission is not below the excitation.
/// Where both are the same it is the reflectance there; else π times the radiance at `outNm` that a mean
/// irradiance of 1 W·m⁻²·nm⁻¹ in the band about `inNm` excites. What is emitted within the band of its own
/// excitation has no cell. Throws InputError for a material without fluorescence, or with textures in it.
[[nodiscard]] std::vector<BispectralCell> reradiationMatrix(const Material& material,
                                                            std::span<const double> nm, Notes& notes);

/// The same cells as text: emission_nm, then a column exNNN for each excitation.
[[nodiscard]] std::string bispectralCsv(std::span<const BispectralCell> cells);

}  // namespace spectrad
