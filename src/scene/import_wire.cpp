#include "scene/import_wire.h"

#include <cmath>
#include <cstring>
#include <type_traits>

namespace spectrad {

namespace {

// One description of every struct serves both directions: Writer and Reader have the same interface, a call
// for each field in the same order. Both processes are the same program, so numbers travel as they lie in
// memory.

constexpr std::uint32_t sceneMark = 0x53504543, errorMark = 0x4f4f5053, endMark = 0x444f4e45;

class Writer {
  public:
    explicit Writer(const ByteSink& sink) : sink_(sink) { buffer_.reserve(bufferSize); }

    template <typename T>
    void plain(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        raw(&value, sizeof(T));
    }
    template <typename T>
    void plainList(const std::vector<T>& list) {
        static_assert(std::is_trivially_copyable_v<T>);
        plain<std::uint64_t>(list.size());
        raw(list.data(), list.size() * sizeof(T));
    }
    void text(const std::string& value) {
        plain<std::uint64_t>(value.size());
        raw(value.data(), value.size());
    }
    template <typename T, typename Each>
    void list(const std::vector<T>& items, Each each) {
        plain<std::uint64_t>(items.size());
        for (const T& item : items)
            each(*this, item);
    }
    void flush() {
        sink_(buffer_.data(), buffer_.size());
        buffer_.clear();
    }

  private:
    void raw(const void* bytes, size_t size) {
        if (buffer_.size() + size > bufferSize) flush();
        if (size > bufferSize)
            sink_(bytes, size);
        else
            buffer_.append(static_cast<const char*>(bytes), size);
    }
    static constexpr size_t bufferSize = 1 << 16;
    const ByteSink& sink_;
    std::string buffer_;
};

[[noreturn]] void damaged() {
    throw InputError("the import's result is damaged");
}

class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    template <typename T>
    void plain(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        raw(&value, sizeof(T));
    }
    template <typename T>
    void plainList(std::vector<T>& list) {
        list.resize(count(sizeof(T)));
        raw(list.data(), list.size() * sizeof(T));
    }
    void text(std::string& value) {
        value.resize(count(1));
        raw(value.data(), value.size());
    }
    template <typename T, typename Each>
    void list(std::vector<T>& items, Each each) {
        items.resize(count(1));  // an item takes a byte at least: a wrong count cannot ask for all memory
        for (T& item : items)
            each(*this, item);
    }
    void flag(bool& value) {
        std::uint8_t byte = 0;
        plain(byte);
        if (byte > 1) damaged();
        value = byte == 1;
    }
    [[nodiscard]] bool atEnd() const { return bytes_.empty(); }

