// The peer of the visibility benchmark: Mesa's llvmpipe off screen, depth test on, one flat colour a
// triangle.
#pragma once

#include "render/plan.h"

#include <memory>
#include <string>

namespace spectrad::bench {

class Llvmpipe {
  public:
    /// Vertices and triangles of the plan's world in vertex buffer objects, drawn into a frame buffer object
    /// of the view's size with `samples` per pixel. Throws MachineError if Mesa does not give that.
    Llvmpipe(const Plan& plan, int samples);
    ~Llvmpipe();
    Llvmpipe(const Llvmpipe&) = delete;
    Llvmpipe& operator=(const Llvmpipe&) = delete;

    /// Clears colour and depth, draws everything, waits until it is drawn.
    void draw();
    [[nodiscard]] size_t coveredPixels();
    [[nodiscard]] std::string name() const;

  private:
    struct Body;
    std::unique_ptr<Body> body_;
};

}  // namespace spectrad::bench
