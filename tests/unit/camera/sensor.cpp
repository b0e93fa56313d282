// A camera's signal chain: noise against its model, seeds, mosaics, the matrix of a chart.
#include "camera/sensor.h"

#include "camera/colour_fit.h"
#include "camera/mosaic.h"
#include "camera/random.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spectrad;
using Catch::Contains;

namespace {

ChannelImage flat(int side, double value) {
    ChannelImage image(side, side, 1);
    std::fill(image.plane[0].begin(), image.plane[0].end(), value);
    return image;
}

NoiseModel measured(const ChannelImage& image) {
    double sum = 0, squares = 0;
    for (const double v : image.plane[0])
        sum += v;
    const auto n = static_cast<double>(image.pixels());
    for (const double v : image.plane[0])
        squares += (v - sum / n) * (v - sum / n);
    return {sum / n, squares / (n - 1)};
}

}  // namespace

TEST_CASE("Philox gives the numbers that its authors published") {
    using Four = std::array<std::uint32_t, 4>;
    CHECK(philox({0, 0, 0, 0}, {0, 0}) == Four{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    CHECK(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
          Four{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
          Four{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("Mean and variance of raw counts are the model's, in the dark, at few photons and at many") {
    Sensor sensor;
    sensor.electronsPerSignal = 2;
    sensor.seconds = 0.5;
    sensor.readNoise = 4;
    sensor.darkCurrent = 6;
    sensor.fullWell = 20'000;
    sensor.bits = 14;
    sensor.black = 512;
    constexpr int side = 256;
    const double n = side * side;
    for (const double signal : {0.0, 3.0, 20.0, 60.0, 4000.0}) {
        const NoiseModel model = noiseOf(signal, sensor),
                         found = measured(expose(flat(side, signal), sensor).values);
        INFO("signal " << signal << ": mean " << found.mean << ", variance " << found.variance);
        CHECK(std::abs(found.mean - model.mean) < 5 * std::sqrt(model.variance / n));
        // The variance of a variance, with room for the kurtosis of few photons.
        CHECK(std::abs(found.variance / model.variance - 1) < 5 * std::sqrt(2.5 / n));
    }
}

TEST_CASE("Without noise, well and bits the chain is its gain; each stage is left out alone") {
    Sensor sensor;
    sensor.electronsPerSignal = 3;
    sensor.shotNoise = false;
    CHECK(expose(flat(2, 7), sensor).values.plane[0][3] == 21);
    sensor.fullWell = 10;
    CHECK(expose(flat(2, 7), sensor).values.plane[0][3] == 10);
    sensor.bits = 8;
    CHECK(expose(flat(2, 1), sensor).values.plane[0][3] == std::round(3 * 255 / 10.0));
    sensor.black = 15;
    CHECK(expose(flat(2, 0), sensor).values.plane[0][3] == 15);
    CHECK(electronsOf(expose(flat(2, 7), sensor).values, sensor).plane[0][0] == Approx(10));
    sensor.fullWell.reset();
    CHECK_THROWS_WITH(expose(flat(2, 1), sensor), Contains("full well"));
}

TEST_CASE("The same seed gives the same noise whatever the rest of the image; another gives another") {
    Sensor sensor;
    const ChannelImage small = expose(flat(8, 30), sensor).values;
    ChannelImage mixed = flat(8, 500);
    mixed.plane[0][27] = 30;
    CHECK(expose(mixed, sensor).values.plane[0][27] == small.plane[0][27]);
    CHECK(expose(flat(8, 30), sensor).values.plane[0] == small.plane[0]);
    sensor.seed = 2;
    CHECK(expose(flat(8, 30), sensor).values.plane[0] != small.plane[0]);
}

TEST_CASE("Electrons of a lens: a quarter of pi over the square of the f-number, times area and time") {
    const Shutter shutter{2, 0.25, 10};
    CHECK(shutter.electronsPerSignal() == Approx(std::numbers::pi / 16 * 1e-10 * 0.25).epsilon(1e-12));
}

TEST_CASE("A mosaic keeps one channel a pixel, and filling in is exact for linear channels") {
    const Mosaic mosaic("RGGB", {"R", "G", "B"});
    ChannelImage full(12, 10, 3);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 12; ++x)
            for (size_t c = 0; c < 3; ++c)
                full.plane[c][static_cast<size_t>(y * 12 + x)] = 5 + static_cast<double>(c + 1) * x - 2.0 * y;
    const ChannelImage raw = sampled(full, mosaic);
    CHECK(raw.plane.size() == 1);
    CHECK(raw.plane[0][0] == full.plane[0][0]);
    CHECK(raw.plane[0][1] == full.plane[1][1]);
    CHECK(raw.plane[0][13] == full.plane[2][13]);
    const ChannelImage back = demosaiced(raw, mosaic);
    for (int y = 1; y < 9; ++y)
        for (int x = 1; x < 11; ++x)
            for (size_t c = 0; c < 3; ++c) {
                const auto i = static_cast<size_t>(y * 12 + x);
                CHECK(back.plane[c][i] == Approx(full.plane[c][i]).epsilon(1e-12));
            }
    CHECK_THROWS_WITH(Mosaic("RGB", {"R", "G", "B"}), Contains("no square"));
    CHECK_THROWS_WITH(Mosaic("RGGX", {"R", "G", "B"}), Contains("'X'"));
    CHECK_THROWS_WITH(Mosaic("RGGR", {"R", "G", "B"}), Contains("lacks"));
}

TEST_CASE("The matrix of a chart is exact for a camera that is a mixture of the observer") {
    const Library library = Library::open();
    const Detector eye = standardObserver(library);
    // R, G, B as sums of the matching functions: such a camera fulfils the Luther condition.
    Detector camera = eye;
    camera.tristimulus = false;
    camera.scale = 1;
    camera.channels = {"R", "G", "B"};
    const auto mixed = [&](double x, double y, double z) {
        return Curve::combined({eye.response[0], eye.response[1], eye.response[2]},
                               [=](std::span<const double> v) { return x * v[0] + y * v[1] + z * v[2]; });
    };
    camera.response = {mixed(1, 0.4, 0), mixed(0.2, 1, 0.1), mixed(0, 0.1, 0.9)};
    const Curve light = library.find("illuminants/D65")->curve();
    std::vector<Curve> chart;
    const Spectrum checker = library.find("charts/colorchecker").value();
    for (const Curve& patch : checker.curves)
        chart.push_back(patch.withOutside(Outside::hold));
    const XyzMatrix matrix = fittedMatrix(camera, eye, light, chart);
    const auto seen = [&](const Detector& detector, const Curve& patch) {
        const std::array<const Curve*, 2> product{&light, &patch};
        return respond(detector, product);
    };
    const std::vector<double> white = seen(camera, Curve::constant(1)),
                              whiteXyz = seen(eye, Curve::constant(1));
    for (const Curve& patch : chart) {
        std::vector<double> channels = seen(camera, patch);
        for (size_t c = 0; c < 3; ++c)
            channels[c] /= white[c];
        const Triple fitted = toXyz(matrix, channels);
        const std::vector<double> xyz = seen(eye, patch);
        for (size_t k = 0; k < 3; ++k)
            CHECK(fitted[k] == Approx(xyz[k] / whiteXyz[1]).epsilon(1e-8));
    }
    CHECK(whiteBalance({2, 4, 1}) == std::vector<double>{2, 1, 4});
    CHECK_THROWS_AS(whiteBalance({1, 0, 1}), InputError);
    CHECK_THROWS_WITH(fittedMatrix(camera, eye, light, {chart[0]}), Contains("too small"));
}
