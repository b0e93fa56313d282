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
    const Stopwatch start;
    Body& body = *body_;
    const int height = body.plan.view.height;
    body.stages->transform();
    int rows = body.memory.visibilityRows;
    for (int row = 0; row < height;) {
        const int count = std::min(rows, height - row);
        if (!body.stages->light(row, count)) {
            // The term image of these rows is larger than the device gives in one piece: take fewer.
            if (rows <= 1)
                throw MachineError(
                    fmt::format("the terms of row {} do not fit into the device's memory", row));
            rows = std::max(1, rows / 2);
            continue;
        }
        for (int done = 0; done < count; done += body.memory.cubeRows) {
            const int part = std::min(body.memory.cubeRows, count - done);
            body.stages->expand(done, part, body.cube, body.preview);
            body.deliver(row + done, part, sink);
            if (progress) progress(static_cast<double>(row + done + part) / height);
        }
        row += count;
    }
    body.times.render += start.seconds();
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
