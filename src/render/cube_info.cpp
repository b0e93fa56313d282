#include "render/cube_info.h"

#include "base/text.h"
#include "render/cube_light.h"

#include <fmt/format.h>

namespace spectrad {

namespace {

CubeKind kindOf(PassKind kind) {
    switch (kind) {
        case PassKind::reflectance:
            return CubeKind::reflectance;
        case PassKind::transmittance:
            return CubeKind::transmittance;
        case PassKind::irradiance:
            return CubeKind::irradiance;
        case PassKind::radiance:
            break;
    }
    return CubeKind::radiance;
}

}  // namespace

CubeInfo cubeInfoOf(const Plan& plan) {
    CubeInfo info;
    info.width = plan.view.width;
    info.height = plan.view.height * plan.faces;
    info.wavelengths = plan.wavelengths;
    info.projectionStated = true;
    info.kind = kindOf(plan.as);
    return info;
}

CubeInfo cubeInfoOf(const Scene& scene, const Plan& plan, const Device& device, const std::string& software,
                    const std::string& command) {
    CubeInfo info = cubeInfoOf(plan);
    info.attributes = {{"software", software},
                       {"scene", scene.file},
                       {"sceneSha256", scene.sha256},
                       {"commandLine", command},
                       {"samples", std::to_string(plan.samples)},
                       {"device", device.info().name + " (" + device.info().platform + ")"},
                       {attribute::white, plan.whiteName},
                       {attribute::whiteXyz, fmt::format("{},{},{}", shortest(plan.white[0]),
                                                         shortest(plan.white[1]), shortest(plan.white[2]))}};
    if (!plan.cameraName.empty()) info.attributes["camera"] = plan.cameraName;
    if (!plan.passName.empty()) info.attributes["pass"] = plan.passName;
    return info;
}

}  // namespace spectrad
