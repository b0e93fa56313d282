// What glTF files say and Assimp loses: lamps and cameras of several nodes, integers, materials' extensions.
#include "scene/import.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>

using namespace spectrad;

namespace {

/// A model whose buffer grows with its accessors.
class Model {
  public:
    /// Rows of `components` numbers, each row `stride` bytes; returns the accessor's number.
    template <typename T>
    std::string add(const std::vector<T>& numbers, size_t components, int type, const std::string& more = "",
                    size_t stride = 0) {
        const size_t count = numbers.size() / components, size = components * sizeof(T);
        if (stride == 0) stride = size;
        const size_t from = buffer_.size();
        buffer_.resize((from + count * stride + 3) / 4 * 4);
        for (size_t i = 0; i < count; ++i)
            std::memcpy(buffer_.data() + from + i * stride, numbers.data() + i * components, size);
        views_ += (number_ > 0 ? std::string(",") : "") + R"({"buffer":0,"byteOffset":)" +
                  std::to_string(from) + R"(,"byteLength":)" + std::to_string(count * stride) +
                  (stride != size ? R"(,"byteStride":)" + std::to_string(stride) : "") + "}";
        accessors_ += (number_ > 0 ? std::string(",") : "") + R"({"bufferView":)" + std::to_string(number_) +
                      R"(,"componentType":)" + std::to_string(type) + R"(,"count":)" + std::to_string(count) +
                      R"(,"type":")" +
                      (components == 1    ? "SCALAR"
                       : components == 16 ? "MAT4"
                                          : "VEC" + std::to_string(components)) +
                      "\"" + more + "}";
        return std::to_string(number_++);
    }
    /// Files beside each other; `rest`: everything but accessors and buffers.
    [[nodiscard]] ImportedScene imported(const std::string& rest) const {
        const TemporaryFolder folder;
        folder.write("a.bin", buffer_);
        return importModel(folder.write("a.gltf", json(rest, R"(,"uri":"a.bin")")), true);
    }
    [[nodiscard]] ImportedScene importedFromOneFile(const std::string& rest) const {
        const TemporaryFolder folder;
        std::string text = json(rest, "");
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto word = [](size_t value) {
            const auto v = static_cast<std::uint32_t>(value);
            return std::string(reinterpret_cast<const char*>(&v), sizeof v);
        };
        return importModel(
            folder.write("a.glb", "glTF" + word(2) + word(28 + text.size() + buffer_.size()) +
                                      word(text.size()) + "JSON" + text + word(buffer_.size()) +
                                      std::string("BIN\0", 4) + buffer_),
            true);
    }

  private:
    [[nodiscard]] std::string json(const std::string& rest, const std::string& where) const {
        return R"({"asset":{"version":"2.0"},"scene":0,"accessors":[)" + accessors_ + R"(],"bufferViews":[)" +
               views_ + R"(],"buffers":[{"byteLength":)" + std::to_string(buffer_.size()) + where + "}]," +
               rest + "}";
    }
    std::string buffer_, views_, accessors_;
    int number_ = 0;
};

const std::vector<float> corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, -1};
const std::vector<std::uint16_t> twoTriangles{0, 1, 2, 0, 2, 3};
const std::string bounds = R"(,"min":[0,0,-1],"max":[1,1,0])";
const std::string oneNode = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)";

std::string mesh(const std::string& attributes, const std::string& index, const std::string& more = "") {
    return R"("meshes":[{"primitives":[{"attributes":{)" + attributes + R"(},"indices":)" + index + more +
           "}]}]";
}

/// A folded square, with materials if `rest` has them.
ImportedScene square(const std::string& rest, const std::string& nodes = oneNode) {
    Model model;
    const std::string p = model.add(corners, 3, 5126, bounds), i = model.add(twoTriangles, 1, 5123);
    return model.imported(nodes + mesh("\"POSITION\":" + p, i, R"(,"material":0)") + "," + rest);
}
ImportedMaterial worn(const std::string& material, std::vector<std::string>* remarks = nullptr) {
    const ImportedScene s = square(
        R"("extensionsUsed":["KHR_materials_ior","KHR_materials_pbrSpecularGlossiness","KHR_materials_emissive_strength"],
"materials":[{"name":"m",)" +
        material + "}]");
    if (remarks) *remarks = s.remarks;
    return s.materials[s.meshMaterial.at(0)];
}

bool contains(const std::vector<std::string>& list, const std::string& part) {
    for (const std::string& text : list)
        if (text.find(part) != std::string::npos) return true;
    return false;
}

std::vector<std::string> namesWith(const ImportedScene& s, std::vector<std::uint32_t> ImportedNode::*what) {
    std::vector<std::string> names;
    for (const ImportedNode& node : s.nodes)
        names.insert(names.end(), (node.*what).size(), node.name);
    return names;
}

const std::string lamps =
    R"("extensionsUsed":["KHR_lights_punctual"],"cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1,"aspectRatio":1.5}}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","intensity":7},{"type":"point","intensity":100,"color":[1,0.5,0]}]}},)";
