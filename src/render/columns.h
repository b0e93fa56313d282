// Columns instead of bands: what is linear in a pixel's spectrum – a detector's channel, a coefficient, a
// colour through some bands – is rendered as if it were a band, several at once, from one geometry.
#pragma once

#include "render/renderer.h"

#include <vector>

namespace spectrad {

/// A plan whose "bands" are `count` columns; `columns`: of each term what it adds to them, [term][column].
/// Its "wavelengths" are their numbers, from 1.
[[nodiscard]] Plan withColumns(Plan plan, std::vector<float> columns, size_t count);

/// What `renderer` renders of its `plan`: [column][pixel].
[[nodiscard]] std::vector<std::vector<float>> renderColumns(Renderer& renderer, const Plan& plan,
                                                            const Progress& progress = {});

}  // namespace spectrad
