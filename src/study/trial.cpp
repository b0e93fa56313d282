#include "study/trial.h"

#include "base/stopwatch.h"
#include "render/cube_info.h"
#include "render/renderer.h"

#include <Imath/half.h>
#include <algorithm>
#include <bit>
#include <memory>

namespace spectrad {

namespace {

void keep(const OutputForm& form, std::vector<float>& values) {
    if (!form.half && form.mantissaBits >= 24) return;
    // Beyond half's range a file could not hold the value either (the writer says so).
    for (float& value : values)
        value = form.half ? static_cast<float>(Imath::half(value)) : keepBits(value, form.mantissaBits);
}

}  // namespace

float keepBits(float value, int bits) {
    if (bits >= 24) return value;
    const std::uint32_t dropped = 24u - static_cast<std::uint32_t>(bits);
    const std::uint32_t word = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t halfway = (1u << (dropped - 1)) - 1 + (word >> dropped & 1u);  // ties to even
    return std::bit_cast<float>((word + halfway) & ~((1u << dropped) - 1));
}

Trial tryOut(const Device& device, const Entry& entry, const OutputForm& form,
             const TrialSettings& settings) {
    const Plan& plan = entry.plan;
    const size_t bands = plan.terms.bands, width = static_cast<size_t>(plan.view.width);
    Renderer renderer(device, plan);
    Trial trial;
    trial.stripBytes = renderer.bytesPerStrip();
    trial.cube.info = cubeInfoOf(plan);
    trial.cube.info.height = plan.view.height;  // of a camera that looks all around one face
    trial.xyz = ChannelImage(plan.view.width, plan.view.height, entry.weights.weights.size());
    const bool whole = settings.keepCube || !settings.file.empty();
    std::vector<float> preview;
    for (int round = 0; round < settings.rounds; ++round) {
        double spent = 0;
        const Stopwatch start;
        renderer.render([&](int firstRow, int rows, const float* values, const float* rgb) {
            if (round > 0) return;
            const Stopwatch now;
            const size_t count = static_cast<size_t>(rows) * width;
            std::vector<float> strip(values, values + count * bands);
            keep(form, strip);
            for (int row = 0; row < rows; ++row)
                observeRow(entry.weights, strip.data() + static_cast<size_t>(row) * bands * width,
                           firstRow + row, trial.xyz);
            if (whole) {
                trial.cube.values.insert(trial.cube.values.end(), strip.begin(), strip.end());
                preview.insert(preview.end(), rgb, rgb + count * 3);
            }
            spent += now.seconds();
        });
        const double seconds = start.seconds() - spent;
        trial.renderSeconds = round == 0 ? seconds : std::min(trial.renderSeconds, seconds);
    }
    if (!settings.file.empty()) {
        WriteOptions options;
        options.half = form.half;
        options.compression = form.compression;
        const Stopwatch start;
        const auto writer = createExr(settings.file, trial.cube.info, options);
        writer->write(plan.view.height, trial.cube.values.data(), preview.data());
        writer->finish();
        trial.writeSeconds = start.seconds();
        trial.fileBytes = std::filesystem::file_size(settings.file);
        std::filesystem::remove(settings.file);
    }
    if (!settings.keepCube) trial.cube.values = {};
    return trial;
}

std::vector<double> spectrumAt(const Device& device, const Entry& entry, int x, int y) {
    const size_t bands = entry.plan.terms.bands, width = static_cast<size_t>(entry.plan.view.width);
    std::vector<double> spectrum(bands);
    Renderer renderer(device, entry.plan);
    renderer.render([&](int firstRow, int rows, const float* values, const float*) {
        if (y < firstRow || y >= firstRow + rows) return;
        for (size_t band = 0; band < bands; ++band)
            spectrum[band] =
                values[(static_cast<size_t>(y - firstRow) * bands + band) * width + static_cast<size_t>(x)];
    });
    return spectrum;
}

}  // namespace spectrad
