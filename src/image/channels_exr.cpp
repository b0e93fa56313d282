#include "base/files.h"
#include "image/cube_check.h"
#include "image/exr_layout.h"
#include "image/exr_limits.h"
#include "image/exr_sink.h"
#include "image/picture.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <set>

namespace spectrad {

namespace {

void checkPlanes(int width, int height, const std::vector<std::string>& names,
                 const std::vector<std::vector<float>>& planes, const SourceLocation& where) {
    if (width < 1 || height < 1 || names.empty() || names.size() != planes.size() ||
        std::set<std::string>(names.begin(), names.end()).size() != names.size())
        throw InputError(where, fmt::format("no image of {}x{} pixels in {} channels with {} planes", width,
                                            height, names.size(), planes.size()));
    const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
    for (size_t c = 0; c < names.size(); ++c) {
        if (planes[c].size() != pixels)
            throw InputError(where, fmt::format("channel {} has {} values for {} pixels", names[c],
                                                planes[c].size(), pixels));
        const size_t bad = firstNonFinite(planes[c].data(), pixels);
        if (bad != pixels)
            throw InputError(where, fmt::format("pixel {},{}, channel {} is {} (allowed: finite values)",
                                                bad % static_cast<size_t>(width),
                                                bad / static_cast<size_t>(width), names[c], planes[c][bad]));
    }
}

}  // namespace

void writeChannelsExr(const std::filesystem::path& target, int width, int height,
                      const std::vector<std::string>& names, const std::vector<std::vector<float>>& planes,
                      const std::map<std::string, std::string>& attributes) {
    checkPlanes(width, height, names, planes, {target.string()});
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    const Imath::Box2i window = header.dataWindow();
    for (size_t c = 0; c < names.size(); ++c) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, planes[c].data(), window, sizeof(float),
                                                sizeof(float) * static_cast<size_t>(width)));
    }
    for (const auto& [key, value] : attributes)
        addText(header, key, value, target);

    PendingFile pending(target);
    ExrSink sink(pending.path(), target);
    const int threads =
        threadsWithinMemory(chunkBytes(width, names.size(), false, Compression::zip), exrThreads());
    writingExr(target, [&] {
        Imf::OutputFile file(sink, header, threads);
        file.setFrameBuffer(frame);
        file.writePixels(height);
    });
    sink.close();
    pending.commit();
}

}  // namespace spectrad