std::string lit(int light) {
    return R"("extensions":{"KHR_lights_punctual":{"light":)" + std::to_string(light) + "}}";
}

}  // namespace

TEST_CASE("glTF: a lamp and a camera that several nodes carry stand in each of them") {
    Model model;
    const std::string p = model.add(corners, 3, 5126, bounds), i = model.add(twoTriangles, 1, 5123);
    const std::string rest =
        lamps +
        R"("scenes":[{"nodes":[0,1,4]}],"nodes":[{"name":"wall","mesh":0},{"name":"stand","translation":[0,1,0],"children":[2,3]},
{"name":"left","camera":0,)" +
        lit(1) + R"(},{"name":"right","camera":0,)" + lit(1) + R"(},{"name":"sun",)" + lit(0) + "}]," +
        mesh("\"POSITION\":" + p, i);
    for (const ImportedScene& s : {model.imported(rest), model.importedFromOneFile(rest)}) {
        using Names = std::vector<std::string>;
        CHECK(namesWith(s, &ImportedNode::lights) == Names{"left", "right", "sun"});
        CHECK(namesWith(s, &ImportedNode::cameras) == Names{"left", "right"});
        REQUIRE(s.lights.size() == 3);
        CHECK(s.lights[1].name == "right");
        CHECK(s.lights[1].type == ImportedLight::Type::point);
        CHECK(s.lights[1].colour == std::array<double, 3>{100, 50, 0});
        CHECK(s.lights[2].type == ImportedLight::Type::directional);
        CHECK(s.lights[2].colour[2] == 7);
        REQUIRE(s.cameras.size() == 2);
        CHECK(s.cameras[1].fovDegrees == Approx(0.7 * 180 / 3.14159265).epsilon(1e-5));
        CHECK(s.remarks.empty());
    }
}

TEST_CASE("glTF: a lamp stands in its own node, whatever others are called") {
    const ImportedScene s = square(
        lamps + R"("materials":[{}])",
        R"("scenes":[{"nodes":[0,1,2]}],"nodes":[{"name":"lamp","mesh":0},{"name":"lamp","translation":[2,0,0],)" +
            lit(1) + R"(},{"name":"lamp","camera":0}],)");
    REQUIRE(s.nodes.size() == 4);
    CHECK(s.nodes[1].lights.empty());
    CHECK(s.nodes[2].lights.size() == 1);
    CHECK(s.nodes[2].local.point({}) == Vec3{2, 0, 0});
    CHECK(s.nodes[3].cameras.size() == 1);
}

TEST_CASE("glTF: lamps that no node carries are not there") {
    CHECK(square(lamps + R"("materials":[{}])").lights.empty());
}

TEST_CASE("glTF: texture coordinates stored as integers are those that they stand for") {
    const auto coordinates = [](const auto& add) {
        Model model;
        const std::string p = model.add(corners, 3, 5126, bounds), i = model.add(twoTriangles, 1, 5123),
                          uv = add(model);
        const ImportedScene s =
            model.imported(oneNode + mesh("\"POSITION\":" + p + ",\"TEXCOORD_0\":" + uv, i));
        std::vector<std::array<float, 2>> list;
        for (const std::uint32_t v : s.meshes.at(0)->index)
            list.push_back(s.meshes[0]->uv.at(v));
        return list;
    };
    const std::string normalized = R"(,"normalized":true)";
    const auto floats = coordinates([](Model& m) {
        return m.add(std::vector<float>{0, 1, 1, 1, 0.2f, 0, 0, 0.6f}, 2, 5126);
    });
    const auto same = [&](const std::vector<std::array<float, 2>>& list) {
        REQUIRE(list.size() == floats.size());
        for (size_t i = 0; i < list.size(); ++i) {
            CHECK(list[i][0] == Approx(floats[i][0]).margin(1e-6));
            CHECK(list[i][1] == Approx(floats[i][1]).margin(1e-6));
        }
    };
    same(coordinates([&](Model& m) {
        return m.add(std::vector<std::uint16_t>{0, 65535, 65535, 65535, 13107, 0, 0, 39321}, 2, 5123,
                     normalized);
    }));
    same(coordinates([&](Model& m) {
        return m.add(std::vector<std::uint8_t>{0, 255, 255, 255, 51, 0, 0, 153}, 2, 5121, normalized, 4);
    }));
    const auto whole = coordinates([](Model& m) {
        return m.add(std::vector<std::int16_t>{0, 3, 2, 1, -2, 0, 0, 1}, 2, 5122);
    });
    CHECK(whole[1] == std::array<float, 2>{2, 0});
    CHECK(whole[2] == std::array<float, 2>{-2, 1});
}