  private:
    size_t count(size_t itemSize) {
        std::uint64_t n = 0;
        plain(n);
        if (n > bytes_.size() / itemSize) damaged();
        return static_cast<size_t>(n);
    }
    void raw(void* to, size_t size) {
        if (size > bytes_.size()) damaged();
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_.remove_prefix(size);
    }
    std::string_view bytes_;
};

void flag(Writer& wire, bool value) {
    wire.plain<std::uint8_t>(value ? 1 : 0);
}
void flag(Reader& wire, bool& value) {
    wire.flag(value);
}

/// optional<T>: whether there is one, then always a T.
template <typename T>
void maybe(Writer& wire, const std::optional<T>& value) {
    flag(wire, value.has_value());
    wire.plain(value.value_or(T{}));
}
template <typename T>
void maybe(Reader& wire, std::optional<T>& value) {
    bool there = false;
    T read{};
    flag(wire, there);
    wire.plain(read);
    if (there) value = read;
}

// ---- the structs, field by field: Wire is Writer with const structs or Reader with plain ones
// ---------------------------

template <typename Wire, typename AnyMesh>
void meshFields(Wire& wire, AnyMesh& mesh) {
    wire.text(mesh.name);
    wire.plain(mesh.origin);
    wire.plainList(mesh.position);
    wire.plainList(mesh.normal);
    wire.plainList(mesh.uv);
    wire.plainList(mesh.index);
}

template <typename Wire, typename AnyPicture>
void pictureFields(Wire& wire, AnyPicture& picture) {
    wire.text(picture.name);
    maybe(wire, picture.embedded);
    flag(wire, picture.repeat);
    flag(wire, picture.nearest);
    flag(wire, picture.isPlainSrgb);
    wire.plain(picture.offset);
    wire.plain(picture.scale);
    wire.plain(picture.rotateDegrees);
    wire.plain(picture.amount);
    wire.plain(picture.coordinates);
}

/// Whether there is one, then one if so.
void maybePicture(Writer& wire, const std::optional<ImportedPicture>& picture) {
    flag(wire, picture.has_value());
    if (picture) pictureFields(wire, *picture);
}
void maybePicture(Reader& wire, std::optional<ImportedPicture>& picture) {
    bool there = false;
    flag(wire, there);
    if (there) pictureFields(wire, picture.emplace());
}

template <typename Wire, typename AnyScene>
void sceneFields(Wire& wire, AnyScene& scene) {
    wire.plainList(scene.meshMaterial);
    wire.list(scene.materials, [](Wire& w, auto& material) {
        w.text(material.name);
        w.plain(material.diffuse);
        maybePicture(w, material.colours);
        w.plain(material.tint);
        maybePicture(w, material.normals);
        maybe(w, material.metal);
        w.plain(material.emissive);
        maybe(w, material.ior);
        w.plain(material.roughness);
    });
    wire.list(scene.pictures, [](Wire& w, auto& bytes) { w.text(bytes); });
    wire.list(scene.lights, [](Wire& w, auto& light) {
        w.text(light.name);
        w.plain(light.type);
        w.plain(light.position);
        w.plain(light.direction);
        w.plain(light.colour);
        w.plain(light.angleDegrees);
        w.plain(light.blend);
    });
    wire.list(scene.cameras, [](Wire& w, auto& camera) {
        w.text(camera.name);
        w.plain(camera.toNode);
        w.plain(camera.fovDegrees);
        w.plain(camera.aspect);
        w.plain(camera.orthographicHeight);
    });
    wire.list(scene.nodes, [](Wire& w, auto& node) {
        w.text(node.name);
        w.plain(node.local);
        w.plainList(node.children);
        w.plainList(node.meshes);
        w.plainList(node.lights);
        w.plainList(node.cameras);
    });
    flag(wire, scene.inMetres);
    flag(wire, scene.photometric);
    wire.list(scene.remarks, [](Wire& w, auto& text) { w.text(text); });
    wire.list(scene.filesRead, [](Wire& w, auto& text) { w.text(text); });
}

// ---- checks
// ----------------------------------------------------------------------------------------------------------

void require(bool holds) {
    if (!holds) damaged();
}
bool within(double value, double from, double to) {
    return value >= from && value <= to;
}  // false for NaN
bool finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
template <size_t N>
bool finite(const std::array<float, N>& v) {
    for (const float x : v)
        if (!std::isfinite(x)) return false;
    return true;
}
bool isColour(const std::array<double, 3>& colour, double most) {
    return within(colour[0], 0, most) && within(colour[1], 0, most) && within(colour[2], 0, most);
}
bool indicesBelow(const std::vector<std::uint32_t>& list, size_t size) {
    for (const std::uint32_t i : list)
        if (i >= size) return false;
    return true;
}

void check(const Mesh& mesh) {
    const size_t vertices = mesh.position.size();
    require(finite(mesh.origin) && mesh.index.size() % 3 == 0);
    require(mesh.normal.empty() || mesh.normal.size() == vertices);
    require(mesh.uv.empty() || mesh.uv.size() == vertices);
    require(indicesBelow(mesh.index, vertices));
    for (const auto& p : mesh.position)
        require(finite(p));
    for (const auto& n : mesh.normal)
        require(finite(n));
    for (const auto& t : mesh.uv)
        require(finite(t));
}

void check(const std::optional<ImportedPicture>& picture, size_t pictures) {
    if (!picture) return;
    constexpr double most = 1e7;
    require(!picture->embedded || *picture->embedded < pictures);
    for (size_t i = 0; i < 2; ++i)
        require(within(picture->offset[i], -most, most) && within(picture->scale[i], -most, most) &&
                picture->scale[i] != 0);
    require(std::isfinite(picture->rotateDegrees) && within(picture->amount, 0, most));
}

/// Every node but the root is the child of exactly one that comes before it.
void checkTree(const ImportedScene& scene) {
    require(!scene.nodes.empty());
    std::vector<bool> hasParent(scene.nodes.size(), false);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        for (const std::uint32_t child : scene.nodes[i].children) {
            require(child > i && child < scene.nodes.size() && !hasParent[child]);
            hasParent[child] = true;
        }
    }
    for (size_t i = 1; i < hasParent.size(); ++i)
        require(hasParent[i]);
}

