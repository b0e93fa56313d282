// Vectors and transforms in double precision.
#include "base/vec.h"

#include <catch2/catch.hpp>

using namespace spectrad;

namespace {

void checkNear(Vec3 a, Vec3 b, double tolerance = 1e-14) {
    CHECK(a.x == Approx(b.x).margin(tolerance));
    CHECK(a.y == Approx(b.y).margin(tolerance));
    CHECK(a.z == Approx(b.z).margin(tolerance));
}

}  // namespace

TEST_CASE("Lengths neither overflow nor underflow, and nothing has no direction") {
    CHECK(length({3e200, 4e200, 0}) == Approx(5e200));
    CHECK(length({3e-200, 4e-200, 0}) == Approx(5e-200));
    CHECK(normalized({0, 0, 0}) == Vec3{0, 0, 0});
    CHECK(length(normalized({1e-150, 2e-150, 3e-150})) == Approx(1));
    CHECK(cross({1, 0, 0}, {0, 1, 0}) == Vec3{0, 0, 1});
    CHECK(dot({1, 2, 3}, {4, 5, 6}) == 32);
}

TEST_CASE("Quarter turns are exact, and turning is right-handed") {
    CHECK(Affine::rotation({0, 0, 1}, 90).point({1, 0, 0}) == Vec3{0, 1, 0});
    CHECK(Affine::rotation({0, 0, 5}, -270).point({1, 0, 0}) == Vec3{0, 1, 0});
    CHECK(Affine::rotation({0, 1, 0}, 180).point({1, 2, 3}) == Vec3{-1, 2, -3});
    CHECK(Affine::rotation({1, 0, 0}, 720).point({1, 2, 3}) == Vec3{1, 2, 3});
    checkNear(Affine::rotation({1, 1, 1}, 120).point({1, 0, 0}), {0, 1, 0});
}

TEST_CASE("A product acts first with its right factor, and an inverse undoes it") {
    const Affine t = Affine::translation({1, 2, 3}), r = Affine::rotation({1, 2, -1}, 37),
                 s = Affine::scaling({2, 3, -0.5});
    const Affine m = t * r * s;
    checkNear(m.point({1, 1, 1}), t.point(r.point(s.point({1, 1, 1}))));
    checkNear((inverse(m) * m).point({7, -8, 9}), {7, -8, 9}, 1e-12);
    CHECK(m.determinant() == Approx(-3));
    checkNear(t.direction({4, 5, 6}), {4, 5, 6});
}

TEST_CASE("A camera looks down its -z at the target with +y near up") {
    const Affine view = Affine::lookAt({0, 1, 5}, {0, 1, 0}, {0, 1, 0});
    checkNear(view.direction({0, 0, -1}), {0, 0, -1});
    checkNear(view.direction({0, 1, 0}), {0, 1, 0});
    checkNear(view.point({0, 0, 0}), {0, 1, 5});
    // Straight down, where up is of no help: still a rigid frame.
    const Affine down = Affine::lookAt({0, 5, 0}, {0, 0, 0}, {0, 1, 0});
    checkNear(down.direction({0, 0, -1}), {0, -1, 0});
    CHECK(down.determinant() == Approx(1));
}

TEST_CASE("Finiteness of a transform is known") {
    CHECK(Affine{}.finite());
    CHECK_FALSE(Affine::translation({0, NAN, 0}).finite());
    CHECK_FALSE(Affine::scaling({0, INFINITY, 0}).finite());
}
