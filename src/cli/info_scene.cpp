// spectrad info SCENE: the plan, that is what this scene needs and nothing else, before anything is rendered.
#include "base/text.h"
#include "cli/info.h"
#include "cli/info_material.h"
#include "render/renderer.h"
#include "spectrum/library.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace spectrad {

namespace {

/// How the picture is cut on a device.
struct Strips {
    std::string device;
    int rows = 0;
    std::uint64_t bytes = 0;
};

/// Nothing where no device is; a device that is asked for and is not there is an error.
std::optional<Strips> stripsOf(const Plan& plan, const std::optional<int>& number, Notes& notes) {
    if (!number && listDevices().empty()) {
        notes.say("no OpenCL device here: the rows of a strip are not known");
        return std::nullopt;
    }
    const Device device = Device::open(number);
    const Renderer renderer(device, plan);
    return Strips{device.info().name, renderer.stripRows(), renderer.bytesPerStrip()};
}

/// Of cameras or passes.
template <typename Named>
std::vector<std::string> namesOf(const std::vector<Named>& all) {
    std::vector<std::string> names;
    names.reserve(all.size());
    for (const Named& one : all)
        names.push_back(one.name);
    return names;
}

/// Those that surfaces of this picture wear; the world's first entry is what stands behind them.
size_t materialsWorn(const Plan& plan) {
    return plan.world.materials.size() - 1;
}

Json described(const Scene& scene, const Plan& plan, const std::vector<MaterialReport>& materials,
               const std::optional<Strips>& strips) {
    return {{"scene", scene.file},
            {"sha256", scene.sha256},
            {"camera", plan.cameraName},
            {"pass", plan.passName},
            {"cameras", namesOf(scene.cameras)},
            {"passes", namesOf(scene.passes)},
            {"width", plan.view.width},
            {"height", plan.view.height},
            {"triangles", plan.triangles()},
            {"lights", plan.lights()},
            {"materials", materialsWorn(plan)},
            {"terms", plan.terms.count()},
            {"features", plan.features},
            {"defines", plan.defines},
            {"bands", plan.wavelengths.size()},
            {"wavelengths_nm", plan.wavelengths.nm},
            {"projection", name(plan.wavelengths.projection)},
            {"samples", plan.samples},
            {"white", {{"name", plan.whiteName}, {"XYZ", plan.white}}},
            {"device", strips ? Json(strips->device) : Json()},
            {"strip_rows", strips ? Json(strips->rows) : Json()},
            {"bytes_per_strip", strips ? Json(strips->bytes) : Json()},
            {"material_reports", described(materials)}};
}

void printTable(const Scene& scene, const Plan& plan, const std::optional<Strips>& strips) {
    const std::vector<double>& nm = plan.wavelengths.nm;
    std::string source = plan.cameraName.empty() ? "" : "camera " + plan.cameraName;
    if (!plan.passName.empty()) source += (source.empty() ? "pass " : ", pass ") + plan.passName;
    printText(fmt::format("scene      {}\n", scene.file));
    if (!source.empty()) printText(fmt::format("view       {}\n", source));
    printText(fmt::format("size       {} x {} pixels, {} samples a pixel\n", plan.view.width,
                          plan.view.height, plan.samples));
    printText(fmt::format("bands      {}, {} to {} nm, {}\n", nm.size(), rounded(nm.front(), 9),
                          rounded(nm.back(), 9), name(plan.wavelengths.projection)));
    printText(fmt::format("triangles  {}\nlights     {}\nmaterials  {}\nterms      {}\n", plan.triangles(),
                          plan.lights(), materialsWorn(plan), plan.terms.count()));
    printText(fmt::format("features   {}\n", fmt::join(plan.features, ", ")));
    printText(fmt::format("defines    {}\n", fmt::join(plan.defines, " ")));
    printText(fmt::format("white      {} (X {}, Y {}, Z {})\n", plan.whiteName, rounded(plan.white[0], 5),
                          rounded(plan.white[1], 5), rounded(plan.white[2], 5)));
    if (strips)
        printText(fmt::format("strips     {} rows, {:.1f} MiB on {}\n", strips->rows,
                              static_cast<double>(strips->bytes) / (1 << 20), strips->device));
}

}  // namespace

void printSceneInfo(const SceneArguments& arguments, bool json, Console& console) {
    const RenderSettings settings = renderSettings(arguments);
    const Library library = Library::open();
    const Scene scene = loadScene(arguments.file, library, loadOptions(arguments), console.notes());
    const Plan plan = makePlan(scene, settings, library, console.notes());
    const std::vector<MaterialReport> materials = reportMaterials(scene, plan.wavelengths, library);
    const std::optional<Strips> strips = stripsOf(plan, deviceNumber(arguments.device), console.notes());
    console.printNotes();
    if (json) {
        printJson(described(scene, plan, materials, strips));
    } else {
        printTable(scene, plan, strips);
        printMaterials(materials);
    }
}

}  // namespace spectrad
