#include "verify/tolerance.h"

#include <catch2/catch.hpp>

using namespace spectrad;

TEST_CASE("tolerances are read as they are written") {
    CHECK(parseTolerance("0.5").bound == 0.5);
    CHECK_FALSE(parseTolerance("0.5").all);
    CHECK(parseTolerance("max:0.5").all);
    CHECK(parseTolerance("1%rad").radiance);
    CHECK(parseTolerance("1%rad").bound == Approx(0.01));
    CHECK(parseTolerance("max:0.2%rad").all);
    for (const char* wrong : {"", "0", "-1", "max:", "1%", "rad", "1%radiance", "nan"})
        CHECK_THROWS_AS(parseTolerance(wrong), UsageError);
}

TEST_CASE("a tolerance is said in the digits that it was asked for in") {
    CHECK(parseTolerance("max:0.0001%rad").words() == "band error of all pixels within 0.0001 %");
    CHECK(parseTolerance("0.7%rad").words() == "band error of 99 % of the pixels within 0.7 %");
}

TEST_CASE("a certificate proves, leaves open or refutes") {
    Certificate c;
    c.pixels = 1000;
    c.population = 100000;
    c.colour.p99 = {0.4, 0.3, 0.5};
    c.colour.largest = 0.9;
    CHECK(judged(c, parseTolerance("0.6")) == Verdict::proven);
    CHECK(judged(c, parseTolerance("0.4")) == Verdict::open);
    CHECK(judged(c, parseTolerance("0.2")) == Verdict::refuted);
    CHECK(judged(c, parseTolerance("max:1")) == Verdict::open);
    CHECK(judged(c, parseTolerance("max:0.8")) == Verdict::refuted);
    c.pixels = c.population;
    CHECK(judged(c, parseTolerance("max:1")) == Verdict::proven);
}
