#include "render/columns.h"

#include <algorithm>

namespace spectrad {

Plan withColumns(Plan plan, std::vector<float> columns, size_t count) {
    plan.terms.bands = count;
    plan.terms.spectra = std::move(columns);
    plan.wavelengths = {};
    for (size_t k = 1; k <= count; ++k)
        plan.wavelengths.nm.push_back(static_cast<double>(k));
    return plan;
}

std::vector<std::vector<float>> renderColumns(Renderer& renderer, const Plan& plan,
                                              const Progress& progress) {
    const size_t count = plan.terms.bands, width = static_cast<size_t>(plan.view.width);
    std::vector<std::vector<float>> planes(count,
                                           std::vector<float>(width * static_cast<size_t>(plan.view.height)));
    renderer.render(
        [&](int firstRow, int rows, const float* values, const float*) {
            for (size_t row = 0; row < static_cast<size_t>(rows); ++row)
                for (size_t c = 0; c < count; ++c)
                    std::copy_n(values + (row * count + c) * width, width,
                                planes[c].data() + (static_cast<size_t>(firstRow) + row) * width);
        },
        progress);
    return planes;
}

}  // namespace spectrad
