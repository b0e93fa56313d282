// The tree of boxes around what throws shadows, against every triangle asked one by one.
#include "kernels/random_world.h"
#include "render/casters.h"
#include "verify/scalar_shadow.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace spectrad;

namespace {

sd_light lamp(int type, std::array<float, 3> place) {
    sd_light light{};
    light.type = type;
    light.shadows = 1;
    light.x = place[0], light.y = place[1], light.z = place[2];
    return light;
}

struct Count {
    int hidden = 0, free = 0, different = 0;
};

/// Rays from everywhere to lamps near and far, along axes too, from and towards corners.
template <typename Real>
Count ask(const Plan& plan, unsigned seed, double reach) {
    const auto vertices = scalar::transform<float>(plan.world, scalar::frameOf(plan));
    const scalar::OccludersOf<Real> occluders(plan.world, vertices);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto place = [&](int kind) {
        std::array<float, 3> p{};
        for (size_t axis = 0; axis < 3; ++axis)
            p[axis] = uniform(random) * static_cast<float>(reach);
        if (kind % 3 == 0) p[static_cast<size_t>(kind / 3 % 3)] = 0;
        if (kind % 3 == 1) {
            const size_t v = random() % (vertices.camera.size() / 3);
            std::copy_n(vertices.camera.data() + 3 * v, 3, p.data());
        }
        return p;
    };
    Count count;
    for (int i = 0; i < 3000; ++i) {
        const auto from = place(i), to = place(i / 9);
        sd_light light = lamp(i % 2 ? SD_LIGHT_POINT : SD_LIGHT_DIRECTIONAL, to);
        if (i % 7 == 0) light.x = from[0], light.y = from[1];
        const scalar::VectorOf<Real> start{from[0], from[1], from[2]};
        const bool hidden = occluders.hides(light, start);
        (hidden ? count.hidden : count.free)++;
        count.different += hidden != occluders.hidesByAll(light, start);
    }
    return count;
}

}  // namespace

TEST_CASE("the tree of boxes answers as if every triangle were asked") {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Plan ordinary = randomPlan(seed, 4, false, 60 * static_cast<int>(seed), 24);
        for (const Count& count : {ask<float>(ordinary, seed, 5), ask<double>(ordinary, seed, 5)}) {
            CHECK(count.different == 0);
            CHECK(count.hidden > 100);
            CHECK(count.free > 100);
        }
        const Plan adversarial = adversarialPlan(seed, false);
        for (const double reach : {1e-6, 1.0, 1e6}) {
            CHECK(ask<float>(adversarial, seed, reach).different == 0);
            CHECK(ask<double>(adversarial, seed, reach).different == 0);
        }
    }
}

TEST_CASE("leaves hold at most four triangles, and every triangle once") {
    for (const int triangles : {1, 2, 4, 5, 16, 17, 500}) {
        Plan plan = randomPlan(3, 1, false, triangles, 8);
        plan.world.casters.clear();
        for (std::uint32_t t = 0; t < static_cast<std::uint32_t>(triangles); ++t)
            plan.world.casters.push_back(t);
        orderCasters(plan.world);
        const size_t leaves = leavesOf(plan.world.casters.size()), count = plan.world.casters.size();
        CHECK((leaves & (leaves - 1)) == 0);
        for (size_t leaf = 0; leaf < leaves; ++leaf) {
            const size_t held = (leaf + 1) * count / leaves - leaf * count / leaves;
            CHECK(held >= 1);
            CHECK(held <= SD_LEAF_CASTERS);
        }
        std::vector<std::uint32_t> sorted = plan.world.casters;
        std::sort(sorted.begin(), sorted.end());
        for (std::uint32_t t = 0; t < sorted.size(); ++t)
            CHECK(sorted[t] == t);
    }
    CHECK(leavesOf(0) == 0);
}
