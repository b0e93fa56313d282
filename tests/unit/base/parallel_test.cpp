#include "base/parallel.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <stdexcept>
#include <vector>

using namespace spectrad;

TEST_CASE("every part is worked on once, however many there are") {
    for (size_t count : {0, 1, 2, 1000}) {
        std::vector<int> times(count, 0);
        inParallel(count, [&](size_t i) { ++times[i]; });
        CHECK(times == std::vector<int>(count, 1));
    }
}

TEST_CASE("an exception of a part reaches the caller, and what is left is left out") {
    std::atomic<size_t> begun{0};
    CHECK_THROWS_WITH(inParallel(100000,
                                 [&](size_t i) {
                                     ++begun;
                                     if (i == 3) throw std::runtime_error("part 3");
                                 }),
                      "part 3");
    CHECK(begun < 100000);
}
