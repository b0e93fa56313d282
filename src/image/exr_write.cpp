#include "base/files.h"
#include "base/text.h"
#include "image/channel_names.h"
#include "image/cube_check.h"
#include "image/exr_layout.h"
#include "image/exr_limits.h"
#include "image/exr_sink.h"

#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <half.h>
#include <limits>
#include <optional>
#include <stdexcept>

namespace spectrad {

namespace {

constexpr std::array<const char*, previewChannels> previewNames{"R", "G", "B"};

/// One part, scan lines from the top. Rows are gathered until every thread has a chunk of its own to
/// compress: within one call OpenEXR compresses whole chunks in parallel, across calls it cannot.
class ExrWriter : public CubeWriter {
  public:
    ExrWriter(const std::filesystem::path& target, const CubeInfo& info, const WriteOptions& options);
    void write(int rows, const float* bands, const float* previewRgb) override;
    WriteReport finish() override;

  private:
    [[nodiscard]] size_t bandRow() const { return info_.wavelengths.size() * width_; }
    [[nodiscard]] size_t previewRow() const { return previewChannels * width_; }
    template <typename Pixel>
    void gather(std::vector<Pixel>& gathered, int rows, const float* bands, const float* preview);
    template <typename Pixel>
    void writeGathered(std::vector<Pixel>& gathered);
    template <typename Pixel>
    void writeRows(int rows, const Pixel* bands, const Pixel* preview);
    float heldPreview(float value);
    void convert(float value, float& to) { to = value; }
    void convert(float value, half& to);

