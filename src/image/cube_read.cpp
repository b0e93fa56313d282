#include "image/cube.h"
#include "image/envi_read.h"
#include "image/exr_read.h"

#include <cerrno>
#include <cstring>
#include <fstream>

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
    return startsLikeExr(path) || findEnviHeader(path).has_value();
}

}  // namespace spectrad
