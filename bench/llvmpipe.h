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
    /// `lit`: smooth normals and a lamp at the eye, Lambert in linear RGB a pixel, as an RGB renderer has it.
    Llvmpipe(const Plan& plan, int samples, bool lit = false);
    ~Llvmpipe();
    Llvmpipe(const Llvmpipe&) = delete;
    Llvmpipe& operator=(const Llvmpipe&) = delete;

    /// Where the plan's vertices stand before the camera from now on.
    void look(const Affine& toCamera);
    /// Clears colour and depth, draws everything, waits until it is drawn.
    void draw();
    [[nodiscard]] size_t coveredPixels();
    [[nodiscard]] std::string name() const;

  private:
    struct Body;
    std::unique_ptr<Body> body_;
};

}  // namespace spectrad::bench
