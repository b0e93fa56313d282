// What makes a cube's file a measurement: which scene, how, with what, under which white.
#pragma once

#include "image/cube.h"
#include "opencl/device.h"
#include "render/plan.h"

namespace spectrad {

/// Size, bands and what is held; of a camera that looks all around its six faces, one below the other.
[[nodiscard]] CubeInfo cubeInfoOf(const Plan& plan);
/// The same with everything that makes it a measurement. `software` with its version; `command`: what decides
/// which picture it is, as a command line.
[[nodiscard]] CubeInfo cubeInfoOf(const Scene& scene, const Plan& plan, const Device& device,
                                  const std::string& software, const std::string& command);

}  // namespace spectrad
