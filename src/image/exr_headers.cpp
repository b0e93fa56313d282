#include "image/exr_headers.h"

#include "base/error.h"
#include "image/printable.h"

#include <ImfStdIO.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <ImfXdr.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

namespace spectrad {

namespace {

/// At least so many bytes are in a file with this header: eight a chunk, in the table of chunks.
std::uintmax_t leastBytes(const Imf::Header& header) {
    const Imath::Box2i& window = header.dataWindow();
    const auto height = static_cast<std::uintmax_t>(1LL + window.max.y - window.min.y);
    // No compression packs more than 256 rows into a chunk; tiles have their own height.
    const std::uintmax_t rows = header.hasTileDescription() ? header.tileDescription().ySize : 256;
    return 8 * (height / rows);
}

std::string takeName(std::istream& file) {
    constexpr size_t longest = 256;
    std::string name;
    for (int c = file.get(); c > 0 && name.size() < longest; c = file.get())
        name += static_cast<char>(c);
    return name;
}

/// An attribute is its name, its type, its size and its bytes; OpenEXR makes room for a size of 2 GB before
/// it finds the file to be shorter.
void checkAttributeSizes(const std::filesystem::path& path, std::uintmax_t fileSize) {
    std::ifstream file(path, std::ios::binary);
    std::array<unsigned char, 4> raw{};
    const auto takeInt = [&] {  // little endian
        file.read(reinterpret_cast<char*>(raw.data()), raw.size());
        return static_cast<std::uint32_t>(raw[0] | raw[1] << 8 | raw[2] << 16) |
               static_cast<std::uint32_t>(raw[3]) << 24;
    };
    takeInt();  // the magic number
    const bool multiPart = Imf::isMultiPart(static_cast<int>(takeInt()));
    std::string name;
    do {
        bool any = false;
        for (name = takeName(file); file && !name.empty(); name = takeName(file), any = true) {
            takeName(file);  // the type
            const std::uint32_t size = takeInt();
            if (size > fileSize)
                throw InputError({path.string()},
                                 fmt::format("damaged: its attribute '{}' claims {} bytes, the file has {}",
                                             printable(name), size, fileSize));
            file.seekg(size, std::ios::cur);
        }
        if (!any) return;
    } while (multiPart && file);
}

}  // namespace

std::vector<Imf::Header> readExrHeaders(const std::filesystem::path& path) {
    if (!std::ifstream(path, std::ios::binary)) throw InputError({path.string()}, "cannot be read");
    const std::uintmax_t size = std::filesystem::file_size(path);
    checkAttributeSizes(path, size);
    Imf::StdIFStream stream(path.c_str());
    int magic = 0, version = 0;
    Imf::Xdr::read<Imf::StreamIO>(stream, magic);
    Imf::Xdr::read<Imf::StreamIO>(stream, version);
    std::vector<Imf::Header> headers;
    do {
        Imf::Header header;
        header.readFrom(stream, version);
        if (header.readsNothing()) break;  // the end of several headers
        header.sanityCheck(Imf::isTiled(version), Imf::isMultiPart(version));
        if (leastBytes(header) > size)
            throw InputError(
                {path.string()},
                fmt::format("damaged: its header claims more rows than {} bytes can hold", size));
        headers.push_back(std::move(header));
    } while (Imf::isMultiPart(version));
    if (headers.empty()) throw InputError({path.string()}, "has no header");
    return headers;
}

}  // namespace spectrad
