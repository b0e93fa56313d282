// <mesh> and <import>: parts of foreign models in a scene of ours.
#include "scene/graft.h"
#include "scene/reading.h"

namespace spectrad {

namespace {

Normals readNormals(const Element& element) {
    return element.choice<Normals>(
        "normals", {{"smooth", Normals::smooth}, {"flat", Normals::flat}, {"file", Normals::file}},
        Normals::file);
}

const ImportedScene& importedOnce(Reading& reading, const std::filesystem::path& file,
                                  const Element& element) {
    std::shared_ptr<const ImportedScene>& model = reading.cache.models[file];
    if (!model) {
        try {
            model = std::make_shared<const ImportedScene>(importModel(file, reading.restricted));
        } catch (const InputError& error) {
            throw InputError(element.where("file"), error.what());
        }
        for (const std::string& read : model->filesRead)
            reading.files.add(read);
    }
    return *model;
}

/// Moves vertices into another space. A mirroring transform turns the triangles, so that their front stays in
/// front.
Mesh transformed(const Mesh& mesh, const Affine& toSpace) {
    Mesh result = mesh;
    result.origin = toSpace.point(mesh.origin);
    for (auto& p : result.position) {
        const Vec3 moved = toSpace.direction({p[0], p[1], p[2]});
        p = {static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(moved.z)};
    }
    if (!result.normal.empty()) {
        const Affine back = inverse(toSpace);  // normals go by the transposed inverse
        for (auto& n : result.normal) {
            const Vec3 v{n[0], n[1], n[2]};
            const Vec3 turned = normalized({back.m[0] * v.x + back.m[4] * v.y + back.m[8] * v.z,
                                            back.m[1] * v.x + back.m[5] * v.y + back.m[9] * v.z,
                                            back.m[2] * v.x + back.m[6] * v.y + back.m[10] * v.z});
            n = {static_cast<float>(turned.x), static_cast<float>(turned.y), static_cast<float>(turned.z)};
        }
    }
    if (toSpace.determinant() < 0)
        for (size_t t = 0; t + 2 < result.index.size(); t += 3)
            std::swap(result.index[t + 1], result.index[t + 2]);
    return result;
}

/// A model's meshes in the space of the node that shows it, in metres. With `ownMaterials` the file's
/// materials join the scene's; without, they are left to the caller.
std::shared_ptr<const ModelCache::Parts> modelParts(Reading& reading, const std::filesystem::path& file,
                                                    Normals normals, bool ownMaterials,
                                                    const Element& element) {
    std::shared_ptr<const ModelCache::Parts>& cached = reading.cache.parts[{file, normals, ownMaterials}];
    if (cached) return cached;

    // Graft the model onto an empty scene, then flatten that: one way to read models, for <import> and <mesh>
    // alike.
    Scene alone = emptyScene();
    GraftOptions options;
    options.metresPerUnit = reading.scene.metresPerUnit;
    options.normals = normals;
    options.lightsAndCameras = false;
    if (!ownMaterials) options.material = 0;
    graft(alone, 0, importedOnce(reading, file, element), options, reading.resolver, reading.notes);
    for (const std::string& picture : alone.filesRead)
        reading.files.add(picture);

    const Index shift = static_cast<Index>(reading.scene.materials.size()) - 1;
    if (ownMaterials)
        for (size_t i = 1; i < alone.materials.size(); ++i)
            reading.scene.materials.push_back(std::move(alone.materials[i]));
    auto parts = std::make_shared<ModelCache::Parts>();
    for (const FlatScene::Object& object : flatten(alone).objects) {
        for (const MeshUse& use : object.node->meshes) {
            MeshUse part = use;
            if (object.toWorld.m != Affine().m)
                part.mesh = std::make_shared<const Mesh>(transformed(*use.mesh, object.toWorld));
            if (part.material > 0) part.material += shift;
            parts->push_back(std::move(part));
        }
    }
    cached = std::move(parts);
    return cached;
}

}  // namespace

void readMesh(Reading& reading, const Element& element, Index node) {
    const std::filesystem::path file = reading.file(element, "file");
    const bool ownMaterials = !element.has("material");
    const Index material = reading.material(element, "material");
    const auto parts = modelParts(reading, file, readNormals(element), ownMaterials, element);
    for (MeshUse part : *parts) {
        if (!ownMaterials) part.material = material;
        reading.scene.nodes[node].meshes.push_back(std::move(part));
    }
}

void readImport(Reading& reading, const Element& element, Index node) {
    GraftOptions options;
    options.metresPerUnit = reading.scene.metresPerUnit;
    options.normals = readNormals(element);
    options.lightsAndCameras = !element.boolean("geometry-only", false);
    if (element.has("material")) options.material = reading.material(element, "material");
    for (const pugi::xml_node child : element.node().children("bind")) {
        const Element bind(reading.document, child);
        options.bindings.push_back({bind.text("material"), reading.material(bind, "to"), bind.where()});
    }
    if (options.material && !options.bindings.empty())
        element.fail("has both 'material', which dresses everything, and <bind> (one is allowed)");
    const std::filesystem::path file = reading.file(element, "file");
    graft(reading.scene, node, importedOnce(reading, file, element), options, reading.resolver,
          reading.notes);
    for (const std::string& picture : reading.scene.filesRead)
        reading.files.add(picture);
}

}  // namespace spectrad
