#include "base/files.h"
#include "image/cube.h"
#include "image/envi_read.h"
#include "image/exr_read.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

namespace spectrad {

namespace {

enum class Format { exr, envi };

Format formatOf(const std::filesystem::path& path) {
    if (startsLikeExr(path)) return Format::exr;
    if (findEnviHeader(path)) return Format::envi;
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) throw InputError({path.string()}, "is a folder");
    errno = 0;
    if (!std::ifstream(path, std::ios::binary))
        throw InputError({path.string()}, std::string("cannot be read: ") + std::strerror(errno));
    throw InputError({path.string()}, "is no spectral image (allowed: EXR, or ENVI with its .hdr beside it)");
}

}  // namespace

Cube readCube(const std::filesystem::path& path, Notes& notes) {
    return formatOf(path) == Format::exr ? readExr(path, notes) : readEnvi(path, notes);
}

CubeInfo readCubeInfo(const std::filesystem::path& path, Notes& notes) {
    return formatOf(path) == Format::exr ? readExrInfo(path, notes) : readEnviInfo(path, notes);
}

std::unique_ptr<CubeReader> openCube(const std::filesystem::path& path, Notes& notes) {
    return formatOf(path) == Format::exr ? openExr(path, notes) : openEnvi(path, notes);
}

bool looksLikeCube(const std::filesystem::path& path) {
    if (startsLikeExr(path)) return true;
    if (!findEnviHeader(path)) return false;
    constexpr std::array<std::string_view, 8> usual{"",     ".hdr", ".img", ".dat",
                                                    ".raw", ".bil", ".bip", ".bsq"};
    if (std::find(usual.begin(), usual.end(), extensionOf(path)) != usual.end()) return true;
    // A scene or a model beside the cube that was made of it, scene.hdr, is not its data.
    return isAsLargeAsItsEnviHeaderSays(path);
}

}  // namespace spectrad
