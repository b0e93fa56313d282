// The kernels on every device against their scalar twins, bit for bit.
#include "kernels/random_world.h"
#include "kernels/read_back.h"
#include "kernels/twin.h"
#include "render/live.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <random>

using namespace spectrad;

namespace {

size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
    REQUIRE(a.size() == b.size());
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i)
        count += std::memcmp(&a[i], &b[i], sizeof(float)) != 0;
    return count;
}

/// Everything the device computes for a plan, against the twins.
void compare(const Device& device, const Plan& plan) {
    const int vectorWidth = device.body().vectorWidth();
    const LanePattern lanes = lanePattern(plan.samples, vectorWidth);
    Stages stages(device, plan, lanes);
    stages.transform();
    const int height = plan.view.height;
    REQUIRE(stages.light(0, height));
    const sd_frame frame = twin::frameOf(plan);
    REQUIRE(stages.pitch() == frame.pitch);

    const twin::Vertices vertices = twin::transform(plan.world, frame);
    const std::vector<std::uint64_t> expected = twin::cover(plan.world, vertices, frame, lanes);
    std::vector<std::uint64_t> keys = read<std::uint64_t>(device, stages.keys().buffer(), expected.size());
    size_t wrongKeys = 0, covered = 0;
    for (int row = 0; row < height; ++row) {
        for (int x = 0; x < frame.width; ++x) {
            for (size_t slot = 0; slot < lanes.slotX.size(); ++slot) {
                const size_t i =
                    (static_cast<size_t>(row) * static_cast<size_t>(frame.pitch) + static_cast<size_t>(x)) *
                        lanes.slotX.size() +
                    slot;
                wrongKeys += keys[i] != expected[i];
                covered += expected[i] != ~std::uint64_t{0};
            }
        }
    }
    INFO("covered samples: " << covered);
    CHECK(wrongKeys == 0);

    const size_t bands = plan.terms.bands;
    DeviceArray<float> cube, preview;
    stages.expand(0, height, cube, preview);
    const auto pitch = static_cast<size_t>(frame.pitch);
    const std::vector<float> rows =
        read<float>(device, cube.buffer(), static_cast<size_t>(height) * bands * pitch);
    const ShownThrough through = shownThrough(diagonal({1e-3, 1e-3, 1e-3}), p3Display());
    DeviceArray<std::uint32_t> shown;
    stages.show(plan.terms.preview, through, shown);
    const auto codes = read<std::uint32_t>(device, shown.buffer(), static_cast<size_t>(height) * pitch);
    const int blocksX = frame.pitch / SD_BLOCK;
    const auto first = read<std::uint32_t>(device, stages.terms().first.buffer(), stages.terms().blocks + 1);
    const auto term = read<std::uint32_t>(device, stages.terms().term.buffer(), first.back());
    const auto g = read<float>(device, stages.terms().g.buffer(), size_t{first.back()} * SD_BLOCK);
    size_t wrongTerms = 0, wrongG = 0, wrongBands = 0, wrongCodes = 0;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < blocksX; ++column) {
            const size_t number = static_cast<size_t>(row * blocksX + column);
            const twin::Block block =
                twin::light<float>(plan, vertices, frame, lanes, keys, row, column, vectorWidth);
            const std::vector<std::uint32_t> ours(term.begin() + first[number],
                                                  term.begin() + first[number + 1]);
            wrongTerms += ours != block.term;
            if (ours != block.term) continue;
            const auto from = g.begin() + static_cast<std::ptrdiff_t>(size_t{first[number]} * SD_BLOCK);
            wrongG += differences({from, from + static_cast<std::ptrdiff_t>(block.g.size())}, block.g);
            const auto code =
                codes.begin() + static_cast<std::ptrdiff_t>(static_cast<size_t>(row) * pitch +
                                                            static_cast<size_t>(column) * SD_BLOCK);
            wrongCodes +=
                !std::equal(code, code + SD_BLOCK, twin::show(block, plan.terms.preview, through).begin());
            const std::vector<float> out = twin::expand(block, plan.terms.spectra, bands);
            for (size_t band = 0; band < bands; ++band)
                wrongBands += std::memcmp(rows.data() + (static_cast<size_t>(row) * bands + band) * pitch +
                                              static_cast<size_t>(column) * SD_BLOCK,
                                          out.data() + band * SD_BLOCK, SD_BLOCK * sizeof(float)) != 0;
        }
    }
    CHECK(wrongTerms == 0);
    CHECK(wrongG == 0);
    CHECK(wrongBands == 0);
    CHECK(wrongCodes == 0);
}

}  // namespace

