#include "scene/load.h"

#include "base/files.h"
#include "base/text.h"
#include "scene/graft.h"
#include "scene/grammar.h"
#include "scene/reading.h"
#include "scene/set_overrides.h"
#include "scene/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace spectrad {

namespace {

/// Ours by its extension, or by its first element: other formats (COLLADA, X3D …) are XML too.
bool isOurs(const std::filesystem::path& path) {
    if (extensionOf(path) == ".xml") return true;
    std::string head(65'536, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    return rootElementName(head) == "scene";
}

/// SHA-256 of the files' SHA-256 digests, one a line: what `sha256sum FILES | cut -c 1-64 | sha256sum`
/// prints.
std::string hashOf(const std::vector<std::string>& files) {
    std::string digests;
    for (const std::string& file : files)
        digests += sha256(readFile(file)) + "\n";
    return sha256(digests);
}

bool isUsed(const Reading& reading, size_t material) {
    return material >= reading.materialUsed.size() || reading.materialUsed[material];
}

void warnOfUnused(const Reading& reading) {
    for (const auto& [name, where] : reading.resolver.unused())
        reading.notes.warn(where, fmt::format("spectrum '{}' is not used", name));
    for (size_t i = 1; i < reading.materialUsed.size(); ++i)
        if (!reading.materialUsed[i])
            reading.notes.warn(reading.scene.materials[i].where,
                               fmt::format("material '{}' is not used", reading.scene.materials[i].name));
}

bool hasLight(const Reading& reading) {
    const Scene& scene = reading.scene;
    // What a transmittance tells of needs no light.
    if (!scene.passes.empty() && std::all_of(scene.passes.begin(), scene.passes.end(), [](const Pass& pass) {
            return pass.as == PassKind::transmittance;
        }))
        return true;
    if (!scene.lights.empty() || scene.background) return true;
    for (size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].emission && isUsed(reading, i)) return true;
    return false;
}

/// Files that are being read: each a scene of which the one before has a pass.
using OpenFiles = std::vector<std::filesystem::path>;

std::filesystem::path canonicalOf(const std::filesystem::path& path) {
    std::error_code failed;
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, failed);
    return failed ? path : canonical;
}

Scene loadOpen(const std::filesystem::path& path, const Library& library, const LoadOptions& options,
               Notes& notes, OpenFiles& open);

std::shared_ptr<const Scene> loadOther(const std::filesystem::path& path, const SourceLocation& where,
                                       const Library& library, const LoadOptions& options, Notes& notes,
                                       OpenFiles& open) {
    const std::filesystem::path file = canonicalOf(path);
    if (std::find(open.begin(), open.end(), file) != open.end()) {
        std::string chain;
        for (const std::filesystem::path& each : open)
            chain += each.filename().string() + " -> ";
        throw InputError(where, "scenes have passes of each other: " + chain + file.filename().string());
    }
    LoadOptions others;
    others.restricted = options.restricted;
    return std::make_shared<const Scene>(loadOpen(path, library, others, notes, open));
}

Scene readScene(const std::filesystem::path& path, const Library& library, const LoadOptions& options,
                SpectrumResolver& resolver, Notes& notes, OpenFiles& open) {
    XmlDocument document(readFile(path), path.string());
    applyOverrides(document, options.set);
    checkStructure(document);

    Reading reading{document, resolver, notes};
    reading.restricted = options.restricted;
    reading.scene = emptyScene();
    reading.otherScene = [&](const std::filesystem::path& other, const SourceLocation& where) {
        return loadOther(other, where, library, options, notes, open);
    };
    reading.files.add(path);
    readHeader(reading);
    readSpectra(reading);
    readMaterials(reading);
    readGraph(reading);
    readBackground(reading);
    readDetectors(reading);
    if (reading.scene.cameras.empty()) {
        reading.scene.cameras.push_back(framingCamera(reading.scene));
        reading.scene.nodes[0].cameras.push_back(0);
        notes.say("the scene has no camera: it is framed from the front, a little above");
    }
    readPasses(reading);
    readBatch(reading);
    warnOfUnused(reading);
    if (!hasLight(reading)) notes.warn({path.string(), 0, 0}, "the scene has no light: it is black");
    reading.scene.filesRead = reading.files.list();
    return std::move(reading.scene);
}

Scene loadOpen(const std::filesystem::path& path, const Library& library, const LoadOptions& options,
               Notes& notes, OpenFiles& open) {
    const std::filesystem::path folder =
        path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    SpectrumResolver resolver(library, folder, options.restricted, notes);
    const bool ours = isOurs(path);
    if (!ours && !options.set.empty())
        throw UsageError(fmt::format("--set changes scenes in XML; {} is a foreign model", path.string()));
    open.push_back(canonicalOf(path));
    Scene scene = ours ? readScene(path, library, options, resolver, notes, open)
                       : sceneFromModel(path, resolver, options.restricted, notes);
    open.pop_back();
    scene.file = path.string();
    if (scene.filesRead.empty()) scene.filesRead = {path.string()};
    scene.sha256 = hashOf(scene.filesRead);
    return scene;
}

}  // namespace

Scene loadScene(const std::filesystem::path& path, const Library& library, const LoadOptions& options,
                Notes& notes) {
    OpenFiles open;
    return loadOpen(path, library, options, notes, open);
}

}  // namespace spectrad