TEST_CASE("glTF: positions and normals stored as integers are those that they stand for") {
    Model model;
    const std::string p = model.add(
                          std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 32767, 16384, -32767, 0, 0, 1}, 3,
                          5122, R"(,"normalized":true,"min":[0,0,-32767],"max":[32767,16384,1])", 8),
                      n = model.add(std::vector<std::int8_t>{0, 0, 127, 0, 0, 127, 127, 0, 0, 0, -127, 0}, 3,
                                    5120, R"(,"normalized":true)", 4),
                      i = model.add(twoTriangles, 1, 5123);
    const ImportedScene s = model.imported(
        R"("extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"],)" +
        oneNode + mesh("\"POSITION\":" + p + ",\"NORMAL\":" + n, i));
    const Mesh& m = *s.meshes.at(0);
    const auto at = [&](size_t k) {
        const auto& q = m.position[m.index[k]];
        return m.origin + Vec3{q[0], q[1], q[2]};
    };
    CHECK(length(at(1) - Vec3{1, 0, 0}) < 1e-6);
    CHECK(length(at(2) - Vec3{1, 16384 / 32767.0, -1}) < 1e-6);
    CHECK(m.normal[m.index[2]] == std::array<float, 3>{1, 0, 0});
    CHECK(m.normal[m.index[5]] == std::array<float, 3>{0, -1, 0});
}

TEST_CASE("glTF: integers that no vertex may have are refused in one line that names the mesh") {
    Model model;
    const std::string p = model.add(corners, 3, 5126, bounds), i = model.add(twoTriangles, 1, 5123),
                      uv = model.add(std::vector<std::uint32_t>{0, 1, 1, 1, 1, 0, 0, 0}, 2, 5125);
    CHECK_THROWS_WITH(model.imported(oneNode + mesh("\"POSITION\":" + p + ",\"TEXCOORD_0\":" + uv, i)),
                      Catch::Contains("texture coordinates of mesh 'meshes[0]' are stored as integers") &&
                          !Catch::Contains("\n"));
}

TEST_CASE("glTF: a mesh without normals is flat, one with normals keeps them") {
    const ImportedScene bare = square(R"("materials":[{}])");
    const Mesh flat = withNormals(*bare.meshes.at(0), Normals::file);
    CHECK(flat.triangles() == 2);
    for (size_t t = 0; t < 2; ++t)
        for (size_t k = 1; k < 3; ++k)
            CHECK(flat.normal[flat.index[3 * t]] == flat.normal[flat.index[3 * t + k]]);
    CHECK(flat.normal[flat.index[0]] != flat.normal[flat.index[3]]);
    const Mesh averaged = withNormals(*bare.meshes[0], Normals::smooth);
    CHECK(averaged.normal[averaged.index[0]] == averaged.normal[averaged.index[3]]);

    Model model;
    const std::string p = model.add(corners, 3, 5126, bounds),
                      n = model.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3, 5126),
                      i = model.add(twoTriangles, 1, 5123);
    const ImportedScene smooth = model.imported(oneNode + mesh("\"POSITION\":" + p + ",\"NORMAL\":" + n, i));
    CHECK(smooth.meshes.at(0)->position.size() == 4);
    CHECK(smooth.meshes[0]->normal[0] == std::array<float, 3>{0, 0, 1});
}

TEST_CASE("glTF: bones and morph targets are said to be left out") {
    Model model;
    const std::string p = model.add(corners, 3, 5126, bounds), i = model.add(twoTriangles, 1, 5123),
                      joints = model.add(std::vector<std::uint8_t>(16, 0), 4, 5121),
                      weights = model.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
                                          4, 5126),
                      target =
                          model.add(std::vector<float>(12, 2), 3, 5126, R"(,"min":[2,2,2],"max":[2,2,2])");
    const std::string bind =
        model.add(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 16, 5126);
    const std::string attributes = "\"POSITION\":" + p;
    const ImportedScene morphed =
        model.imported(oneNode + mesh(attributes, i, R"(,"targets":[{"POSITION":)" + target + "}]"));
    CHECK(contains(morphed.remarks, "1 meshes have morph targets"));
    CHECK_FALSE(contains(morphed.remarks, "bones"));
    const ImportedScene skinned = model.imported(
        R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0},{"name":"joint"}],"skins":[{"joints":[1],"inverseBindMatrices":)" +
        bind + "}]," + mesh(attributes + ",\"JOINTS_0\":" + joints + ",\"WEIGHTS_0\":" + weights, i));
    CHECK(contains(skinned.remarks, "1 meshes have bones"));
}

