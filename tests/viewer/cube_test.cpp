// Cubes in the viewer: what their pixels, bands and lamps must show.
#include "colour/develop.h"
#include "spectrum/projection.h"
#include "viewer/support.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using namespace spectrad;
using view::Codes;
using view::CubeSubject;
using view::test::canView;
using view::test::Desk;

namespace {

constexpr int width = 23, height = 70;

/// Smooth, and different everywhere.
std::filesystem::path writeSample(const TemporaryFolder& folder, CubeKind kind = CubeKind::radiance) {
    CubeInfo info;
    info.width = width;
    info.height = height;
    info.wavelengths = regularWavelengths(400, 700, 10, {});
    info.projectionStated = true;
    info.kind = kind;
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
        for (const double nm : info.wavelengths.nm)
            for (int x = 0; x < width; ++x)
                values.push_back(
                    static_cast<float>(0.5 + 0.4 * std::sin(nm / 40 + 0.3 * x) * std::cos(0.1 * y)));
    const auto writer = createExr(folder.path() / "cube.exr", info, {});
    writer->write(height, values.data(), std::vector<float>(size_t{3} * width * height).data());
    (void)writer->finish();
    return folder.path() / "cube.exr";
}

}  // namespace

TEST_CASE("a cube that is read in strips shows what one in memory does") {
    const TemporaryFolder folder;
    const auto file = writeSample(folder);
    const Library library = Library::open();
    Notes notes;
    CubeSubject held(file, library, notes), streamed(file, library, notes, 5 * width * 31 * sizeof(float));
    const view::Look look = held.firstLook();
    CHECK(look.lights.empty());
    const ChannelImage a = held.xyz(look), b = streamed.xyz(look);
    CHECK(a.plane == b.plane);
    for (const int y : {0, 69, 4, 5, 33})
        CHECK(held.still(look)->spectrumAt(7, y) == streamed.still(look)->spectrumAt(7, y));
    CHECK(streamed.still(look)->spectrumAt(width, 0).empty());
    view::BandPicture picture;
    picture.bands = {20, 10, 5};
    Codes one, two;
    held.showBands(picture, one);
    streamed.showBands(picture, two);
    CHECK(one == two);
}

TEST_CASE("a band is grey, its 99th percentile white; three bands are red, green and blue") {
    const TemporaryFolder folder;
    const auto file = writeSample(folder);
    const Library library = Library::open();
    Notes notes;
    CubeSubject cube(file, library, notes);
    const Cube whole = readCube(file, notes);
    const Encoder8 encoder(srgbDisplay());
    view::BandPicture grey;
    grey.bands.fill(12);
    grey.ev = -1;
    Codes codes;
    cube.showBands(grey, codes);
    std::vector<double> values;
    for (int y = 0; y < height; ++y)
        values.insert(values.end(), whole.row(y, 12), whole.row(y, 12) + width);
    std::vector<double> sorted = values;
    const double white = quantile(sorted, 0.99) * 2;
    CHECK(grey.white[0] == Approx(white));
    for (size_t i = 0; i < codes.size(); i += 37) {
        const std::uint32_t code = encoder(values[i] / white);
        CHECK(codes[i] == (0xff000000u | code << 16 | code << 8 | code));
    }
    view::BandPicture colours;
    colours.bands = {12, 3, 25};
    cube.showBands(colours, codes);
    const auto at = [&](size_t band) { return static_cast<double>(whole.row(9, band)[4]); };
    const std::uint32_t pixel = codes[9 * width + 4];
    CHECK((pixel & 255) == encoder(at(12) / colours.white[0]));
    CHECK((pixel >> 8 & 255) == encoder(at(3) / colours.white[1]));
    CHECK((pixel >> 16 & 255) == encoder(at(25) / colours.white[2]));
}

