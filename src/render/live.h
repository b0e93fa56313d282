// An image that stays on the device, to be looked at in many ways: its terms' colours are the caller's, so
// that another light, eye or display costs three floats a term; only another camera rasterizes again.
#pragma once

#include "colour/display.h"
#include "colour/observe.h"
#include "opencl/device.h"
#include "render/plan.h"
#include "render/stages.h"

#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

namespace spectrad {

/// From preview values to codes of a display, exactly as develop() makes them: `toSignals` takes absolute XYZ
/// to the display's linear signals.
[[nodiscard]] ShownThrough shownThrough(const Matrix3& toSignals, const Display& display);

/// What each pixel of a resolved image is made of, read through the reader's own queue: it stays as it was
/// while the image it comes from goes on, on another thread even.
class SeenTerms {
  public:
    /// The terms of a pixel and their g; none outside.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, float>> at(const Device& reader, int x, int y) const;

  private:
    friend class LiveImage;
    struct Strip {
        int firstRow = 0, rows = 0;
        cl::Buffer first, term, g;  ///< see TermImage
    };
    std::vector<Strip> strips_;
    int width_ = 0, pitch_ = 0;
};

class LiveImage {
  public:
    LiveImage(const Device& device, Plan plan);
    LiveImage(const LiveImage&) = delete;
    LiveImage& operator=(const LiveImage&) = delete;

    [[nodiscard]] const Plan& plan() const { return plan_; }
    [[nodiscard]] const std::vector<Affine>& drawToWorld() const { return drawToWorld_; }
    /// Another camera or size of the picture; the geometry stays as it was cut into triangles.
    void move(const View& view, const Scene& scene, const FlatScene& flat);
    /// Materials, lights and terms of a plan without geometry, of the same scene with other materials. Then
    /// move(): its lights stand before the scene's own camera.
    void wear(Plan shading);
    /// Coverage and light with so many samples a pixel, unless that is there already. Throws Stopped between
    /// strips if that is asked for; then nothing is resolved.
    void resolve(int samples, const std::stop_token& stop = {});

    /// The picture, 0xAABBGGRR a pixel, row 0 on top; A is 255, 254 outside the display's gamut.
    void show(const std::vector<float>& colours, const ShownThrough& through,
              std::vector<std::uint32_t>& pixels);
    /// XYZ, absolute: what `colours` are in place of the plan's preview (see TermTable).
    [[nodiscard]] ChannelImage xyz(const std::vector<float>& colours);
    /// The terms of what is resolved. While somebody has them, their memory is not written again.
    [[nodiscard]] std::shared_ptr<const SeenTerms> seen();
    /// The triangle seen by the first sample of a pixel.
    [[nodiscard]] std::optional<std::uint32_t> triangleAt(int x, int y);

  private:
    struct Pipeline {
        Plan plan;  ///< of the scene with so many samples; its geometry is on the device alone
        LanePattern lanes;
        std::unique_ptr<Stages> stages;
        int rows = 1;       ///< of a strip
        bool moved = true;  ///< the camera, since the last transform()
    };
    Pipeline& pipeline(int samples);
    /// Calls `see(firstRow, rows)` for each strip with its term image in the stages.
    template <typename See>
    void eachStrip(See see);

    Device device_;
    Plan plan_;
    std::vector<Affine> drawToWorld_;
    std::map<int, Pipeline> pipelines_;
    Pipeline* current_ = nullptr;  ///< whose samples `strips_` are
    std::vector<TermImage> strips_;
    std::weak_ptr<const SeenTerms> seen_;  ///< of strips_
    DeviceArray<float> preview_;
    DeviceArray<std::uint32_t> pixels_;
};

}  // namespace spectrad
