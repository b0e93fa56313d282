#include "render/resident.h"

#include "spectrum/mass_matrix.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <string>

namespace spectrad {

namespace {

/// Work-items that share an image: enough to fill the device, few enough that their scratch is small.
unsigned itemsOn(const Device& device) {
    constexpr unsigned perUnit = 4, perUnitOfGpu = 512;
    const unsigned units = std::max(device.info().computeUnits, 1u);
    return units * (device.body().vectorWidth() == 1 ? perUnitOfGpu : perUnit);
}

Kernel nodalTexels(const Device& device) {
    return Program(device, {"nodes.cl"}, {"VW=" + std::to_string(device.body().vectorWidth())})
        .kernel("nodal_texels");
}

}  // namespace

std::vector<float> ResidentTexels::read() const {
    std::vector<float> host(count());
    checked(device.body(), "reading a texture", [&] {
        device.body().queue.enqueueReadBuffer(values.buffer(), CL_TRUE, 0, host.size() * sizeof(float),
                                              host.data());
    });
    return host;
}

bool TexelStage::fits(const DeviceInfo& device, size_t bands, int width, int height) {
    const double bytes = double{sizeof(float)} * width * height * static_cast<double>(bands);
    return bytes <= static_cast<double>(device.maxAllocationBytes) &&
           bytes <= static_cast<double>(device.globalMemoryBytes) / 4;
}

TexelStage::TexelStage(const Device& device, const Wavelengths& grid, int width, int height)
    : device_(device),
      texels_(std::make_shared<ResidentTexels>(ResidentTexels{device, width, height, grid.nm, {}})),
      points_(grid.projection != Projection::slit || grid.size() < 2),
      kernel_(nodalTexels(device)),
      items_(itemsOn(device)) {
    const size_t bands = grid.size();
    texels_->values.reserve(device, texels_->count(), "the texture that a pass makes");
    std::vector<double> area(bands, 1.0), forward(bands, 0.0), off(bands, 0.0), inverse(bands, 1.0);
    if (!points_) {
        const MassMatrix mass(grid.nm);
        for (size_t j = 0; j < bands; ++j) {
            area[j] = band(grid, j).area();
            inverse[j] = mass.inverse()[j];
            if (j + 1 < bands) off[j] = mass.off()[j];
            if (j > 0) forward[j] = mass.off()[j - 1] * mass.inverse()[j - 1];
        }
    }
    const char* what = "the bands' weights";
    area_.upload(device, area.data(), bands, what);
    forward_.upload(device, forward.data(), bands, what);
    off_.upload(device, off.data(), bands, what);
    inverse_.upload(device, inverse.data(), bands, what);
    const auto lanes = static_cast<size_t>(device.body().vectorWidth());
    scratch_.reserve(device, points_ ? 1 : items_ * bands * lanes, "sums over bands");
}

void TexelStage::add(const cl::Buffer& cube, int pitch, int firstRow, int rows) {
    kernel_.set("cube", cube)
        .set("pitch", static_cast<cl_uint>(pitch))
        .set("width", static_cast<cl_uint>(texels_->width))
        .set("rows", static_cast<cl_uint>(rows))
        .set("bands", static_cast<cl_uint>(texels_->nm.size()))
        .set("points", static_cast<cl_uint>(points_))
        .set("area", area_.buffer())
        .set("forward", forward_.buffer())
        .set("off", off_.buffer())
        .set("inverse", inverse_.buffer())
        .set("scratch", scratch_.buffer())
        .set("items", static_cast<cl_uint>(items_))
        .set("first", static_cast<cl_ulong>(firstRow) * static_cast<cl_ulong>(texels_->width))
        .set("texels", texels_->values.buffer())
        .run(items_);
}

}  // namespace spectrad
