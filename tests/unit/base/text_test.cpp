// Numbers and words whatever the locale.
#include "base/text.h"

#include <catch2/catch.hpp>
#include <clocale>

#include <cmath>
#include <limits>

using namespace spectrad;

TEST_CASE("Text is trimmed and cut into pieces and words") {
    CHECK(trimmed(" \t a b\r\n") == "a b");
    CHECK(trimmed(" \n").empty());
    CHECK(split("a, b,,c ", ',') == std::vector<std::string_view>{"a", "b", "", "c"});
    CHECK(split("", ',') == std::vector<std::string_view>{""});
    CHECK(words("  a\tb \n c") == std::vector<std::string_view>{"a", "b", "c"});
    CHECK(words(" \t").empty());
    CHECK(startsWith("blackbody:2856", "blackbody:"));
    CHECK_FALSE(startsWith("bl", "blackbody:"));
}

TEST_CASE("A number is the whole text, decimal and finite") {
    CHECK(parseDouble("0.18") == 0.18);
    CHECK(parseDouble(" +1e-3 ") == 1e-3);
    CHECK(parseDouble("-.5") == -0.5);
    CHECK(parseDouble("1e308") == 1e308);
    CHECK(parseDouble("1e-400") == 0.0);
    for (const char* text :
         {"", " ", "+", "1,5", "1.5x", "0x10", "nan", "inf", "-inf", "1e400", "1 2", "--1"})
        CHECK_FALSE(parseDouble(text));
    CHECK(parseInteger(" 42 ") == 42);
    CHECK(parseInteger("-3") == -3);
    for (const char* text : {"", "4.0", "4x", "99999999999999999999"})
        CHECK_FALSE(parseInteger(text));
}

TEST_CASE("Numbers are read and written alike in a locale with decimal commas") {
    // Only where the machine has such a locale does this try more than the C locale.
    const std::string before = std::setlocale(LC_ALL, nullptr);
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    CHECK(parseDouble("2.5") == 2.5);
    CHECK(shortest(2.5) == "2.5");
    CHECK(rounded(2.5, 3) == "2.5");
    std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("The shortest text reads back as the same double") {
    for (double value : {0.1, 1.0 / 3, 405.2, 1e-30, 6.02214076e23, -0.0,
                         std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()})
        CHECK(parseDouble(shortest(value)) == value);
    CHECK(shortest(400) == "400");
    CHECK(rounded(1234.5678, 3) == "1.23e+03");
}

TEST_CASE("A misspelt name finds its neighbour, a foreign one none") {
    const std::vector<std::string> known{"slit", "box", "point", "illuminants/D65"};
    CHECK(nearest("slti", known) == "slit");
    CHECK(nearest("slits", known) == "slit");
    CHECK(nearest("iluminants/D65", known) == "illuminants/D65");
    CHECK_FALSE(nearest("gaussian", known));
    CHECK_FALSE(nearest(std::string(1000, 'x'), known));
    CHECK(didYouMean("pointt", known) == " (did you mean 'point'?)");
    CHECK(didYouMean("zzzzzz", known).empty());
}
