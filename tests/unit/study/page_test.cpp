// The page of a study: whole in itself.
#include "study/page.h"

#include "study/plot.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace spectrad;

TEST_CASE("base64 as RFC 4648 has it") {
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64("\xff\xfe\x00"[0] == '\xff' ? std::string_view("\xff\xfe\x01", 3) : "") == "//4B");
}

TEST_CASE("a plot draws every point once, within its frame, zero at the edge of a logarithmic axis") {
    Plot plot{"a < b", "x", "y", true, true, {{"s", {{1, 10, "one"}, {100, 0, "two & more"}}, true}}};
    const std::string svg = svgOf(plot);
    size_t circles = 0;
    for (size_t at = svg.find("<title>"); at != std::string::npos; at = svg.find("<title>", at + 1))
        ++circles;
    CHECK(circles == 2);
    CHECK(svg.find("a &lt; b") != std::string::npos);
    CHECK(svg.find("two &amp; more") != std::string::npos);
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("inf") == std::string::npos);
    CHECK(svgOf({}).empty());
}

TEST_CASE("names beside points stand where there is room, never on each other") {
    const auto placesOf = [](size_t count) {
        Plot plot{"", "x", "y", false, false, {{"s", {{0, 0, ""}, {2, 2, ""}}, false}}};
        for (size_t i = 0; i < count; ++i)
            plot.series[0].points.push_back({1, 1, "", "name" + std::to_string(i)});
        const std::string svg = svgOf(plot);
        std::vector<std::string> places;
        for (size_t at = svg.find(">name"); at != std::string::npos; at = svg.find(">name", at + 1)) {
            const size_t begin = svg.rfind("<text", at);
            places.push_back(svg.substr(begin, at - begin));
        }
        return places;
    };
    CHECK(placesOf(1).size() == 1);
    CHECK(placesOf(2).size() == 2);
    std::vector<std::string> crowd = placesOf(40);
    CHECK((crowd.size() >= 4 && crowd.size() <= 8));
    std::sort(crowd.begin(), crowd.end());
    CHECK(std::adjacent_find(crowd.begin(), crowd.end()) == crowd.end());
}

TEST_CASE("the page asks nobody for anything and tells each row and what was left out") {
    StudyReport report;
    StudyRow row;
    row.light = "scene";
    row.observer = "cie1931-2";
    row.key = "slit-10nm";
    row.knob = "bands";
    row.what = "41 bands, slit every 10 nm";
    row.bands = 41;
    row.renderSeconds = 0.01;
    row.deltaP99 = 0.02;
    report.rows = {row};
    report.leftOut = {"scene/cie1931-2/rgb: beyond the budget"};
    const std::string page = pageOf({"<chart>.xml", "a device", "4 × 4 pixels", "spectrad study"}, report,
                                    {{"scene/cie1931-2/slit-10nm", "\x89PNG"}});
    for (const char* reach : {"http:", "https:", "src=\"/", "<script", "<link", "@import", "url("})
        CHECK(page.find(reach) == std::string::npos);
    // Nor could it, where a browser keeps the policy that it states before anything else.
    const size_t policy = page.find("default-src 'none'; img-src data:; style-src 'unsafe-inline'");
    CHECK(policy < page.find("<title>"));
    CHECK(page.find("&lt;chart&gt;.xml") != std::string::npos);
    CHECK(page.find("41 bands, slit every 10 nm") != std::string::npos);
    CHECK(page.find("data:image/png;base64,iVBORw==") != std::string::npos);
    CHECK(page.find("beyond the budget") != std::string::npos);
}
