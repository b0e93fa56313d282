// A unit square in x–y with texture coordinates, as other programs write models: OBJ, glTF, GLB.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace spectrad::testing {

/// Corners at ±½, (0,0) of the texture coordinates at the lower left.
inline std::string quadObj(const std::string& materialFile, const std::string& material) {
    return "mtllib " + materialFile +
           "\nv -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\n"
           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl " +
           material + "\nf 1/1 2/2 3/3 4/4\n";
}

/// glTF counts v downwards: TEXCOORD_0 is the square as it stands, TEXCOORD_1 half of that.
inline std::string quadBuffer() {
    const float position[12] = {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, 0.5f, 0.5f, 0, -0.5f, 0.5f, 0};
    const float uv[8] = {0, 1, 1, 1, 1, 0, 0, 0};
    const float half[8] = {0, 0.5f, 0.5f, 0.5f, 0.5f, 0, 0, 0};
    const std::uint16_t index[6] = {0, 1, 2, 0, 2, 3};
    std::string bytes(124, '\0');
    std::memcpy(bytes.data(), position, 48);
    std::memcpy(bytes.data() + 48, uv, 32);
    std::memcpy(bytes.data() + 80, half, 32);
    std::memcpy(bytes.data() + 112, index, 12);
    return bytes;
}

/// `buffer`: what stands in the buffer beside its length; `views`: more of them; `rest`: "materials",
/// "textures", "images", "samplers".
inline std::string quadGltf(const std::string& rest, size_t bytes = 124,
                            const std::string& buffer = R"(,"uri":"quad.bin")",
                            const std::string& views = "") {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2},"indices":3,"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-0.5,-0.5,0],"max":[0.5,0.5,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
{"buffer":0,"byteOffset":80,"byteLength":32},{"buffer":0,"byteOffset":112,"byteLength":12})" +
           views + R"(],"buffers":[{"byteLength":)" + std::to_string(bytes) + buffer + "}]," + rest + "}";
}

/// With a picture inside it, which the materials know as image 0.
inline std::string quadGlb(const std::string& rest, const std::string& picture) {
    std::string data = quadBuffer() + picture;
    const std::string view =
        R"(,{"buffer":0,"byteOffset":124,"byteLength":)" + std::to_string(picture.size()) + "}";
    data.resize((data.size() + 3) / 4 * 4);
    std::string json =
        quadGltf(rest + R"(,"images":[{"bufferView":4,"mimeType":"image/png"}])", data.size(), "", view);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](size_t value) {
        const auto v = static_cast<std::uint32_t>(value);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &v, 4);
        return bytes;
    };
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + data.size()) + word(json.size()) + "JSON" +
           json + word(data.size()) + std::string("BIN\0", 4) + data;
}

}  // namespace spectrad::testing
