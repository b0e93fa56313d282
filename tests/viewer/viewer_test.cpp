// What the viewer promises: exact colours after every change, a meter that is measure's, no error and no leak
// in long sessions.
#include "colour/difference.h"
#include "render/renderer.h"
#include "support/temporary_folder.h"
#include "viewer/support.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <unistd.h>

using namespace spectrad;
using view::test::canView;
using view::test::Desk;
using view::test::rendered;
using view::test::replaced;
using view::test::smallScene;
using view::test::worstDifference;

namespace {

size_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    size_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("colours after each change are those of a scene rendered with it") {
    if (!canView()) return;
    Desk desk(smallScene());
    constexpr double bound = 0.05;  // ΔE00; bands of 5 nm against exact spectra
    CHECK(worstDifference(desk, smallScene()) < bound);

    std::string changed = replaced(smallScene(), "illuminants/D65", "illuminants/LED-B3");
    desk.session->set("lamp.spectrum=illuminants/LED-B3");
    CHECK(worstDifference(desk, changed) < bound);

    changed = replaced(changed, "5 cd/m2", "1.25 cd/m2");
    desk.session->set("fill.times=0.25");
    CHECK(worstDifference(desk, changed) < bound);

    changed = replaced(changed, "charts/colorchecker/red", "charts/colorchecker/blue");
    desk.session->set("red.reflectance=charts/colorchecker/blue");
    CHECK(worstDifference(desk, changed) < bound);

    desk.session->set("observer=cie1964-10");
    CHECK(worstDifference(desk, changed) < bound);

    changed = replaced(changed, "300 cd", "0 cd");
    desk.session->set("lamp.on=false");
    CHECK(worstDifference(desk, changed) < bound);
    changed = replaced(changed, "0 cd\"", "300 cd\"");
    desk.session->set("lamp.on=true");
    CHECK(worstDifference(desk, changed) < bound);
}

TEST_CASE("the spectrum of a pixel is the rendered cube's, after changes too") {
    if (!canView()) return;
    Desk desk(smallScene());
    desk.session->stand.samples = 16;
    desk.session->set("lamp.spectrum=illuminants/FL11");
    const Cube cube = rendered(replaced(smallScene(), "illuminants/D65", "illuminants/FL11"), desk);
    double worst = 0;
    for (int y = 1; y < cube.info.height; y += 9)
        for (int x = 1; x < cube.info.width; x += 13) {
            const std::vector<double> spectrum = desk.measured(x, y).spectrum;
            REQUIRE(spectrum.size() == cube.info.wavelengths.size());
            double most = 1e-30;
            for (size_t band = 0; band < spectrum.size(); ++band)
                most = std::max(most, std::abs(static_cast<double>(cube.row(y, band)[x])));
            for (size_t band = 0; band < spectrum.size(); ++band)
                worst = std::max(worst,
                                 std::abs(spectrum[band] - static_cast<double>(cube.row(y, band)[x])) / most);
        }
    CHECK(worst < 1e-6);
    CHECK(desk.measured(-1, 5).spectrum.empty());
    CHECK(desk.measured(96, 5).spectrum.empty());
}

TEST_CASE("a mixture of lights lies between its ends, exactly, fluorescence included") {
    if (!canView()) return;
    Desk desk(smallScene());
    desk.session->set("look=B");
    desk.session->set("lamp.spectrum=illuminants/A");
    view::Codes a, b, mixed, unused;
    desk.session->set("mode=mixture");
    desk.session->set("mix=0");
    (void)desk.refresh(mixed, unused);
    desk.session->set("mode=single");
    (void)desk.refresh(a, unused);
    CHECK(a == mixed);
    desk.session->set("mode=mixture");
    desk.session->set("mix=1");
    (void)desk.refresh(b, unused);
    CHECK(a != b);
    CHECK_FALSE(desk.refresh(b, unused));
}

TEST_CASE("nodes and materials are found where they are clicked") {
    if (!canView()) return;
    Desk desk(smallScene());
    desk.session->stand.samples = 16;
    const auto ball = desk.session->scene()->hitAt(30, 32);
    REQUIRE(ball);
    CHECK(ball->node == "ball");
    CHECK(ball->material == "lacquer");
    CHECK(std::abs(length(ball->place - Vec3{-1.3, 0, 0}) - 1) < 0.02);
    CHECK_FALSE(desk.session->scene()->hitAt(1, 1));
    // The look at the picture survives the look at one row.
    view::Codes before, after, unused;
    (void)desk.refresh(before, unused);
    (void)desk.session->scene()->hitAt(60, 32);
    desk.session->invalidate();
    (void)desk.refresh(after, unused);
    CHECK(before == after);
}

TEST_CASE("the camera goes round and comes back to the same picture") {
    if (!canView()) return;
    Desk desk(smallScene());
    desk.viewer->showPanels(false);
    const Picture8 first = desk.viewer->picture();
    desk.play("camera orbit 40 20\ncamera dolly 2\ncamera pan 10 5");
    const Picture8 away = desk.viewer->picture();
    CHECK(first.pixels != away.pixels);
    desk.play("key home");
    CHECK(desk.viewer->picture().pixels == first.pixels);
    desk.play("drag 40 40 60 50\nkey ctrl+1\nkey home\nkey 1");
    const Picture8 kept = desk.viewer->picture();
    CHECK(kept.pixels != first.pixels);
    desk.play("camera frame\nkey 1");
    CHECK(desk.viewer->picture().pixels == kept.pixels);
}

TEST_CASE("a thousand actions: no error of OpenGL, no leak") {
    if (!canView()) return;
    Desk desk(smallScene());
    const std::string round =
        "key l\nmove 20 20\nclick 30 32\nscroll 1\ndrag 40 30 48 34\nkey tab\nkey c\nkey h\nresize 120 80\n"
        "move 100 40\npress\nmove 90 44\nrelease\nkey p\nset lamp.times=0.7\nset mix=0.3\nkey tab\nresize 0 "
        "0\n"
        "wait 1\nresize 96 64\nkey h\nkey x\nkey home\nscroll -1\nset exposure=auto\n";
    size_t early = 0;
    for (int i = 0; i < 40; ++i) {  // 25 actions each
        desk.play(round);
        if (i == 9) early = residentBytes();
        desk.session->pins.clear();
    }
    const size_t late = residentBytes();
    constexpr size_t slack = size_t{12}
                             << 20;  // allocators keep some; an image leaked a frame would be 30 MB
    CHECK(late < early + slack);
}

TEST_CASE("what cannot be is refused, and nothing has changed") {
    if (!canView()) return;
    Desk desk(smallScene());
    const std::uint64_t before = desk.session->look(0).version;
    for (const char* wrong :
         {"lamp.spectrum=illuminants/D66", "lamp.colour=red", "lampe.on=off", "gold.reflectance=constant:1",
          "red.reflectance=constant:2", "observer=nobody", "adapt=cat17", "mode=both", "mix=2", "divider=nan",
          "exposure=bright", "white=nothing", "times", "lamp.times=-1", "samples=0"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(desk.session->set(wrong), Error);
    }
    CHECK(desk.session->look(0).version == before);
}

TEST_CASE("scripts: errors name the line") {
    CHECK(view::parseScript("# only a comment\n\n  key ctrl+1   # and more\n", "s.txt").size() == 1);
    for (const char* wrong : {"jump 1 2", "move 1", "move a b", "key", "key nothing", "click 1 2 third",
                              "resize -1 5", "camera fly", "set", "wait nan"}) {
        CAPTURE(wrong);
        CHECK_THROWS_WITH(view::parseScript(std::string("wait 1\n") + wrong, "s.txt"),
                          Catch::StartsWith("s.txt:2:1: "));
    }
}
