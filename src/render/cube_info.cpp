#include "render/cube_info.h"

#include "base/text.h"
#include "render/cube_light.h"

#include <fmt/format.h>

namespace spectrad {

CubeInfo cubeInfoOf(const Scene& scene, const Plan& plan, const Device& device, const std::string& software,
                    const std::string& command) {
    CubeInfo info;
    info.width = plan.view.width;
    info.height = plan.view.height * plan.faces;
    info.wavelengths = plan.wavelengths;
    info.projectionStated = true;
    info.kind = plan.as == PassKind::reflectance     ? CubeKind::reflectance
                : plan.as == PassKind::transmittance ? CubeKind::transmittance
                : plan.as == PassKind::irradiance    ? CubeKind::irradiance
                                                     : CubeKind::radiance;
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
