// What makes a cube's file a measurement: which scene, how, with what, under which white.
#pragma once

#include "image/cube.h"
#include "opencl/device.h"
#include "render/plan.h"

namespace spectrad {

/// `software` with its version; `command`: what decides which picture it is, as a command line.
[[nodiscard]] CubeInfo cubeInfoOf(const Scene& scene, const Plan& plan, const Device& device,
                                  const std::string& software, const std::string& command);

}  // namespace spectrad
