#include "scene/import.h"

#include "base/text.h"
#include "scene/import_assimp.h"
#include "scene/import_isolate.h"
#include "scene/import_wire.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace spectrad {

namespace fs = std::filesystem;

/// The plain reasons, said before Assimp has its own words for them.
static void requireReadable(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw InputError(path.string() + ": no such file");
    if (!fs::is_regular_file(status)) throw InputError(path.string() + ": is no file");
    errno = 0;
    if (!std::ifstream(path, std::ios::binary))
        throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
}

/// Assimp needs up to some fifty times the size of what it reads, and some files claim more than they hold.
/// "model.bin" and "model0.bin" beside model.gltf count; small files may be packed (.zae, .3mf).
static std::uint64_t memoryFor(const fs::path& path) {
    constexpr std::uint64_t floor = std::uint64_t{4} << 30;
    std::uint64_t bytes = 0;
    std::error_code error;
    const std::string stem = path.stem().string();
    for (const fs::directory_entry& file : fs::directory_iterator(fs::absolute(path).parent_path(), error)) {
        if (startsWith(file.path().filename().string(), stem) && file.is_regular_file(error))
            bytes += file.file_size(error);
    }
    return floor + 100 * std::min<std::uint64_t>(bytes, std::uint64_t{1} << 40);
}

ImportedScene importModel(const fs::path& path, bool restricted, double timeoutSeconds) {
    requireReadable(path);
    ChildLimits limits;
    limits.seconds = timeoutSeconds;
    limits.memoryBytes = memoryFor(path);
    const ChildOutcome outcome = runInChild(
        [&](const ByteSink& sink) {
            try {
                sendScene(importWithAssimp(path, restricted), sink);
            } catch (const std::bad_alloc&) {
                throw;
            } catch (const std::exception& error) {
                sendError(oneLine(error.what()), sink);
            }
        },
        limits);
    if (!outcome.failure.empty()) throw InputError(path.string() + ": import " + outcome.failure);
    try {
        return receiveScene(outcome.bytes);
    } catch (const InputError& error) {
        throw InputError(path.string() + ": " + error.what());
    }
}

}  // namespace spectrad
