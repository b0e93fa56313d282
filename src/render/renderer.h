// The renderer: a plan made from a scene, then strips of rows from a device.
//
//   Plan plan = makePlan(scene, settings, library, notes);
//   Renderer renderer(device, plan);          // uploads the world, builds what the plan needs
//   renderer.render(sink, progress);
#pragma once

#include "opencl/device_body.h"
#include "render/plan.h"
#include "render/settings.h"

#include <functional>
#include <memory>

namespace spectrad {

class Renderer {
  public:
    /// Throws MachineError (device, memory with the numbers, compiler with its log).
    Renderer(const Device& device, const Plan& plan);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    void render(const StripSink& sink, const Progress& progress = {});
    /// The same, but the strips stay on the device: [row][band][pitch], for kernels.
    using DeviceSink = std::function<void(int firstRow, int rows, const cl::Buffer& bands, int pitch)>;
    void renderOnDevice(const DeviceSink& sink);
    [[nodiscard]] RenderTimes times() const;
    [[nodiscard]] int stripRows() const;                ///< rows a strip has on this device
    [[nodiscard]] std::uint64_t bytesPerStrip() const;  ///< device memory of a strip's buffers

  private:
    struct Body;
    std::unique_ptr<Body> body_;
};

}  // namespace spectrad
