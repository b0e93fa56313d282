#include "render/shown.h"

#include "colour/detector.h"
#include "colour/observe.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

struct Primaries {
    std::array<std::vector<double>, 3> bands;  ///< radiances at full drive
    Matrix3 fromXyz;
};

Primaries primariesOf(const Screen& screen, const Wavelengths& grid, const Detector& observer) {
    Matrix3 toXyz{};
    for (size_t k = 0; k < 3; ++k) {
        const std::array<const Curve*, 1> curve{&screen.primaries.curves[k]};
        const Triple xyz = respondXyz(observer, curve);
        for (size_t row = 0; row < 3; ++row)
            toXyz[row][k] = xyz[row];
    }
    const double white = toXyz[1][0] + toXyz[1][1] + toXyz[1][2];
    const double scale = screen.luminance > 0 ? screen.luminance / white : 1;
    const double volume = determinant(toXyz);
    if (!(white > 0) || !(std::abs(volume) > 1e-9 * white * white * white))
        throw InputError(screen.where, "the display's primaries '" + screen.primaries.text +
                                           "' are not of three different colours");
    for (Triple& row : toXyz)
        for (double& value : row)
            value *= scale;
    Primaries primaries;
    primaries.fromXyz = inverse(toXyz);
    for (size_t k = 0; k < 3; ++k) {
        const std::array<const Curve*, 1> curve{&screen.primaries.curves[k]};
        primaries.bands[k] = project(grid, curve);
        for (double& value : primaries.bands[k])
            value *= scale;
    }
    return primaries;
}

void noteClipped(const std::string& display, size_t clipped, size_t pixels, Notes& notes) {
    if (clipped > 0)
        notes.say(
            fmt::format("display '{}': {:.2f} % of the pixels lie outside what it shows and were clipped",
                        display, 100.0 * static_cast<double>(clipped) / static_cast<double>(pixels)));
}

}  // namespace

Cube shownOn(const Screen& screen, Cube cube, const Library& library, Notes& notes) {
    const Detector observer = standardObserver(library), detector = detectorFrom(screen.detector);
    const Wavelengths& grid = cube.info.wavelengths;
    const DetectorWeights weights = weightsOn(grid, detector);
    const XyzMatrix toObserver = towardsXyz(detector, observer);
    const Primaries primaries = primariesOf(screen, grid, observer);
    const auto width = static_cast<size_t>(cube.info.width);
    // Rounding alone is no clipping.
    constexpr double tolerated = 1e-6;
    size_t clipped = 0;
    ChannelImage row(cube.info.width, 1, detector.size());
    for (size_t y = 0; y < static_cast<size_t>(cube.info.height); ++y) {
        float* bands = cube.values.data() + y * grid.size() * width;
        observeRow(weights, bands, 0, row);
        const ChannelImage xyz = toXyz(toObserver, row);
        for (size_t x = 0; x < width; ++x) {
            Triple drive = primaries.fromXyz * xyz.triple(x);
            const auto outside = [&](double d) { return d < -tolerated || d > 1 + tolerated; };
            clipped += std::any_of(drive.begin(), drive.end(), outside);
            for (double& d : drive)
                d = std::clamp(d, 0.0, 1.0);
            for (size_t band = 0; band < grid.size(); ++band)
                bands[band * width + x] = static_cast<float>(drive[0] * primaries.bands[0][band] +
                                                             drive[1] * primaries.bands[1][band] +
                                                             drive[2] * primaries.bands[2][band]);
        }
    }
    noteClipped(screen.primaries.text, clipped, width * static_cast<size_t>(cube.info.height), notes);
    return cube;
}

ScreenStage::ScreenStage(const Device& device, const Screen& screen, const Wavelengths& grid,
                         const Library& library, int width)
    : device_(device),
      name_(screen.primaries.text),
      bands_(grid.size()),
      channels_(0),
      width_(width),
      kernel_(vectorKernel(device, "screen.cl", "show_on_screen")) {
    const Detector observer = standardObserver(library), detector = detectorFrom(screen.detector);
    channels_ = detector.size();
    const auto up = [&](DeviceArray<double>& array, const auto& rows) {
        std::vector<double> all;
        for (const auto& row : rows)
            all.insert(all.end(), row.begin(), row.end());
        array.upload(device, all.data(), all.size(), "a display's weights");
    };
    const Primaries primaries = primariesOf(screen, grid, observer);
    up(weights_, weightsOn(grid, detector).weights);
    up(matrix_, towardsXyz(detector, observer));
    up(drives_, primaries.fromXyz);
    up(primaries_, primaries.bands);
    constexpr std::uint64_t nowhere = ~std::uint64_t{0}, none = 0;
    bad_.upload(device, &nowhere, 1, "a pixel's place");
    clipped_.upload(device, &none, 1, "a count");
}

void ScreenStage::show(const cl::Buffer& cube, int pitch, int firstRow, int rows) {
    const auto lanes = static_cast<size_t>(device_.body().vectorWidth());
    kernel_.set("cube", cube)
        .set("pitch", static_cast<cl_uint>(pitch))
        .set("width", static_cast<cl_uint>(width_))
        .set("rows", static_cast<cl_uint>(rows))
        .set("bands", static_cast<cl_uint>(bands_))
        .set("first", static_cast<cl_uint>(firstRow))
        .set("channels", static_cast<cl_uint>(channels_))
        .set("weights", weights_.buffer())
        .set("matrix", matrix_.buffer())
        .set("drives", drives_.buffer())
        .set("primaries", primaries_.buffer())
        .set("bad", bad_.buffer())
        .set("clipped", clipped_.buffer())
        .run(static_cast<size_t>(pitch) / lanes * static_cast<size_t>(rows));
}

void ScreenStage::finish(size_t pixels, Notes& notes) {
    std::uint64_t bad = 0, clipped = 0;
    bad_.read(device_, &bad, 1, "reading a pixel's place");
    clipped_.read(device_, &clipped, 1, "reading what a display clipped");
    const auto width = static_cast<std::uint64_t>(width_);
    if (bad != ~std::uint64_t{0})
        throw InputError(
            fmt::format("pixel ({}, {}) holds a value that is no finite number", bad % width, bad / width));
    noteClipped(name_, clipped, pixels, notes);
}

}  // namespace spectrad
