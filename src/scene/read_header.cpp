// The <scene> element itself and <wavelengths>.
#include "base/text.h"
#include "scene/reading.h"

namespace spectrad {

namespace {

Wavelengths readWavelengths(const Element& element) {
    Wavelengths result;
    const std::string body = element.body();
    if (!trimmed(body).empty()) {
        for (const char* attribute : {"from", "to"})
            element.refuse(attribute, "cannot stand beside a list of wavelengths");
        result = parseWavelengths(body, element.whereBody());
        result.step = element.number("step", result.step, positive);
    } else {
        result =
            regularWavelengths(element.number("from", 380, positive), element.number("to", 780, positive),
                               element.number("step", 5, positive), element.where());
    }
    result.projection = element.has("projection")
                            ? parseProjection(element.text("projection"), element.where("projection"))
                            : Projection::slit;
    return result;
}

}  // namespace

void readHeader(Reading& reading) {
    const Element root(reading.document, reading.document.root());
    if (root.has("version") && root.text("version") != "1")
        root.fail("version", "this program reads version 1");
    reading.scene.metresPerUnit = root.choice<double>(
        "unit",
        {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}, 1);
    reading.scene.shadows = root.boolean("shadows", false);
    const auto wavelengths = root.child("wavelengths");
    reading.scene.wavelengths =
        wavelengths ? readWavelengths(*wavelengths) : regularWavelengths(380, 780, 5, root.where());
}

}  // namespace spectrad