TEST_CASE("a reflectance is relit: its colours are those of light x reflectance, integrated") {
    const TemporaryFolder folder;
    const auto file = writeSample(folder, CubeKind::reflectance);
    const Library library = Library::open();
    Notes notes;
    const SpectrumResolver resolver(library, ".", false, notes);
    CubeSubject cube(file, library, notes);
    const Cube whole = readCube(file, notes);
    view::Look look = cube.firstLook();
    REQUIRE(look.lights.size() == 1);
    for (const char* lamp : {"illuminants/D65", "illuminants/A", "illuminants/FL11"}) {
        CAPTURE(lamp);
        const Spectrum light = resolver.resolve(lamp, Role::light, {});
        look.lights[0].emitter.spectrum = light;
        look.lights[0].times = 1;
        const ChannelImage xyz = cube.xyz(look);
        const White white = cube.white(look);
        CHECK(white.xyz[1] == Approx(100));
        for (const int y : {0, 41}) {
            std::vector<double> bands = cube.still(look)->spectrumAt(11, y);
            // The curve that has these averages, times the lamp, natively; 400 to 700 nm of it.
            const Curve curve = Curve::table(whole.info.wavelengths.nm,
                                             nodalValues(whole.info.wavelengths, bands), Outside::zero);
            const std::array<const Curve*, 2> product{&curve, &light.curve()};
            const std::array<const Curve*, 1> alone{&light.curve()};
            const Triple expected = seenXyz(*look.eye, product), perfect = seenXyz(*look.eye, alone);
            for (size_t c = 0; c < 3; ++c)
                CHECK(xyz.plane[c][static_cast<size_t>(y) * width + 11] ==
                      Approx(100 * expected[c] / perfect[1]).epsilon(2e-3).margin(0.02));
        }
        look.lights[0].times = 0.5;
        CHECK(cube.xyz(look).plane[1][5] == Approx(0.5 * xyz.plane[1][5]));
    }
}

TEST_CASE("what a cube cannot do is refused, and nothing has changed") {
    if (!canView()) return;
    const TemporaryFolder folder;
    Desk desk(writeSample(folder));
    for (const char* wrong : {"light.spectrum=illuminants/A", "lamp.on=false", "samples=4", "band=300",
                              "band=red", "bands=500,600", "bands=500,600,900", "picture=false", "tone=curve",
                              "degree=2", "mapping=none", "display=none"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(desk.session->set(wrong), Error);
    }
    CHECK(desk.session->picture == view::Picture::observer);
    // Hands on a cube: it is moved and brought nearer, and clicks select nothing.
    desk.viewer->showPanels(false);
    const Picture8 first = desk.viewer->picture();
    desk.play("camera orbit 10 10\nclick 5 5\nkey f\nkey ctrl+1\nkey 1");
    CHECK(desk.viewer->picture().pixels == first.pixels);
    desk.play("drag 10 10 14 12");
    const Picture8 moved = desk.viewer->picture();
    for (size_t c = 0; c < 3; ++c)
        CHECK(moved.pixels[3 * (12 * width + 14) + c] == first.pixels[3 * (10 * width + 10) + c]);
    desk.play("move 3 3\nscroll 4\nkey home");
    CHECK(desk.viewer->picture().pixels == first.pixels);
    desk.play("resize 46 140");
    const Picture8 doubled = desk.viewer->picture();
    CHECK(doubled.pixels[3 * (46 * 21 + 21)] == first.pixels[3 * (width * 10 + 10)]);
}

TEST_CASE("a cube seen with two eyes: divider, difference, mixture") {
    if (!canView()) return;
    const TemporaryFolder folder;
    Desk desk(writeSample(folder, CubeKind::reflectance));
    desk.session->set("look=B");
    desk.session->set("light.spectrum=illuminants/A");
    Codes a, b, left, right;
    desk.session->set("mode=split");
    REQUIRE(desk.refresh(left, right));
    CHECK(left != right);
    desk.session->set("mode=mixture");
    desk.session->set("mix=0");
    (void)desk.refresh(a, b);
    CHECK(a == left);
    desk.session->set("mix=1");
    (void)desk.refresh(a, b);
    CHECK(a == right);
    desk.session->set("mode=difference");
    (void)desk.refresh(a, b);
    REQUIRE(desk.session->painting().difference);
    CHECK(desk.session->painting().difference->max > 1);
}

TEST_CASE("a thousand actions on a cube: no error of OpenGL, and every picture comes back") {
    if (!canView()) return;
    const TemporaryFolder folder;
    Desk desk(writeSample(folder, CubeKind::reflectance));
    desk.viewer->showPanels(false);
    const Picture8 first = desk.viewer->picture();
    const std::string round =
        "move 5 20\nkey l\nclick 10 32\nscroll 2\ndrag 10 30 14 34\nkey tab\nkey c\nkey h\nresize 120 "
        "80\nmove 60 40\n"
        "key p\nset light.times=0.7\nset mix=0.3\nset band=550\nset bands=600,500,450\nset picture=observer\n"
        "key tab\nresize 0 0\nwait 1\nresize 23 70\nkey h\nkey x\nkey home\nset look=A\nkey e\n";
    for (int i = 0; i < 40; ++i)  // 25 actions each
        desk.play(round);
    desk.session->pins.clear();
    desk.play(
        "set look=A\nset light.spectrum=illuminants/D65\nset light.times=1\nset mode=single\n"
        "set white=100,100,100\nset white=\nset exposure=0\nkey escape");
    desk.session->heldLuminance = 100;
    const bool same = desk.viewer->picture().pixels == first.pixels;
    CHECK(same);
}
