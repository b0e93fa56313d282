// <region> and <sweep>.
#include "base/limits.h"
#include "base/text.h"
#include "scene/reading.h"

#include <fmt/format.h>

namespace spectrad {

namespace {

Region readRegion(const Reading& reading, const Element& element) {
    Region region;
    region.name = element.text("name");
    region.where = element.where();
    if (element.has("rect") == element.has("node"))
        element.fail("needs either 'rect' (pixels) or 'node', not both");
    if (element.has("node")) {
        region.node = reading.nodes.find(element.text("node"), element.where("node"));
        return region;
    }
    const std::vector<double> numbers = element.numbers("rect", {4});
    for (size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] != static_cast<int>(numbers[i]) || numbers[i] < (i < 2 ? 0 : 1) ||
            numbers[i] > largestSide)
            element.fail("rect", fmt::format("expected x y width height in whole pixels, (0,0) top left, "
                                             "sides of 1 to {}",
                                             largestSide));
    region.rect = {static_cast<int>(numbers[0]), static_cast<int>(numbers[1]), static_cast<int>(numbers[2]),
                   static_cast<int>(numbers[3])};
    return region;
}

SweepAxis readAxis(const Element& element) {
    SweepAxis axis;
    axis.where = element.where();
    const std::string attributes = element.text("attributes"), values = element.text("values");
    for (const std::string_view attribute : words(attributes)) {
        const size_t dot = attribute.find('.');
        if (dot == 0 || dot == std::string_view::npos || dot + 1 == attribute.size())
            element.fail("attributes",
                         fmt::format("'{}' is not NAME.ATTRIBUTE, as in lamp.spectrum", attribute));
        axis.attributes.emplace_back(attribute);
    }
    for (const std::string_view value : split(values, '|')) {
        if (trimmed(value).empty()) element.fail("values", "a value is empty (values stand with | between)");
        axis.values.emplace_back(trimmed(value));
    }
    return axis;
}

}  // namespace

void readBatch(Reading& reading) {
    NameTable regions{"region"}, sweeps{"sweep"};
    Scene& scene = reading.scene;
    for (const pugi::xml_node node : reading.document.root().children("region")) {
        Region region = readRegion(reading, Element(reading.document, node));
        regions.add(region.name, static_cast<Index>(scene.regions.size()), region.where);
        scene.regions.push_back(std::move(region));
    }
    for (const pugi::xml_node node : reading.document.root().children("sweep")) {
        const Element element(reading.document, node);
        Sweep sweep;
        sweep.name = element.text("name");
        sweep.where = element.where();
        if (element.has("camera")) {
            sweep.camera = element.text("camera");
            static_cast<void>(reading.cameras.find(sweep.camera, element.where("camera")));
        }
        if (element.has("pass")) {
            sweep.pass = element.text("pass");
            static_cast<void>(reading.passes.find(sweep.pass, element.where("pass")));
        }
        const std::string detectors = element.text("detectors");
        for (const std::string_view detector : words(detectors))
            sweep.detectors.emplace_back(detector);
        for (const pugi::xml_node vary : node.children("vary"))
            sweep.axes.push_back(readAxis(Element(reading.document, vary)));
        sweeps.add(sweep.name, static_cast<Index>(scene.sweeps.size()), sweep.where);
        scene.sweeps.push_back(std::move(sweep));
    }
}

}  // namespace spectrad
