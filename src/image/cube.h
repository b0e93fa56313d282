// A spectral image: what it holds, and its pixels in strips laid out [row][band][x], EXR's own scan-line
// order.
#pragma once

#include "base/error.h"
#include "spectrum/wavelengths.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// What the band values are; decides the channel names of the EXR layout (S0 or T).
enum class CubeKind { radiance, irradiance, reflectance, transmittance };
[[nodiscard]] std::string_view name(CubeKind kind);
[[nodiscard]] std::optional<CubeKind> parseCubeKind(std::string_view text);
/// The unit of the values, "W.m^-2.sr^-1.nm^-1", "W.m^-2.nm^-1" or "" for a ratio.
[[nodiscard]] std::string_view unit(CubeKind kind);
/// The head of a column of such values in a table: "radiance_W_m2_sr_nm".
[[nodiscard]] std::string_view columnName(CubeKind kind);

struct CubeInfo {
    int width = 0, height = 0;
    Wavelengths wavelengths;
    bool projectionStated =
        false;  ///< on reading: the file had our projection attribute (else: point values)
    CubeKind kind = CubeKind::radiance;
    /// Extra string attributes; names are ours, prefixed "spectrad:" in the file where they are not the
    /// layout's.
    std::map<std::string, std::string> attributes;
};

/// A whole cube in memory: values[(row * bands + band) * width + x].
struct Cube {
    CubeInfo info;
    std::vector<float> values;
    [[nodiscard]] const float* row(int y, size_t band) const {
        return values.data() +
               (static_cast<size_t>(y) * info.wavelengths.size() + band) * static_cast<size_t>(info.width);
    }
};

enum class Compression { none, zips, zip, piz };
[[nodiscard]] Compression parseCompression(std::string_view text);  ///< throws UsageError
[[nodiscard]] std::string_view name(Compression compression);

struct WriteOptions {
    Compression compression = Compression::piz;
    bool half = false;  ///< HALF instead of FLOAT: 11 significant bits, up to 65504
};

/// The compression to write with: what `wanted` says, unless the user did not ask for it (`asked` false) and
/// its chunks would be beyond the format or need more than 1 GiB: then zips, and `notes` say so. Throws
/// InputError, like createExr, if what was asked for is beyond the format.
[[nodiscard]] Compression chooseCompression(const CubeInfo& info, const WriteOptions& wanted, bool asked,
                                            Notes& notes);

/// What the pixel type could not hold, counted while writing.
struct WriteReport {
    std::uint64_t underflows = 0;  ///< non-zero band values that became zero in half
    std::uint64_t previewClamped =
        0;  ///< values of the RGB preview, which is no measurement, held at the type's largest
};

/// Streams a cube into a file, rows in order from the top. Nothing appears at the target until finish().
class CubeWriter {
  public:
    virtual ~CubeWriter() = default;
    /// Rows that follow those written before: `rows` rows of bands [row][band][x] and of the linear Rec.709
    /// preview [row][3][x]. Throws MachineError (disk), InputError (value beyond the pixel type's range,
    /// named with its pixel and band).
    virtual void write(int rows, const float* bands, const float* previewRgb) = 0;
    /// After the last row: the file appears, or a MachineError says why not.
    virtual WriteReport finish() = 0;
};

/// OpenEXR in the spectral layout 1.0. Throws InputError before anything is rendered if the size is beyond
/// the format.
[[nodiscard]] std::unique_ptr<CubeWriter> createExr(const std::filesystem::path& target, const CubeInfo& info,
                                                    const WriteOptions& options);
/// ENVI: `target` is x.img (data, BIL, float32 little endian), x.hdr beside it.
[[nodiscard]] std::unique_ptr<CubeWriter> createEnvi(const std::filesystem::path& target,
                                                     const CubeInfo& info);
/// The same writer, run on a thread of its own: write() copies the rows into a queue of at most
/// maxQueuedBytes and waits only while that is full. Errors of the thread come out of the next write() or of
/// finish().
[[nodiscard]] std::unique_ptr<CubeWriter> onOwnThread(std::unique_ptr<CubeWriter> writer,
                                                      size_t maxQueuedBytes, const CubeInfo& info);

/// Reads an EXR of the layout 1.0 (ours or others') or an ENVI cube (by .hdr or data file). Throws
/// InputError.
[[nodiscard]] Cube readCube(const std::filesystem::path& path, Notes& notes);
[[nodiscard]] CubeInfo readCubeInfo(const std::filesystem::path& path, Notes& notes);
/// True if the file starts like an EXR or ENVI file.
[[nodiscard]] bool looksLikeCube(const std::filesystem::path& path);

}  // namespace spectrad
