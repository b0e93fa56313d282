#include "image/channel_names.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace spectrad;

namespace {

double nmOf(const std::string& name) {
    const auto channel = parseChannelName(name);
    REQUIRE(channel);
    return channel->nm;
}

CubeInfo infoOf(std::vector<double> nm) {
    CubeInfo info;
    info.wavelengths.nm = std::move(nm);
    return info;
}

}  // namespace

TEST_CASE("every spelling of 500 nm that other programs write is 500 nm") {
    for (const char* name : {"S0.500,000000nm", "S0.500,0nm", "S0.500nm", "S0.0500,000nm", "S0.5,00E+02nm",
                             "S0.0,50000um", "S0.599,584916THz", "S0.5e-7m", "S0.5,000000e-1um", "S0.,5um",
                             "S0.500,nm", "S0.599584,916GHz", "S0.500000pm"}) {
        INFO(name);
        CHECK(nmOf(name) == Approx(500).epsilon(1e-15));
    }
    CHECK(nmOf("S0.50e3pm") == 50);
    CHECK(nmOf("S0.0,50000um") == 500);  // not 500.00000000000006
    CHECK(nmOf("T.5dam") == 5e10);
    CHECK(nmOf("T.5dm") == 5e8);
    CHECK(nmOf("T.5Em") == 5e27);  // exa, not an exponent
    CHECK(nmOf("T.5E3m") == 5e12);
}

TEST_CASE("a name that does not match the grammar from end to end is no spectral channel") {
    for (const char* name : {"s0.500nm",
                             "S4.500nm",
                             "S0.500,NM",
                             "S0.500.0nm",
                             "S0.-500nm",
                             "S0.500nm ",
                             " S0.500nm",
                             "S0.nm",
                             "S0.,nm",
                             "S0.e5nm",
                             "S0.500",
                             "S0.500n",
                             "S0.500xm",
                             "S0.5 nm",
                             "S0.",
                             "S0",
                             "S",
                             "",
                             "T.",
                             "T",
                             "T.nm",
                             "T.400nm.",
                             "T..400nm",
                             "T.400nm.500nm.600nm",
                             "R",
                             "Y",
                             "Z",
                             "S0.500,0,0nm",
                             "S0.+500nm",
                             "left.S0.500nm",
                             "S0.500nm.600nm",
                             "T500nm"})
        CHECK_FALSE(parseChannelName(name));
}

TEST_CASE("Stokes components, reflectance and reradiation are told apart") {
    CHECK(parseChannelName("S2.500nm")->stokes == 2);
    CHECK(parseChannelName("S0.500nm")->kind == SpectralChannel::Kind::emissive);
    CHECK(parseChannelName("T.500nm")->kind == SpectralChannel::Kind::reflective);
    const auto reradiation = parseChannelName("T.400,0nm.0,55um");
    REQUIRE(reradiation);
    CHECK(reradiation->kind == SpectralChannel::Kind::reradiation);
    CHECK(reradiation->nm == 400);
    CHECK(reradiation->emittedNm == 550);
}

TEST_CASE("numbers beyond double neither crash nor pass for wavelengths") {
    CHECK(std::isinf(nmOf("S0.1e999999999999nm")));
    CHECK(nmOf("S0.1e-999999999999nm") == 0);
    CHECK(std::isinf(nmOf("S0.0THz")));
    CHECK(nmOf("S0." + std::string(5000, '9') + "E-4997nm") == Approx(1000));
}

TEST_CASE("below 1000 nm a band's name is byte for byte the reference library's") {
    CHECK(bandNames(infoOf({380, 385.5}).wavelengths, CubeKind::radiance) ==
          std::vector<std::string>{"S0.380,000000nm", "S0.385,500000nm"});
    CHECK(bandNames(infoOf({380}).wavelengths, CubeKind::reflectance) ==
          std::vector<std::string>{"T.380,000000nm"});
}

TEST_CASE("names are padded so that alphabetical order is ascending order") {
    for (const auto& nm :
         {std::vector<double>{90, 380, 900, 1000, 1100}, std::vector<double>{999.5, 999.9999999, 1000.5},
          std::vector<double>{500, 500.0000000001, 500.0000000002}}) {
        const auto names = bandNames(infoOf(nm).wavelengths, CubeKind::radiance);
        CHECK(std::is_sorted(names.begin(), names.end()));
        CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
        for (const std::string& name : names) {
            CHECK(name.size() == names[0].size());
            CHECK(name.size() <= 31);
            CHECK(parseChannelName(name));
        }
    }
    CHECK(bandNames(infoOf({900, 1000}).wavelengths, CubeKind::radiance)[0] == "S0.0900,000000nm");
}
