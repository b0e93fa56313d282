// spectrad info SCENE --reradiation MATERIAL -o FILE: a fluorescent material as a Donaldson matrix.
#include "base/files.h"
#include "cli/info.h"
#include "render/reradiation_matrix.h"
#include "spectrum/library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace spectrad {

void writeReradiation(const SceneArguments& arguments, const std::string& material, const std::string& target,
                      bool json, Console& console) {
    const std::string extension = extensionOf(target);
    if (extension != ".exr" && extension != ".csv")
        throw UsageError("-o: '" + target + "' must end in .exr or .csv");
    requireOther("-o", target, arguments.file);
    requireWritable(target);
    // Excitation begins in the ultraviolet, whatever the scene's bands.
    const Wavelengths grid =
        renderSettings(arguments).wavelengths.value_or(regularWavelengths(300, 780, 5, {}));
    const Library library = Library::open();
    const Scene scene = loadScene(arguments.file, library, loadOptions(arguments), console.notes());
    const Material* found = nullptr;
    std::vector<std::string> known;
    for (const Material& m : scene.materials) {
        if (m.name == material) found = &m;
        if (!m.fluorescence.empty()) known.push_back(m.name);
    }
    if (!found)
        throw UsageError(fmt::format("--reradiation: the scene has no material '{}' (fluorescent are: {})",
                                     material,
                                     known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
    const std::vector<BispectralCell> cells = reradiationMatrix(*found, grid.nm, console.notes());
    if (extension == ".csv")
        writeFile(target, bispectralCsv(cells));
    else
        writeBispectral(target, cells,
                        {{"software", "Spectrad " SPECTRAD_VERSION},
                         {"scene", scene.file},
                         {"material", material},
                         {"quantity", "bispectral radiance factor"}});
    console.printNotes();
    if (json)
        printJson({{"output", target},
                   {"material", material},
                   {"wavelengths_nm", grid.nm},
                   {"cells", cells.size()}});
}

}  // namespace spectrad
