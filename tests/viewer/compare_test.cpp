// Two looks at once: the divider, the map of differences, mixtures; and windows that are no windows.
#include "base/text.h"
#include "viewer/support.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;
using view::Codes;
using view::test::canView;
using view::test::Desk;
using view::test::replaced;
using view::test::smallScene;

namespace {

constexpr int width = 96;

/// Pixels of two pictures within columns [from, to) that differ.
size_t different(const Picture8& a, const Picture8& b, int from, int to) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const int x = static_cast<int>(i / 3) % width;
        count += x >= from && x < to && a.pixels[i] != b.pixels[i];
    }
    return count;
}

}  // namespace

TEST_CASE("left of the divider is look A, right of it look B, also when it is dragged") {
    if (!canView()) return;
    Desk desk(smallScene());
    desk.viewer->showPanels(false);
    const Picture8 a = desk.viewer->picture();
    desk.play(
        "set look=B\nset lamp.spectrum=illuminants/LED-B3\nset red.reflectance=charts/colorchecker/blue\n"
        "set mode=split\nset divider=0");
    const Picture8 b = desk.viewer->picture();
    CHECK(different(a, b, 0, width) > 1000);
    desk.play("set divider=0.25");
    const Picture8 quarter = desk.viewer->picture();
    CHECK(different(quarter, a, 0, 24) == 0);
    CHECK(different(quarter, b, 24, width) == 0);
    desk.play("drag 24 30 72 30");
    const Picture8 dragged = desk.viewer->picture();
    CHECK(desk.session->divider == Approx(0.75));
    CHECK(different(dragged, a, 0, 72) == 0);
    CHECK(different(dragged, b, 72, width) == 0);
}

TEST_CASE("the map of differences has the colours of compare, each pixel its own difference") {
    if (!canView()) return;
    Desk desk(smallScene());
    desk.session->stand.samples = 4;
    desk.session->set("look=B");
    desk.session->set("observer=cie1964-10");
    desk.session->set("mode=difference");
    desk.session->differenceTop = 3;
    Codes codes, unused;
    (void)desk.refresh(codes, unused);
    const White white =
        withLuminance(desk.session->whiteOf(desk.session->look(0)), *desk.session->heldLuminance);
    const ColourDifference expected =
        colourDifference(desk.session->subject().xyz(desk.session->look(0)),
                         desk.session->subject().xyz(desk.session->look(1)), white.xyz);
    const std::vector<std::uint8_t> rgb = falseColours(expected.map, 3);
    size_t wrong = 0;
    for (size_t i = 0; i < codes.size(); ++i)
        wrong += codes[i] != (0xff000000u | std::uint32_t{rgb[3 * i + 2]} << 16 |
                              std::uint32_t{rgb[3 * i + 1]} << 8 | rgb[3 * i]);
    CHECK(wrong == 0);
    REQUIRE(desk.session->painting().difference);
    CHECK(desk.session->painting().difference->max == expected.max);
    CHECK(desk.session->painting().difference->max > 0.5);
}

TEST_CASE("a mixture of two lamps is what the mixed spectrum gives, fluorescence included") {
    if (!canView()) return;
    // 100 cd of each of two shapes make a lamp of 200 cd whose spectrum is the sum of both.
    const std::string lamp = "spectrum=\"illuminants/D65\" intensity=\"300 cd\"";
    Desk desk(replaced(smallScene(), lamp, "spectrum=\"blackbody:2856\" intensity=\"300 cd\""));
    desk.session->stand.samples = 4;
    desk.session->set("look=B");
    desk.session->set("lamp.spectrum=blackbody:6500");
    desk.session->set("mode=mixture");
    desk.session->set("mix=0.4");
    desk.session->set("adapt=none");
    const Library library = Library::open();
    const std::array<std::string, 2> shape{"blackbody:2856", "blackbody:6500"};
    Notes notes;
    const SpectrumResolver resolver(library, ".", false, notes);
    const Detector observer = standardObserver(library);
    std::array<Curve, 2> part{resolver.resolve(shape[0], Role::light, {}).curve(),
                              resolver.resolve(shape[1], Role::light, {}).curve()};
    std::string pairs;
    std::array<double, 2> luminous{};
    for (size_t i = 0; i < 2; ++i) {
        const std::array<const Curve*, 1> alone{&part[i]};
        luminous[i] = respondXyz(observer, alone)[1];
    }
    for (int nm = 200; nm <= 1000; ++nm)
        pairs += std::to_string(nm) + ":" +
                 shortest(0.6 * part[0].at(nm) / luminous[0] + 0.4 * part[1].at(nm) / luminous[1]) + " ";
    Desk mixed(replaced(smallScene(), lamp, "spectrum=\"" + pairs + "\" intensity=\"300 cd\""));
    mixed.session->stand.samples = 4;
    mixed.session->set("adapt=none");
    Codes a, b, unused;
    (void)desk.refresh(a, unused);
    mixed.session->heldLuminance = desk.session->heldLuminance;
    (void)mixed.refresh(b, unused);
    REQUIRE(a.size() == b.size());
    int worst = 0;
    for (size_t i = 0; i < a.size(); ++i)
        for (const int shift : {0, 8, 16})
            worst = std::max(worst, std::abs(static_cast<int>(a[i] >> shift & 255) -
                                             static_cast<int>(b[i] >> shift & 255)));
    CHECK(worst <= 1);
}

TEST_CASE("minimised, of no size, closed: nothing is drawn, nothing fails, and it comes back as it was") {
    if (!canView()) return;
    Desk desk(smallScene());
    desk.viewer->showPanels(false);
    const Picture8 before = desk.viewer->picture();
    desk.play(
        "resize 0 0\nwait 3\nset lamp.spectrum=illuminants/A\nkey l\nmove 3 3\nclick 5 5\nwait 2\n"
        "set lamp.spectrum=illuminants/D65\nresize 96 64");
    CHECK(desk.viewer->picture().pixels == before.pixels);
    CHECK_THROWS_AS(desk.play("resize 0 5\nscreenshot x.png"), InputError);
    desk.play("resize 1 1\nwait 2\nresize 96 64\nclose\nset lamp.on=off");
    CHECK(desk.viewer->closed());
    CHECK(desk.session->look(0).lights[0].on);  // what follows `close` is not played
}
