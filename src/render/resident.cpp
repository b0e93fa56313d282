#include "render/resident.h"

#include "spectrum/mass_matrix.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace spectrad {

namespace {

/// Work-items that share an image: enough to fill the device, few enough that their scratch is small.
unsigned itemsOn(const Device& device) {
    constexpr unsigned perUnit = 4, perUnitOfGpu = 512;
    const unsigned units = std::max(device.info().computeUnits, 1u);
    return units * (device.body().vectorWidth() == 1 ? perUnitOfGpu : perUnit);
}

int halfOf(int side) {
    return std::max(side / 2, 1);
}

}  // namespace

size_t ResidentTexels::count(int ofLevels) const {
    size_t texels = 0;
    for (int level = 0, w = width, h = height; level < ofLevels; ++level, w = halfOf(w), h = halfOf(h))
        texels += static_cast<size_t>(w) * static_cast<size_t>(h);
    return texels * nm.size();
}

std::vector<float> ResidentTexels::read(int ofLevels) const {
    std::vector<float> host(count(ofLevels));
    values.read(device, host.data(), host.size(), "reading a texture");
    return host;
}

std::shared_ptr<const ResidentTexels> withLevels(const ResidentTexels& image) {
    const auto all = std::make_shared<ResidentTexels>(
        ResidentTexels{image.device, image.width, image.height, image.nm, {}});
    all->lost = image.lost;
    for (int w = image.width, h = image.height; w > 1 || h > 1; w = halfOf(w), h = halfOf(h))
        ++all->levels;
    const size_t finest = image.count(1);
    const DeviceInfo& info = image.device.info();
    const std::uint64_t bytes = sizeof(float) * all->count(all->levels);
    if (bytes > info.maxAllocationBytes || bytes > info.globalMemoryBytes / 3) return nullptr;
    all->values.reserve(image.device, all->count(all->levels), "the smaller levels of a texture");
    checked(image.device.body(), "copying a texture", [&] {
        image.device.body().queue.enqueueCopyBuffer(image.values.buffer(), all->values.buffer(), 0, 0,
                                                    finest * sizeof(float));
    });
    Kernel halve = vectorKernel(image.device, "pyramid.cl", "halve_texels");
    for (int level = 1, w = image.width, h = image.height; level < all->levels; ++level) {
        const int halfWidth = halfOf(w), halfHeight = halfOf(h);
        halve.set("texels", all->values.buffer())
            .set("from", static_cast<cl_ulong>(all->count(level - 1)))
            .set("width", static_cast<cl_uint>(w))
            .set("height", static_cast<cl_uint>(h))
            .set("to", static_cast<cl_ulong>(all->count(level)))
            .set("half_width", static_cast<cl_uint>(halfWidth))
            .set("half_height", static_cast<cl_uint>(halfHeight))
            .set("bands", static_cast<cl_uint>(image.nm.size()))
            .run(static_cast<size_t>(halfWidth) * static_cast<size_t>(halfHeight));
        w = halfWidth, h = halfHeight;
    }
    return all;
}

int stepsOn(const ResidentTexels& image, double inside, int power, double tolerance, int most) {
    const Device& device = image.device;
    const unsigned items = itemsOn(device);
    DeviceArray<std::uint32_t> found;
    std::uint32_t steps = 1;
    found.upload(device, &steps, 1, "the number of steps");
    vectorKernel(device, "steps.cl", "steps_needed")
        .set("texels", image.values.buffer())
        .set("count", static_cast<cl_ulong>(image.width) * static_cast<cl_ulong>(image.height))
        .set("bands", static_cast<cl_uint>(image.nm.size()))
        .set("z", 1 / inside)
        .set("power", static_cast<cl_uint>(power))
        .set("tolerance", tolerance)
        .set("most", static_cast<cl_uint>(most))
        .set("items", static_cast<cl_uint>(items))
        .set("found", found.buffer())
        .run(items);
    found.read(device, &steps, 1, "reading the number of steps");
    return static_cast<int>(steps);
}

float largestOn(const ResidentTexels& image) {
    const Device& device = image.device;
    const unsigned items = itemsOn(device);
    DeviceArray<float> found;
    float largest = 0;
    found.upload(device, &largest, 1, "the largest value");
    vectorKernel(device, "steps.cl", "largest_value")
        .set("texels", image.values.buffer())
        .set("count", static_cast<cl_ulong>(image.count(1)))
        .set("items", static_cast<cl_uint>(items))
        .set("found", found.buffer())
        .run(items);
    found.read(device, &largest, 1, "reading the largest value");
    return largest;
}

bool TexelStage::fits(const DeviceInfo& device, size_t bands, int width, int height) {
    const double bytes = double{sizeof(float)} * width * height * static_cast<double>(bands);
    return bytes <= static_cast<double>(device.maxAllocationBytes) &&
           bytes <= static_cast<double>(device.globalMemoryBytes) / 4;
}

TexelStage::TexelStage(const Device& device, const Wavelengths& grid, int width, int height, bool aboveZero)
    : device_(device),
      texels_(std::make_shared<ResidentTexels>(ResidentTexels{device, width, height, grid.nm, {}})),
      points_(grid.projection != Projection::slit || grid.size() < 2),
      aboveZero_(aboveZero),
      kernel_(vectorKernel(device, "nodes.cl", "nodal_texels")),
      items_(itemsOn(device)) {
    const size_t bands = grid.size();
    texels_->values.reserve(device, texels_->count(1), "the texture that a pass makes");
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
    const std::vector<std::uint64_t> none(items_, 0);
    lost_.upload(device, none.data(), none.size(), "a count");
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
        .set("above_zero", static_cast<cl_uint>(aboveZero_))
        .set("clipped", lost_.buffer())
        .set("texels", texels_->values.buffer())
        .run(items_);
}

std::shared_ptr<const ResidentTexels> TexelStage::finish() {
    if (aboveZero_) {
        std::vector<std::uint64_t> lost(items_);
        lost_.read(device_, lost.data(), lost.size(), "reading a count");
        texels_->lost = std::accumulate(lost.begin(), lost.end(), std::uint64_t{0});
    }
    return std::move(texels_);
}

}  // namespace spectrad
