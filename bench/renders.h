// Renders as contestants.
#pragma once

#include "render/renderer.h"

#include <functional>
#include <memory>
#include <vector>

namespace spectrad::bench {

/// Each plan's render, its strips left where they are. The plans must outlive them.
inline std::vector<std::function<void()>> rendersOf(const Device& device, const std::vector<Plan>& plans) {
    std::vector<std::function<void()>> contestants;
    for (const Plan& plan : plans)
        contestants.emplace_back([renderer = std::make_shared<Renderer>(device, plan)] {
            renderer->render([](int, int, const float*, const float*) {});
        });
    return contestants;
}

}  // namespace spectrad::bench