void check(const ImportedScene& scene) {
    constexpr double brightest = 1e30;
    require(scene.meshMaterial.size() == scene.meshes.size() &&
            indicesBelow(scene.meshMaterial, scene.materials.size()));
    for (const auto& mesh : scene.meshes)
        check(*mesh);
    for (const ImportedMaterial& m : scene.materials) {
        require(isColour(m.diffuse, 1) && isColour(m.emissive, brightest) && within(m.roughness, 0, 1));
        require(!m.ior || within(*m.ior, 1, 10));
        require(!m.metal || isColour(*m.metal, 1));
        require(isColour(m.tint, 1));
        check(m.colours, scene.pictures.size());
        check(m.normals, scene.pictures.size());
    }
    for (const ImportedLight& l : scene.lights) {
        require(l.type >= ImportedLight::Type::point && l.type <= ImportedLight::Type::ambient);
        require(finite(l.position) && finite(l.direction) && length(l.direction) > 0 &&
                isColour(l.colour, brightest));
        require(within(l.angleDegrees, 0, 360) && within(l.blend, 0, 1));
    }
    for (const ImportedCamera& c : scene.cameras) {
        require(c.toNode.finite() && c.fovDegrees > 0 && c.fovDegrees < 180);
        require(within(c.aspect, 0, 1e6) && within(c.orthographicHeight, 0, brightest));
    }
    checkTree(scene);
    for (const ImportedNode& n : scene.nodes) {
        require(n.local.finite() && indicesBelow(n.meshes, scene.meshes.size()));
        require(indicesBelow(n.lights, scene.lights.size()) && indicesBelow(n.cameras, scene.cameras.size()));
    }
}

}  // namespace

void sendScene(const ImportedScene& scene, const ByteSink& sink) {
    Writer wire(sink);
    wire.plain(sceneMark);
    wire.list(scene.meshes, [](Writer& w, const std::shared_ptr<const Mesh>& mesh) { meshFields(w, *mesh); });
    sceneFields(wire, scene);
    wire.plain(endMark);
    wire.flush();
}

void sendError(const std::string& message, const ByteSink& sink) {
    Writer wire(sink);
    wire.plain(errorMark);
    wire.text(message);
    wire.flush();
}

ImportedScene receiveScene(std::string_view bytes) {
    Reader wire(bytes);
    std::uint32_t mark = 0;
    wire.plain(mark);
    if (mark == errorMark) {
        std::string message;
        wire.text(message);
        throw InputError(message);
    }
    require(mark == sceneMark);
    ImportedScene scene;
    wire.list(scene.meshes, [](Reader& w, std::shared_ptr<const Mesh>& mesh) {
        auto read = std::make_shared<Mesh>();
        meshFields(w, *read);
        mesh = std::move(read);
    });
    sceneFields(wire, scene);
    wire.plain(mark);
    require(mark == endMark && wire.atEnd());
    check(scene);
    return scene;
}

}  // namespace spectrad
