#include "render/divided.h"

namespace spectrad {

std::optional<PixelPlace> divideByWhite(Cube& cube, const Cube& white, const Cube& coverage) {
    const auto width = static_cast<size_t>(cube.info.width);
    const size_t bands = cube.info.wavelengths.size();
    for (int row = 0; row < cube.info.height; ++row) {
        for (size_t x = 0; x < width; ++x) {
            const double diffuser = white.row(row, 0)[x];
            if (!(diffuser > 0)) {
                if (coverage.row(row, 0)[x] > 0) return PixelPlace{static_cast<int>(x), row};
                continue;
            }
            for (size_t band = 0; band < bands; ++band) {
                float& value = cube.values[(static_cast<size_t>(row) * bands + band) * width + x];
                value = static_cast<float>(value / diffuser);
            }
        }
    }
    return std::nullopt;
}

DivisionStage::DivisionStage(const Device& device, int pitch, int width, int height)
    : device_(device),
      pitch_(static_cast<size_t>(pitch)),
      width_(width),
      height_(height),
      dark_(vectorKernel(device, "division.cl", "find_dark")),
      divide_(vectorKernel(device, "division.cl", "divide_by_white")) {
    const size_t pixels = pitch_ * static_cast<size_t>(height);
    white_.reserve(device, pixels, "what a white diffuser sends back");
    coverage_.reserve(device, pixels, "where something is seen");
}

void DivisionStage::addRows(DeviceArray<float>& image, const cl::Buffer& strip, int firstRow, int rows) {
    checked(device_.body(), "keeping a strip", [&] {
        const size_t row = pitch_ * sizeof(float);
        device_.body().queue.enqueueCopyBuffer(strip, image.buffer(), 0, static_cast<size_t>(firstRow) * row,
                                               static_cast<size_t>(rows) * row);
    });
}

void DivisionStage::addWhite(const cl::Buffer& strip, int firstRow, int rows) {
    addRows(white_, strip, firstRow, rows);
}

void DivisionStage::addCoverage(const cl::Buffer& strip, int firstRow, int rows) {
    addRows(coverage_, strip, firstRow, rows);
}

std::optional<PixelPlace> DivisionStage::dark() {
    constexpr cl_ulong nowhere = ~cl_ulong{0};
    cl_ulong at = nowhere;
    DeviceArray<cl_ulong> found;
    found.upload(device_, &at, 1, "a pixel's place");
    dark_.set("white", white_.buffer())
        .set("coverage", coverage_.buffer())
        .set("pitch", static_cast<cl_uint>(pitch_))
        .set("width", static_cast<cl_uint>(width_))
        .set("rows", static_cast<cl_uint>(height_))
        .set("found", found.buffer())
        .run(static_cast<size_t>(height_));
    found.read(device_, &at, 1, "reading a pixel's place");
    if (at == nowhere) return std::nullopt;
    const auto width = static_cast<cl_ulong>(width_);
    return PixelPlace{static_cast<int>(at % width), static_cast<int>(at / width)};
}

void DivisionStage::divide(const cl::Buffer& cube, size_t bands, int firstRow, int rows) {
    const auto lanes = static_cast<size_t>(device_.body().vectorWidth());
    divide_.set("cube", cube)
        .set("white", white_.buffer())
        .set("pitch", static_cast<cl_uint>(pitch_))
        .set("rows", static_cast<cl_uint>(rows))
        .set("bands", static_cast<cl_uint>(bands))
        .set("first", static_cast<cl_uint>(firstRow))
        .run(pitch_ / lanes * static_cast<size_t>(rows));
}

}  // namespace spectrad
