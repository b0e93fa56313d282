// Displays: primaries, white, transfer functions, and files of them.
#include "colour/display.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;

namespace {

void checkEqual(const Matrix3& m, const Matrix3& expected, double margin) {
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) {
            CAPTURE(i, j);
            CHECK(m[i][j] == Approx(expected[i][j]).margin(margin));
        }
}

std::string errorOf(const std::string& text) {
    try {
        (void)parseDisplay(text, "screen.txt");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

const std::string primaries = "red 0.64 0.33\ngreen 0.30 0.60\nblue 0.15 0.06\n";

}  // namespace

TEST_CASE("sRGB, Display P3 and BT.2020 have the matrices of their standards") {
    checkEqual(srgbDisplay().toXyz,  // IEC 61966-2-1, four decimals
               {{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}}, 6e-5);
    checkEqual(p3Display().toXyz,  // SMPTE EG 432-1 primaries with D65
               {{{0.486571, 0.265668, 0.198217}, {0.228975, 0.691739, 0.079287}, {0, 0.045113, 1.043944}}},
               1e-6);
    checkEqual(rec2020Display().toXyz,  // ITU-R BT.2020 / BT.2407
               {{{0.636958, 0.144617, 0.168881}, {0.262700, 0.677998, 0.059302}, {0, 0.028073, 1.060985}}},
               1e-6);
}

TEST_CASE("Equal signals make the display's white at Y = 1, and XYZ come back from signals") {
    for (const Display& display : {srgbDisplay(), p3Display(), rec2020Display()}) {
        CAPTURE(display.name);
        const Triple white = display.toXyz * Triple{1, 1, 1};
        for (size_t c = 0; c < 3; ++c)
            CHECK(white[c] == Approx(display.white[c]).epsilon(1e-14));
        CHECK(white[1] == Approx(1).epsilon(1e-14));
        checkEqual(display.fromXyz * display.toXyz, diagonal({1, 1, 1}), 1e-14);
    }
}

TEST_CASE("The sRGB curve has the standard's values") {
    const Display srgb = srgbDisplay();
    CHECK(encode(srgb, 0) == 0);
    CHECK(encode(srgb, 1) == Approx(1).epsilon(1e-15));
    CHECK(encode(srgb, 0.18) == Approx(0.461356).margin(1e-6));
    CHECK(encode(srgb, 0.002) == Approx(0.02584).epsilon(1e-12));
    CHECK(decode(srgb, 0.5) == Approx(0.214041).margin(1e-6));
}

TEST_CASE("BT.2020's camera curve has the standard's values; its display shows signals to the power of 2.4") {
    CHECK(decode(rec2020Display(), 0.5) == Approx(std::pow(0.5, 2.4)));
    CHECK(encode(rec2020Display(), 0.18) == Approx(0.489437).margin(1e-6));
    Display display = rec2020Display();
    display.transfer = Display::Transfer::rec2020;
    CHECK(encode(display, 0.01) == Approx(0.045));
    CHECK(encode(display, 0.18) == Approx(0.408848).margin(1e-6));
    CHECK(encode(display, 1) == Approx(1).epsilon(1e-14));
}

TEST_CASE("Encoding clips, loses nothing inside the range, rises, and is undone by decoding") {
    Display gamma = srgbDisplay();
    gamma.transfer = Display::Transfer::gamma;
    gamma.gamma = 2.4;
    Display camera = rec2020Display();
    camera.transfer = Display::Transfer::rec2020;
    for (const Display& display : {srgbDisplay(), camera, gamma}) {
        CHECK(encode(display, -0.5) == 0);
        CHECK(encode(display, 7) == Approx(1).epsilon(1e-14));
        CHECK(encode(display, std::nan("")) == 0);
        double last = -1;
        for (int i = 0; i <= 1000; ++i) {
            const double linear = i / 1000.0, encoded = encode(display, linear);
            CHECK(encoded > last);
            last = encoded;
            CHECK(decode(display, encoded) ==
                  Approx(linear).margin(1e-7));  // sRGB's own constants meet to 1e-7 only
        }
    }
}

TEST_CASE("Eight-bit codes are the rounded encoding, at every value and beyond the range") {
    Display gamma = srgbDisplay();
    gamma.transfer = Display::Transfer::gamma;
    gamma.gamma = 3;
    Display camera = rec2020Display();
    camera.transfer = Display::Transfer::rec2020;
    for (const Display& display : {srgbDisplay(), camera, gamma}) {
        const Encoder8 encoder(display);
        for (int i = -1000; i <= 101000; ++i) {
            const double linear = i / 100000.0, exact = 255 * encode(display, linear);
            if (std::abs(exact - std::floor(exact) - 0.5) < 1e-6) continue;  // the middle between two codes
            if (static_cast<int>(encoder(linear)) != static_cast<int>(std::lround(exact))) {
                CAPTURE(linear, exact);
                REQUIRE(static_cast<int>(encoder(linear)) == static_cast<int>(std::lround(exact)));
            }
        }
        CHECK(encoder(std::nan("")) == 0);
        CHECK(encoder(INFINITY) == 255);
        CHECK(encoder(-INFINITY) == 0);
    }
}

TEST_CASE("A display's file with sRGB's primaries is sRGB") {
    const Display display = parseDisplay(
        "# my screen\n" + primaries + "white 0.3127 0.3290  # D65\r\ntransfer srgb", "screen.txt");
    checkEqual(display.toXyz, srgbDisplay().toXyz, 1e-15);
    CHECK(display.transfer == Display::Transfer::srgb);
    CHECK(parseDisplay(primaries + "white 0.3127 0.3290\ngamma 1.8\n", "f").gamma == 1.8);
    CHECK(parseDisplay(primaries + "white 0.3127 0.3290\ntransfer rec2020", "f").transfer ==
          Display::Transfer::rec2020);
    CHECK(parseDisplay(primaries + "white 0.3127 0.3290\n", "f").transfer == Display::Transfer::srgb);
}

TEST_CASE("What is wrong with a display's file is said with its place") {
    CHECK(errorOf(primaries) == "screen.txt: a display needs a line 'white x y' (chromaticity)");
    CHECK(errorOf("red 0.64 0.33\n  grene 0.3 0.6\n") ==
          "screen.txt:2:3: unknown setting 'grene' of a display (allowed: red, green, blue, white, gamma, "
          "transfer) (did you "
          "mean 'green'?)");
    CHECK(errorOf("red 0.64 O.33\n") == "screen.txt:1:10: 'O.33' is no chromaticity y (allowed: -1 to 2)");
    CHECK(errorOf("red 0.64\n") == "screen.txt:1:1: 'red' needs two numbers, the chromaticity x y");
    CHECK(errorOf("red nan 0.3\n") == "screen.txt:1:5: 'nan' is no chromaticity x (allowed: -1 to 2)");
    CHECK(errorOf(primaries + "red 0.6 0.3") == "screen.txt:4:1: 'red' is given twice");
    CHECK(errorOf("gamma 0") == "screen.txt:1:7: '0' is no gamma (allowed: 0.1 to 10)");
    CHECK(errorOf("gamma 2.2\ntransfer srgb") ==
          "screen.txt:2:1: a display has one 'gamma' or 'transfer'; the first is in line 1");
    CHECK(errorOf("transfer pq") == "screen.txt:1:10: unknown transfer 'pq' (allowed: srgb, rec2020)");
    CHECK(errorOf("white 0.3 0") == "screen.txt:1:11: white needs a chromaticity y above 0");
    CHECK(errorOf("red 0.2 0.2\ngreen 0.3 0.3\nblue 0.4 0.4\nwhite 0.3 0.3") ==
          "screen.txt: the primaries of a display must span a triangle of chromaticities");
    CHECK(errorOf(primaries + "white 0.7 0.3") ==
          "screen.txt: the white of a display must lie inside the triangle of its primaries");
}

TEST_CASE("An unknown display is a wrong use of the command, with the names there are") {
    CHECK(displayFor("p3").name == "p3");
    CHECK(displayFor("rec2020").gamma == 2.4);
    CHECK_THROWS_AS((void)displayFor("adobe"), UsageError);
    CHECK_THROWS_WITH((void)displayFor("rec2O20"), Catch::Contains("did you mean 'rec2020'"));
}