TEST_CASE("kernels agree with their scalar twins bit for bit, on every device") {
    for (const DeviceInfo& info : listDevices()) {
        const Device device = Device::open(info.number);
        for (int samples : {1, 2, 3, 4, 8, 16, 25, 64}) {
            for (bool orthographic : {false, true}) {
                CAPTURE(info.name, samples, orthographic);
                compare(device, randomPlan(static_cast<unsigned>(samples), samples, orthographic, 150, 24));
            }
        }
    }
}

TEST_CASE("kernels that bake, into the square of texture coordinates, agree with their twins") {
    for (const DeviceInfo& info : listDevices()) {
        const Device device = Device::open(info.number);
        for (bool orthographic : {false, true}) {
            CAPTURE(info.name, orthographic);
            Plan plan = randomPlan(5, 4, orthographic, 100, 24);
            plan.view.baked = true;
            plan.defines.emplace_back("BAKE");
            compare(device, plan);
        }
    }
}

TEST_CASE("kernels agree with their twins on adversarial triangles") {
    const Device device = Device::open(std::nullopt);
    for (unsigned seed = 1; seed <= 6; ++seed) {
        CAPTURE(seed);
        compare(device, adversarialPlan(seed, seed % 2 == 0));
    }
}

TEST_CASE("kernels agree with their twins where the first triangle fills whole blocks") {
    const Device device = Device::open(std::nullopt);
    compare(device, wallPlan(4));
}

TEST_CASE("two runs give the same bytes") {
    const Device device = Device::open(std::nullopt);
    const Plan plan = randomPlan(7, 16, false, 200, 40);
    std::vector<std::vector<float>> results;
    for (int run = 0; run < 2; ++run) {
        Stages stages(device, plan, lanePattern(plan.samples, device.body().vectorWidth()));
        stages.transform();
        REQUIRE(stages.light(0, plan.view.height));
        DeviceArray<float> cube, preview;
        stages.expand(0, plan.view.height, cube, preview);
        results.push_back(read<float>(
            device, cube.buffer(),
            static_cast<size_t>(plan.view.height) * plan.terms.bands * static_cast<size_t>(stages.pitch())));
    }
    CHECK(differences(results[0], results[1]) == 0);
}

TEST_CASE("structs have the same layout on host and device") {
    const Device device = Device::open(std::nullopt);
    const Program program(device, {"layout_probe.cl"}, {}, "");
    Kernel probe = program.kernel("layout_probe");
    DeviceArray<std::uint32_t> out;
    out.reserve(device, 16, "the probe");
    probe.set("out", out.buffer()).run(1);
    const auto sizes = read<std::uint32_t>(device, out.buffer(), 14);
    const std::vector<std::uint32_t> expected{sizeof(sd_frame),          offsetof(sd_frame, tiles_y),
                                              sizeof(sd_draw),           offsetof(sd_draw, normal),
                                              sizeof(sd_vertex),         sizeof(sd_large),
                                              offsetof(sd_large, key),   sizeof(sd_light),
                                              offsetof(sd_light, group), sizeof(sd_lobe),
                                              sizeof(sd_piece),          sizeof(sd_material),
                                              sizeof(sd_texture),        offsetof(sd_texture, place)};
    CHECK(sizes == expected);
}

// The least that passes through every stage, in the form for CPUs (vectors) and for GPUs (work-groups),
// whatever the device: what a simulator that checks each access can do in a minute (tests/oclgrind).
TEST_CASE("a tiny image agrees with the scalar twins in both forms of the kernels", "[oclgrind]") {
    for (const char* type : {"cpu", "gpu"}) {
        const Device device = Device::open(std::nullopt);
        device.body().info.type = type;
        CAPTURE(type);
        compare(device, randomPlan(4, 4, false, 6, 4));
        compare(device, adversarialPlan(3, true));
    }
}
