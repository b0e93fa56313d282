// Panels by hand. "Save": what is clicked is written, under the name that is typed; "Lights": what is chosen
// shines.
#include "base/files.h"
#include "support/read_picture.h"
#include "viewer/support.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

using namespace spectrad;
using view::test::canView;
using view::test::Desk;
using view::test::smallScene;

namespace {

using Colour = std::array<int, 3>;
constexpr Colour header{56, 77, 97};  // of sections that fold, viewer.cpp

struct Place {
    int x = 0, y = 0;
};

Colour at(const Picture8& picture, int x, int y) {
    const size_t from =
        3 * (static_cast<size_t>(y) * static_cast<size_t>(picture.width) + static_cast<size_t>(x));
    return {picture.pixels[from], picture.pixels[from + 1], picture.pixels[from + 2]};
}

bool near(const Colour& a, const Colour& b) {
    int worst = 0;
    for (size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(a[c] - b[c]));
    return worst <= 2;
}

/// The lowest section's title, which is that of Save.
std::optional<Place> lowestHeader(const Picture8& picture) {
    const int x = picture.width - 30;
    for (int y = picture.height - 1; y >= 0; --y)
        if (near(at(picture, x, y), header)) return Place{x, y - 6};
    return std::nullopt;
}

/// Middles of what lies side by side in the lowest row of buttons below the title: runs of their blue.
std::vector<Place> lowestButtons(const Picture8& picture, int below) {
    const auto isBlue = [](const Colour& c) { return c[2] > 90 && c[2] > 2 * c[0] && c[2] > c[1] + 25; };
    std::vector<Place> found;
    for (int y = picture.height - 1; y > below && found.empty(); --y)
        for (int x = picture.width - 250; x < picture.width - 10; ++x) {
            if (!isBlue(at(picture, x, y))) continue;
            int end = x;
            while (end < picture.width - 1 && isBlue(at(picture, end, y)))
                ++end;
            if (end - x > 15) found.push_back({(x + end) / 2, y - 6});
            x = end;
        }
    return found;
}

void click(Desk& desk, Place place) {
    desk.play("click " + std::to_string(place.x) + " " + std::to_string(place.y));
    (void)desk.viewer->picture();
}

}  // namespace

TEST_CASE("the Save panel writes picture, cube, scene and pins under the name in its field") {
    if (!canView()) return;
    Desk desk{std::string(smallScene())};
    desk.play("resize 700 1500\npin 30 30\nset lamp.spectrum=illuminants/A\nmove 300 1400");
    const auto title = lowestHeader(desk.viewer->picture());
    REQUIRE(title);
    click(desk, *title);
    desk.play("move 300 1400");
    const Picture8 open = desk.viewer->picture();
    const std::vector<Place> buttons = lowestButtons(open, title->y);
    REQUIRE(buttons.size() == 4);
    const auto path = [&](const char* name) { return desk.folder.path() / name; };
    for (const Place& button : buttons)
        click(desk, button);
    CHECK(readPicture8(path("scene-view.png")).width == 700);
    Notes notes;
    CHECK(readCube(path("scene-view.exr"), notes).info.height == 1500);
    CHECK_THAT(readFile(path("scene-view.xml")), Catch::Contains("illuminants/A\" intensity=\"300 cd"));
    CHECK_THAT(readFile(path("scene-view.csv")), Catch::Contains("# at 30,30: XYZ"));

    // The field lies between title and buttons; what is typed goes to its end.
    click(desk, {title->x - 60, (title->y + buttons[0].y) / 2});
    desk.play("key end\ntype 2");
    (void)desk.viewer->picture();
    click(desk, buttons[2]);
    CHECK_THAT(readFile(path("scene-view2.xml")), Catch::Contains("illuminants/A"));
    CHECK_FALSE(std::filesystem::exists(path("scene-view2.png")));
}

TEST_CASE("a lamp is chosen from its list by typing, and the panel goes on with it") {
    if (!canView()) return;
    Desk desk{std::string(smallScene())};
    desk.play("resize 800 600");
    (void)desk.viewer->picture();
    click(desk, {650, 83});  // the first light's list
    desk.play("type illuminants/FL11\nkey enter");
    (void)desk.viewer->picture();
    CHECK(desk.session->look(0).lights[0].emitter.spectrum.text == "illuminants/FL11");
    CHECK(desk.session->look(0).lights[0].times == 1);
}
