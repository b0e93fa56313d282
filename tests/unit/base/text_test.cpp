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

TEST_CASE("Only letters of ASCII are lowered") {
    CHECK(lowerCase("AZ az-[@`{ \xc3\x84") == "az az-[@`{ \xc3\x84");
}

TEST_CASE("UTF-8 is what RFC 3629 says: no overlong forms, no surrogates, nothing beyond U+10FFFF") {
    CHECK(utf8Length("a", 0) == 1);
    CHECK(utf8Length("xµ", 1) == 2);
    CHECK(utf8Length("…", 0) == 3);
    CHECK(utf8Length("\xf4\x8f\xbf\xbf", 0) == 4);
    for (const char* wrong : {"\x80", "\xc0\x80", "\xc3", "\xc3(", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xe2\x80",
                              "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xff"}) {
        CAPTURE(wrong);
        CHECK(utf8Length(wrong, 0) == 0);
    }
}

TEST_CASE("A number is the whole text, decimal and finite") {
    CHECK(parseDouble("0.18") == 0.18);
    CHECK(parseDouble(" +1e-3 ") == 1e-3);
    CHECK(parseDouble("-.5") == -0.5);
    CHECK(parseDouble("1e308") == 1e308);
    for (const char* text : {"", " ", "+", "1,5", "1.5x", "0x10", "nan", "inf", "-inf", "1 2", "--1", "++1",
                             "+-1", "-+1", "1e", "e5"})
        CHECK_FALSE(parseDouble(text));
    CHECK(parseInteger(" 42 ") == 42);
    CHECK(parseInteger("-3") == -3);
    for (const char* text : {"", "4.0", "4x", "99999999999999999999"})
        CHECK_FALSE(parseInteger(text));
}

TEST_CASE("A number too small for double is 0, one too large is none, however they are written") {
    const std::string zeros(400, '0');
    for (const std::string& text : {std::string("1e-400"), std::string("-1E-400"), std::string("+2.5E-0400"),
                                    std::string("1e-99999999999999999999"), "0." + zeros + "1",
                                    "." + zeros + "1e+20", "1" + zeros + "e-1000"})
        CHECK(parseDouble(text) == 0.0);
    for (const std::string& text :
         {std::string("1e400"), std::string("-1E+400"), std::string("0.1E999"),
          std::string("1e99999999999999999999"), "1" + zeros, "1" + zeros + "e-20", "." + zeros + "1e2000"})
        CHECK_FALSE(parseDouble(text));
    CHECK(parseDouble("1" + zeros + "e-400") == 1.0);
    CHECK(parseDouble("0e400") == 0.0);
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
