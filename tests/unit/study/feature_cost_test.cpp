#include "study/feature_cost.h"

#include <catch2/catch.hpp>

using namespace spectrad;

TEST_CASE("a time difference is the pairs' median, whatever disturbs both of a pair or one pair alone") {
    // The machine slows down steadily, and once another program gets in between.
    const std::vector<double> without{1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8};
    std::vector<double> with;
    for (size_t i = 0; i < without.size(); ++i)
        with.push_back(without[i] + 0.25 + (i % 2 ? 0.01 : -0.01));
    with[4] += 7;
    const TimeDifference d = timeDifference(with, without);
    CHECK(d.seconds == Approx(0.25).margin(0.011));
    CHECK(d.uncertainty < 0.05);
    CHECK(d.uncertainty > 0);
}

TEST_CASE("a difference within its uncertainty is none, and one beyond keeps its sign") {
    const std::vector<double> a{1.00, 1.03, 0.98, 1.01, 1.00, 0.97, 1.02, 0.99, 1.00},
        b{1.01, 1.00, 1.00, 0.99, 1.02, 1.00, 1.00, 1.00, 1.03};
    CHECK(timeDifference(a, b).seconds == 0);
    CHECK(timeDifference(a, b).uncertainty > 0);
    CHECK(timeDifference(b, {2, 2, 2, 2, 2, 2, 2, 2, 2}).seconds < -0.9);
}
