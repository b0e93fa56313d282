// Materials in the answer of `spectrad info SCENE`.
#pragma once

#include "cli/console.h"
#include "render/material_report.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace spectrad {

[[nodiscard]] Json described(const std::vector<MaterialReport>& materials);
/// Those that are more than a plain diffuse reflectance, a paragraph each.
void printMaterials(const std::vector<MaterialReport>& materials);

}  // namespace spectrad
