// How large a picture is that settings are tried on.
#pragma once

#include "render/plan.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

/// Pictures of a few hundred thousand pixels tell as much as large ones, in a fraction of the time: at most
/// 480 pixels a side where no size is asked for.
inline void limitSize(RenderSettings& render, const Plan& plan) {
    if (render.size) return;
    constexpr int longest = 480;
    const int side = std::max(plan.view.width, plan.view.height);
    if (side <= longest) return;
    const auto scaled = [&](int n) {
        return std::max(1, static_cast<int>(std::lround(double{1} * n * longest / side)));
    };
    render.size = {scaled(plan.view.width), scaled(plan.view.height)};
}

}  // namespace spectrad