TEST_CASE("an emission that a picture shapes is left out with the picture, and that is said") {
    const std::string pictures = R"(,"textures":[{"source":0}],"images":[{"uri":"p.png"}])";
    const ImportedScene s =
        square(R"("materials":[{"name":"shade","emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}}])" +
               pictures);
    CHECK(s.materials[s.meshMaterial.at(0)].emissive == std::array<double, 3>{0, 0, 0});
    CHECK(contains(s.remarks, "pictures of emission ignored"));
    CHECK(contains(s.remarks, "emission left out where a picture shapes it: material 'shade'"));

    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl a\nKd 0.5 0.5 0.5\nKe 1 1 1\nmap_Ke black.png\nnewmtl b\nKe 1 1 1\n");
    const ImportedScene obj = importModel(
        folder.write("a.obj",
                     "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n"),
        true);
    CHECK(obj.materials[obj.meshMaterial.at(0)].emissive[0] == 0);
    CHECK(obj.materials[obj.meshMaterial.at(1)].emissive[0] == 1);
}

TEST_CASE("glTF: an emission's strength counts") {
    const ImportedMaterial m = worn(
        R"("emissiveFactor":[0.5,0,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":500}})");
    CHECK(m.emissive == std::array<double, 3>{250, 0, 500});
}

TEST_CASE("glTF: an index of 1 is no coat, any other is the coat's") {
    const auto ior = [](const std::string& index) {
        return worn(
                   R"("pbrMetallicRoughness":{"metallicFactor":0},"extensions":{"KHR_materials_ior":{"ior":)" +
                   index + "}}")
            .ior;
    };
    CHECK_FALSE(ior("1.0"));
    CHECK(ior("1.8").value_or(0) == Approx(1.8));
}

TEST_CASE("glTF: specular and glossiness are a diffuse colour under a coat, a black one is a metal") {
    const auto material = [](const std::string& content) {
        return worn(R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{)" + content + "}}");
    };
    const ImportedMaterial matt =
        material(R"("diffuseFactor":[0.8,0.1,0.1,1],"specularFactor":[0,0,0],"glossinessFactor":0)");
    CHECK(matt.diffuse[0] == Approx(0.8));
    CHECK(matt.diffuse[1] == Approx(0.1));
    CHECK_FALSE(matt.metal);
    CHECK_FALSE(matt.ior);
    const ImportedMaterial paint = material(
        R"("diffuseFactor":[0.8,0.1,0.1,1],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.75)");
    CHECK_FALSE(paint.metal);
    CHECK(paint.ior.value_or(0) == Approx(1.5).epsilon(1e-5));
    CHECK(paint.roughness == Approx(0.25));
    CHECK(material(R"("diffuseFactor":[0.8,0.1,0.1,1])").ior.value_or(0) == 1.5);
    const ImportedMaterial gold =
        material(R"("diffuseFactor":[0,0,0,1],"specularFactor":[1,0.7,0.3],"glossinessFactor":0.5)");
    REQUIRE(gold.metal);
    CHECK((*gold.metal)[1] == Approx(0.7));
}

TEST_CASE("glTF: extensions of materials that are left out are said, those that do nothing are not") {
    std::vector<std::string> remarks;
    (void)worn(R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1},
"KHR_materials_sheen":{"sheenColorFactor":[0,0,0]},"KHR_materials_unlit":{}})",
               &remarks);
    CHECK(contains(remarks, "KHR_materials_clearcoat left out of material 'm'"));
    CHECK(contains(remarks, "KHR_materials_unlit left out of material 'm'"));
    CHECK_FALSE(contains(remarks, "sheen"));
    const ImportedScene s =
        square(R"("extensionsUsed":["EXT_mesh_gpu_instancing","KHR_materials_ior"],"materials":[{}])");
    CHECK(contains(s.remarks, "extension left out: EXT_mesh_gpu_instancing"));
    CHECK_FALSE(contains(s.remarks, "KHR_materials_ior"));
}