    CubeInfo info_;
    WriteOptions options_;
    size_t width_;
    std::vector<std::string> names_;
    PendingFile pending_;
    ExrSink sink_;
    std::optional<Imf::OutputFile> file_;
    int gatherRows_;             ///< rows to hand over at once
    int gathered_ = 0;           ///< rows gathered and not yet handed over
    int received_ = 0;           ///< rows of the image so far
    int written_ = 0;            ///< rows handed over to OpenEXR
    std::vector<float> floats_;  ///< gathered rows: all bands, then all previews, [row][channel][x] each
    std::vector<half> halves_;   ///< the same for half files
    WriteReport report_;
};

ExrWriter::ExrWriter(const std::filesystem::path& target, const CubeInfo& info, const WriteOptions& options)
    : info_(info),
      options_(options),
      width_(static_cast<size_t>(info.width)),
      names_(bandNames(info.wavelengths, info.kind)),
      pending_(target),
      sink_(pending_.path(), target) {
    const std::uint64_t bytes =
        chunkBytes(info.width, names_.size() + previewChannels, options.half, options.compression);
    const int threads = threadsWithinMemory(bytes, exrThreads());
    gatherRows_ = std::max(1, threads) * rowsPerChunk(options.compression);
    // Chunks of one row are small: hand over enough of them to be worth a round of the threads.
    if (rowsPerChunk(options.compression) == 1) {
        constexpr std::uint64_t worthARound = 1 << 20;
        gatherRows_ =
            std::max(gatherRows_, static_cast<int>(std::min<std::uint64_t>(64, worthARound / bytes)));
    }
    gatherRows_ = std::min(gatherRows_, info.height);
    const Imf::Header header = cubeHeader(info, options, names_, target);
    writingExr(target, [&] { file_.emplace(sink_, header, threads); });
    const size_t values = static_cast<size_t>(gatherRows_) * (bandRow() + previewRow());
    options.half ? halves_.resize(values) : floats_.resize(values);
}

/// The preview is for viewers, not for measuring: what is beyond the type is held at its largest value.
float ExrWriter::heldPreview(float value) {
    const float largest = options_.half ? 65504.0f : std::numeric_limits<float>::max();
    if (std::abs(value) <= largest) return value;
    ++report_.previewClamped;
    return std::copysign(largest, value);
}

void ExrWriter::convert(float value, half& to) {
    to = half(value);
    if (to.isZero() && value != 0) ++report_.underflows;
}

/// Copies rows behind those gathered, in the file's pixel type.
template <typename Pixel>
void ExrWriter::gather(std::vector<Pixel>& gathered, int rows, const float* bands, const float* preview) {
    Pixel* to = gathered.data() + static_cast<size_t>(gathered_) * bandRow();
    const size_t count = static_cast<size_t>(rows) * bandRow();
    for (size_t i = 0; i < count; ++i) {
        convert(bands[i], to[i]);
        if constexpr (std::is_same_v<Pixel, half>) {
            if (!to[i].isInfinity()) continue;
            const int y = received_ + static_cast<int>(i / bandRow());
            throw InputError(
                {pending_.target().string()},
                fmt::format("{} is {}, beyond the 65504 of half precision",
                            placeInCube(info_, static_cast<int>(i % width_), y, i / width_ % names_.size()),
                            rounded(static_cast<double>(bands[i]), 7)));
        }
    }
    to = gathered.data() + static_cast<size_t>(gatherRows_) * bandRow() +
         static_cast<size_t>(gathered_) * previewRow();
    for (size_t i = 0; i < static_cast<size_t>(rows) * previewRow(); ++i) {
        if (std::isnan(preview[i]))
            throw InputError({pending_.target().string()},
                             fmt::format("pixel {},{} of the preview is not a number", i % width_,
                                         static_cast<size_t>(received_) + i / previewRow()));
        to[i] = static_cast<Pixel>(heldPreview(preview[i]));
    }
    gathered_ += rows;
}

template <typename Pixel>
void ExrWriter::writeGathered(std::vector<Pixel>& gathered) {
    if (gathered_ == 0) return;
    writeRows(gathered_, gathered.data(), gathered.data() + static_cast<size_t>(gatherRows_) * bandRow());
    gathered_ = 0;
}

template <typename Pixel>
void ExrWriter::writeRows(int rows, const Pixel* bands, const Pixel* preview) {
    constexpr Imf::PixelType type = std::is_same_v<Pixel, half> ? Imf::HALF : Imf::FLOAT;
    const Imath::Box2i window({0, written_}, {info_.width - 1, written_ + rows - 1});
    Imf::FrameBuffer frame;
    for (size_t b = 0; b < names_.size(); ++b)
        frame.insert(names_[b], Imf::Slice::Make(type, bands + b * width_, window, sizeof(Pixel),
                                                 sizeof(Pixel) * bandRow()));
    for (size_t c = 0; c < previewChannels; ++c)
        frame.insert(previewNames[c], Imf::Slice::Make(type, preview + c * width_, window, sizeof(Pixel),
                                                       sizeof(Pixel) * previewRow()));
    writingExr(pending_.target(), [&] {
        file_->setFrameBuffer(frame);
        file_->writePixels(rows);
    });
    written_ += rows;
}

void ExrWriter::write(int rows, const float* bands, const float* previewRgb) {
    if (rows < 0 || rows > info_.height - received_) throw std::logic_error("more rows than the image has");
    checkFinite(info_, received_, rows, bands, pending_.target());
    while (rows > 0) {
        const int now = std::min(rows, gatherRows_ - gathered_);
        options_.half ? gather(halves_, now, bands, previewRgb) : gather(floats_, now, bands, previewRgb);
        if (gathered_ == gatherRows_) options_.half ? writeGathered(halves_) : writeGathered(floats_);
        bands += static_cast<size_t>(now) * bandRow();
        previewRgb += static_cast<size_t>(now) * previewRow();
        received_ += now;
        rows -= now;
    }
}

WriteReport ExrWriter::finish() {
    if (received_ != info_.height) throw std::logic_error("finished before the last row");
    options_.half ? writeGathered(halves_) : writeGathered(floats_);
    file_.reset();  // writes the table of chunks
    sink_.close();
    pending_.commit();
    return report_;
}

}  // namespace

std::unique_ptr<CubeWriter> createExr(const std::filesystem::path& target, const CubeInfo& info,
                                      const WriteOptions& options) {
    checkCubeInfo(info, target);
    checkChunkSize(info, options, target);
    return std::make_unique<ExrWriter>(target, info, options);
}

}  // namespace spectrad
