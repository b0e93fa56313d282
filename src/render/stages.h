// The stages on the device, one method each, over buffers that stay. Order: transform once, then for each
// strip light (coverage and g: the term image) and expand (g · c).
#pragma once

#include "opencl/program.h"
#include "render/plan.h"
#include "render/samples.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace spectrad {

/// The term image of a strip on the device: blocks of SD_BLOCK pixels, each with its list of terms and their
/// g.
struct TermImage {
    int firstRow = 0, rows = 0;
    std::uint32_t blocks = 0;
    DeviceArray<std::uint32_t>
        first;  ///< blocks + 1: where a block's terms start, in `term`; times SD_BLOCK, in `g`
    DeviceArray<std::uint32_t> term;  ///< numbers into the term table
    DeviceArray<float> g;             ///< SD_BLOCK a term
};

/// From sums of terms' previews to a display's codes.
struct ShownThrough {
    std::array<float, 9> matrix{};    ///< rows: linear Rec.709 preview to the display's linear signals
    std::vector<float> threshold;     ///< 255: the signal from which on code k + 1 is shown instead of k
    std::vector<std::uint8_t> start;  ///< SD_SHOW_CELLS: the code at the start of each cell of 0…1
};

class Stages {
  public:
    /// Uploads the world and builds the kernels that the plan needs.
    Stages(const Device& device, const Plan& plan, const LanePattern& lanes);

    /// Another camera, and what it changes; then transform() again.
    void move(const View& view, const std::vector<sd_draw>& draws, const std::vector<sd_light>& lights);
    void transform();
    /// Coverage of `rows` rows: fills keys().
    void cover(int firstRow, int rows);
    /// Coverage and lighting of `rows` rows: fills the term image. False if it is too large for the device.
    bool light(int firstRow, int rows);
    /// Rows [from, from + rows) of the lit strip, into cube [row][band][pitch] and preview [row][3][pitch].
    void expand(int from, int rows, DeviceArray<float>& cube, DeviceArray<float>& preview);

    /// Preview alone, from `preview` spectra (three a term) of the caller's, into [row][3][pitch].
    void expandPreview(const std::vector<float>& spectra, DeviceArray<float>& preview);
    /// The lit strip as a display shows it, 0xAABBGGRR a pixel, [row][pitch] (kernels/show.cl).
    void show(const std::vector<float>& spectra, const ShownThrough& through,
              DeviceArray<std::uint32_t>& pixels);
    /// Gives the term image away and takes another (or an empty one) to fill: for images kept in several
    /// strips.
    void exchange(TermImage& other) { std::swap(image_, other); }

    [[nodiscard]] int pitch() const { return frame_.pitch; }
    [[nodiscard]] const TermImage& terms() const { return image_; }
    [[nodiscard]] const DeviceArray<std::uint64_t>& keys() const { return keys_; }

  private:
    void uploadWorld();
    void uploadTextures();
    /// Boxes around all that throws shadows, where it stands now.
    void boundCasters();
    /// Those of the one pass that the scene shows, where that is its only texture; ownTexels_ else.
    [[nodiscard]] const cl::Buffer& texels() const;
    void expandRows(int from, int rows, const DeviceArray<float>& spectra,
                    const DeviceArray<std::uint32_t>& spans, size_t bands, DeviceArray<float>& out,
                    const char* what);
    void coverLarge(std::uint32_t large, std::uint32_t clipped);
    std::uint32_t readNumber(const cl::Buffer& buffer, size_t index);
    void zero(const cl::Buffer& buffer, size_t words);

    Device device_;
    const Plan& plan_;
    sd_frame frame_{};
    std::uint32_t triangles_ = 0, vertices_ = 0, casterCount_ = 0, words_ = 1;
    size_t slots_ = 1;

    Program geometry_, shading_;
    Kernel transform_, tangents_, clear_, small_, setup_, clip_, count_, scan_, deal_, tiles_, boundLeaves_,
        boundNodes_;
    Kernel find_, scanTerms_, list_, light_, expand_, show_;

    DeviceArray<float> position_, normal_, tangent_, camera_, cameraNormal_, cameraTangent_, coordinates_,
        ownTexels_, spectra_, previewSpectra_;
    DeviceArray<std::uint32_t> vertexDraw_, index_, triangleMaterial_, casters_;
    DeviceArray<float> bounds_;  ///< six a node, from node 0, which is none
    DeviceArray<sd_draw> draws_;
    DeviceArray<sd_vertex> screen_;
    DeviceArray<sd_material> materials_;
    DeviceArray<sd_lobe> lobes_;
    DeviceArray<sd_piece> tables_;
    DeviceArray<sd_light> lights_;
    DeviceArray<sd_texture> textures_;
    DeviceArray<std::uint32_t> spans_, previewSpans_;
    DeviceArray<float> shownColours_, threshold_;
    DeviceArray<std::uint32_t> shownSpans_;
    DeviceArray<std::uint8_t> codeStart_;
    DeviceArray<std::int32_t> laneX_, laneY_, used_;

    DeviceArray<std::uint64_t> keys_;
    DeviceArray<std::uint32_t> largeList_, clipList_, counters_, tileCounts_, tileFirst_, tileList_, sets_,
        blockTerms_;
    DeviceArray<sd_large> records_;
    TermImage image_;
};

/// Device memory seen by the host while this lives.
class MappedFloats {
  public:
    MappedFloats(const Device& device, const cl::Buffer& buffer, size_t count);
    ~MappedFloats();
    MappedFloats(const MappedFloats&) = delete;
    MappedFloats& operator=(const MappedFloats&) = delete;
    [[nodiscard]] const float* data() const { return data_; }

  private:
    Device device_;
    const cl::Buffer& buffer_;  ///< outlives this: a copy would be a call that can fail
    float* data_ = nullptr;
};

}  // namespace spectrad
