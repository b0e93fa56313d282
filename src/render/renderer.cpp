// Strips of rows through the stages, in order: clear → cover (small, large, clipped triangles) → find
// materials → light → expand. Buffers are made once and grow; nothing is as large as the image.
#include "render/renderer.h"

#include "base/stopwatch.h"
#include "render/memory_plan.h"
#include "render/samples.h"
#include "render/stages.h"

#include <fmt/format.h>

#include <cstring>

namespace spectrad {

struct Renderer::Body {
    Body(const Device& d, const Plan& p)
        : device(d),
          plan(p),
          lanes(lanePattern(p.samples, d.body().vectorWidth())),
          memory(planMemory(p, d.info(), lanes.slots)) {
        const Stopwatch start;
        stages = std::make_unique<Stages>(device, plan, lanes);
        times.build = start.seconds();
    }

    void deliver(int firstRow, int rows, const StripSink& sink);
    /// Every strip, finished in `cube` and `preview`: done(first row, rows).
    void strips(const std::function<void(int, int)>& done);

    Device device;
    const Plan& plan;
    LanePattern lanes;
    MemoryPlan memory;
    std::unique_ptr<Stages> stages;
    DeviceArray<float> cube, preview;
    std::vector<float> tightCube, tightPreview;
    RenderTimes times;
};

Renderer::Renderer(const Device& device, const Plan& plan) : body_(std::make_unique<Body>(device, plan)) {}
Renderer::~Renderer() = default;
RenderTimes Renderer::times() const {
    return body_->times;
}
int Renderer::stripRows() const {
    return body_->memory.cubeRows;
}
std::uint64_t Renderer::bytesPerStrip() const {
    return body_->memory.bytes;
}

void Renderer::render(const StripSink& sink, const Progress& progress) {
    Body& body = *body_;
    body.strips([&](int row, int rows) {
        body.deliver(row, rows, sink);
        if (progress) progress(static_cast<double>(row + rows) / body.plan.view.height);
    });
}

void Renderer::renderOnDevice(const DeviceSink& sink) {
    Body& body = *body_;
    body.strips([&](int row, int rows) { sink(row, rows, body.cube.buffer(), body.stages->pitch()); });
}

void Renderer::Body::strips(const std::function<void(int, int)>& done) {
    const Stopwatch start;
    const int height = plan.view.height;
    stages->transform();
    int rows = memory.visibilityRows;
    for (int row = 0; row < height;) {
        const int count = std::min(rows, height - row);
        if (!stages->light(row, count)) {
            // The term image of these rows is larger than the device gives in one piece: take fewer.
            if (rows <= 1)
                throw MachineError(
                    fmt::format("the terms of row {} do not fit into the device's memory", row));
            rows = std::max(1, rows / 2);
            continue;
        }
        for (int from = 0; from < count; from += memory.cubeRows) {
            const int part = std::min(memory.cubeRows, count - from);
            stages->expand(from, part, cube, preview);
            done(row + from, part);
        }
        row += count;
    }
    times.render += start.seconds();
}

namespace {

/// Rows without the padding of the device's pitch; where there is none, the device's own memory.
const float* tight(const float* padded, size_t lines, size_t pitch, size_t width, std::vector<float>& copy) {
    if (pitch == width) return padded;
    copy.resize(lines * width);
    for (size_t line = 0; line < lines; ++line)
        std::memcpy(copy.data() + line * width, padded + line * pitch, width * sizeof(float));
    return copy.data();
}

}  // namespace

void Renderer::Body::deliver(int firstRow, int rows, const StripSink& sink) {
    const auto pitch = static_cast<size_t>(stages->pitch()), width = static_cast<size_t>(plan.view.width);
    const size_t cubeLines = static_cast<size_t>(rows) * plan.terms.bands,
                 previewLines = static_cast<size_t>(rows) * 3;
    const MappedFloats cubeMap(device, cube.buffer(), cubeLines * pitch),
        previewMap(device, preview.buffer(), previewLines * pitch);
    const float* bands = tight(cubeMap.data(), cubeLines, pitch, width, tightCube);
    const float* linear = tight(previewMap.data(), previewLines, pitch, width, tightPreview);
    const Stopwatch handedOver;
    sink(firstRow, rows, bands, linear);
    times.render -= handedOver.seconds();
}

}  // namespace spectrad
