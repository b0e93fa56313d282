#include "image/curves.h"

#include <catch2/catch.hpp>

using namespace spectrad;

TEST_CASE("curves are read with and without the last semicolon, sorted, in any unit") {
    for (const char* text : {"400nm:0.92;410nm:0.93;", "400nm:0.92;410nm:0.93", "410nm:0.93;400nm:0.92;",
                             "400nm:0.92;410nm:0.93;410nm:0.93", "0.4um:92E-2;4.1E2nm:0.93;"}) {
        INFO(text);
        const auto samples = parseCurveAttribute(text, {});
        REQUIRE(samples.size() == 2);
        CHECK(samples[0].nm == 400);
        CHECK(samples[0].value == 0.92);
        CHECK(samples[1].nm == 410);
        CHECK(samples[1].value == 0.93);
    }
}

TEST_CASE("a curve that other readers would mangle without a word is an error") {
    for (const char* text : {"", ";", "400nm", "400nm:", "400nm:-1;", "400:1;", "400nm:0,5;", "-400nm:1",
                             "400nm:nan", "400nm:1;400nm:2", "nm:1", "0nm:1"})
        CHECK_THROWS_AS(parseCurveAttribute(text, {"a.exr"}), InputError);
}

TEST_CASE("written curves read back, and repeat the last sample where others drop it") {
    const std::vector<CurveSample> samples{{400, 0.1}, {405.25, 1e-9}};
    CHECK(curveAttribute(samples) == "400nm:0.1;405.25nm:1e-09;405.25nm:1e-09");
    const auto back = parseCurveAttribute(curveAttribute(samples), {});
    REQUIRE(back.size() == 2);
    CHECK(back[1].nm == 405.25);
    CHECK(back[1].value == 1e-9);
}
