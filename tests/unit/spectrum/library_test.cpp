// The library of spectra: what ships is complete and sound, names stay inside the folder, damage is noticed.
#include "spectrum/library.h"

#include "base/files.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>
#include <unistd.h>

using namespace spectrad;
namespace fs = std::filesystem;

namespace {

Library shipped() {
    return Library(fs::path(SPECTRAD_SOURCE) / "spectra");
}

/// A folder of its own for each test, removed afterwards.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "spectrad-library-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~TemporaryFolder() { fs::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }
    void write(const std::string& file, const std::string& text) const {
        fs::create_directories((path_ / file).parent_path());
        writeFile(path_ / file, text);
    }

  private:
    fs::path path_;
};

const std::string goodHead =
    "# title: Two patches\n# quantity: reflectance\n# unit: 1\n# relative: no\n# range: 400-500 nm, 50 nm, 3 "
    "samples\n"
    "# source: nobody\n# licence: CC0-1.0\n";
const std::string goodRows = "wavelength_nm,a,b\n400,0.1,0.2\n450,0.3,0.4\n500,0.5,0.6\n";

std::string without(const std::string& head, const std::string& key) {
    const size_t from = head.find("# " + key + ":");
    return head.substr(0, from) + head.substr(head.find('\n', from) + 1);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

template <class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("every spectrum that ships is complete, ascending and within the range of its quantity") {
    const Library library = shipped();
    for (const LibraryEntry& entry : library.list()) {
        INFO(entry.name);
        CHECK(!entry.title.empty());
        CHECK(entry.quantity != Quantity::unknown);
        CHECK(entry.unit == "1");
        CHECK(!entry.source.empty());
        CHECK(!entry.licence.empty());
        const auto spectrum = library.find(entry.name);
        REQUIRE(spectrum);
        CHECK(spectrum->text == entry.name);
        CHECK(spectrum->channels == entry.channels);
        REQUIRE(spectrum->curves.size() == entry.channels.size());
        for (size_t c = 0; c < spectrum->curves.size(); ++c) {
            const auto nm = spectrum->curves[c].sampleWavelengths();
            CHECK(nm.size() == entry.samples);
            CHECK(nm.front() == entry.fromNm);
            CHECK(nm.back() == entry.toNm);
            CHECK(std::ranges::adjacent_find(nm, std::greater_equal<>()) == nm.end());
            const auto [low, high] = spectrum->curves[c].bounds();
            // An eye that lacks a kind of cone matches with negative amounts.
            const bool matching = entry.name == "observers/protanope" ||
                                  entry.name == "observers/deuteranope" ||
                                  entry.name == "observers/tritanope";
            CHECK((low >= 0 || matching));
            CHECK(high > 0);
            CHECK(high < 2000);
            switch (entry.quantity) {
                case Quantity::reflectance:
                case Quantity::transmittance:
                    CHECK(high <= 1);
                    break;
                case Quantity::reradiation:
                    CHECK(high == 1);
                    break;
                case Quantity::index:
                    CHECK((entry.channels[c] == "k" || low > 0));
                    break;
                default:
                    break;
            }
        }
    }
}

TEST_CASE("the names that the format promises exist") {
    const Library library = shipped();
    const auto channelsOf = [&](const std::string& name) {
        INFO(name);
        const auto spectrum = library.find(name);
        REQUIRE(spectrum);
        return spectrum->channels;
    };
    using Names = std::vector<std::string>;
    for (const char* name : {"cie1931-2", "cie1964-10", "cie2015-2", "cie2015-10"})
        CHECK(channelsOf(std::string("observers/") + name) == Names{"X", "Y", "Z"});
    for (const char* name : {"stockman-sharpe-2", "stockman-sharpe-10"})
        CHECK(channelsOf(std::string("observers/") + name) == Names{"L", "M", "S"});
    for (const char* name : {"nikon-5100", "sigma-sd-merrill"})
        CHECK(channelsOf(std::string("cameras/") + name) == Names{"R", "G", "B"});
    for (const char* name : {"Au", "Ag", "Al", "Cu"})
        CHECK(channelsOf(std::string("metals/") + name) == Names{"n", "k"});

    Names illuminants = {"A",      "B",      "C",       "D50",    "D55",    "D60",     "D65",
                         "D75",    "E",      "ID50",    "ID65",   "LED-B1", "LED-B2",  "LED-B3",
                         "LED-B4", "LED-B5", "LED-BH1", "LED-V1", "LED-V2", "LED-RGB1"};
    for (int i = 1; i <= 12; ++i)
        illuminants.push_back("FL" + std::to_string(i));
    for (int i = 1; i <= 15; ++i)
        illuminants.push_back("FL3." + std::to_string(i));
    for (int i = 1; i <= 5; ++i)
        illuminants.push_back("HP" + std::to_string(i));
    for (const std::string& name : illuminants) {
        INFO(name);
        const auto spectrum = library.find("illuminants/" + name);
        REQUIRE(spectrum);
        CHECK(spectrum->relative);
        CHECK(spectrum->quantity == Quantity::power);
        CHECK(spectrum->curve().outside() == Outside::zero);
    }

    const Names patches = {"dark-skin",    "light-skin",    "blue-sky",      "foliage",      "blue-flower",
                           "bluish-green", "orange",        "purplish-blue", "moderate-red", "purple",
                           "yellow-green", "orange-yellow", "blue",          "green",        "red",
                           "yellow",       "magenta",       "cyan",          "white",        "neutral-8",
                           "neutral-6.5",  "neutral-5",     "neutral-3.5",   "black"};
    for (const char* chart : {"charts/colorchecker", "charts/colorchecker-ohta1997"}) {
        CHECK(channelsOf(chart) == patches);
        for (const std::string& patch : patches) {
            const auto spectrum = library.find(std::string(chart) + "/" + patch);
            REQUIRE(spectrum);
            CHECK(spectrum->channels == Names{patch});
            CHECK(spectrum->curve().outside() == Outside::hold);
        }
    }
    // One value of each of two patches that are easily exchanged, from BabelColor's table.
    CHECK(library.find("charts/colorchecker/green")->curve().at(550) == 0.293);
    CHECK(library.find("charts/colorchecker/red")->curve().at(650) == 0.675);
}

TEST_CASE("the observers keep the areas under their functions that the CIE publishes") {
    const auto observer = shipped().find("observers/cie1931-2");
    REQUIRE(observer);
    const double published[3] = {106.865469, 106.856917, 106.892251};  // 1 nm sums, CIE 1931
    for (size_t c = 0; c < 3; ++c) {
        const auto values = observer->curves[c].sampleValues();
        CHECK(std::accumulate(values.begin(), values.end(), 0.0) == Approx(published[c]).epsilon(1e-8));
    }
    const auto photopic = shipped().find("observers/cie1924-photopic");
    REQUIRE(photopic);
    for (double nm = 360; nm <= 830; nm += 1)
        CHECK(photopic->curve().at(nm) == Approx(observer->curves[1].at(nm)).margin(1e-12));
}

TEST_CASE("the list is sorted, names nothing twice, and shows each sample of a chart") {
    const auto list = shipped().list();
    std::set<std::string> names;
    for (const LibraryEntry& entry : list)
        CHECK(names.insert(entry.name).second);
    CHECK(std::ranges::is_sorted(list, {}, &LibraryEntry::name));
    CHECK(names.contains("charts/colorchecker"));
    CHECK(names.contains("charts/colorchecker/dark-skin"));
    CHECK(!names.contains("observers/cie1931-2/X"));
    CHECK(shipped().names() == std::vector<std::string>(names.begin(), names.end()));
}

TEST_CASE("names are exact and do not leave the folder") {
    const TemporaryFolder folder;
    folder.write("outside.csv", goodHead + goodRows);
    folder.write("library/top.csv", goodHead + goodRows);
    folder.write("library/charts/two.csv", goodHead + goodRows);
    folder.write("library/charts/.hidden.csv", goodHead + goodRows);
    const Library library(folder.path() / "library");
    REQUIRE(library.find("charts/two"));
    REQUIRE(library.find("charts/two/b"));
    CHECK(library.find("charts/two/b")->curve().at(450) == Approx(0.4));
    for (const std::string name : {"",
                                   "/",
                                   "top",
                                   "two",
                                   "charts",
                                   "charts/",
                                   "charts/Two",
                                   "Charts/two",
                                   "charts/two.csv",
                                   "charts/two/",
                                   "charts/two/c",
                                   "charts/two/B",
                                   "charts/two/a/a",
                                   "charts//two",
                                   "charts/./two",
                                   "charts/../charts/two",
                                   "../outside",
                                   "charts/../../outside",
                                   "charts/.hidden",
                                   "/charts/two",
                                   "charts\\two",
                                   "top/a"}) {
        INFO(name);
        CHECK(!library.find(name));
    }
    CHECK(!library.find(std::string("charts/two\0", 11)));
    CHECK(!library.find(std::string(folder.path() / "library/charts/two")));
    CHECK(library.names() == std::vector<std::string>{"charts/two", "charts/two/a", "charts/two/b"});
}

TEST_CASE("a damaged file is an error of one line that names it") {
    const TemporaryFolder folder;
    const Library library(folder.path());
    const auto messageFor = [&](const std::string& text) {
        folder.write("charts/two.csv", text);
        const std::string message = errorOf([&] { (void)library.find("charts/two"); });
        INFO(text);
        INFO(message);
        CHECK(message.find("two.csv") != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
        return message;
    };
    for (const char* key : {"title", "quantity", "unit", "relative", "range", "source", "licence"}) {
        CHECK(messageFor(without(goodHead, key) + goodRows).find(key) != std::string::npos);
        CHECK(!errorOf([&] { (void)library.list(); }).empty());
        CHECK(library.names() == std::vector<std::string>{"charts/two"});
    }
    CHECK(messageFor(replaced(goodHead, "reflectance", "reflectence") + goodRows).find("reflectance") !=
          std::string::npos);
    CHECK(messageFor(replaced(goodHead, "relative: no", "relative: perhaps") + goodRows).find("yes, no") !=
          std::string::npos);
    for (const char* range : {"400-500", "400 nm, 50 nm, 3 samples", "500-400 nm, 50 nm, 3 samples",
                              "400-500 nm, 50 nm, 0 samples", "400-500 nm, 50 nm, three samples",
                              "a-b nm, 50 nm, 3 samples", ",,"})
        CHECK(messageFor(replaced(goodHead, "400-500 nm, 50 nm, 3 samples", range) + goodRows)
                  .find("380-780") != std::string::npos);
    // Cut off, longer than its head says, and not a spectrum at all.
    CHECK(messageFor(goodHead + replaced(goodRows, "500,0.5,0.6\n", "")).find("3 from 400 to 500") !=
          std::string::npos);
    messageFor(goodHead + goodRows + "550,0.7,0.8\n");
    messageFor(goodHead);
    messageFor(goodHead + "wavelength_nm,a,b\n");
    messageFor(goodHead + replaced(goodRows, "0.4", "nan"));
    messageFor(goodHead + replaced(goodRows, "0.4", "x"));
    messageFor(goodHead + replaced(goodRows, ",0.4", ""));
    messageFor(goodHead + replaced(goodRows, "450,", "350,"));
    messageFor("");
    folder.write("charts/two.csv", goodHead + goodRows);
    CHECK(library.find("charts/two"));
}

TEST_CASE("the folder is the one that SPECTRAD_SPECTRA names, and an error says where it was looked for") {
    const char* before = std::getenv("SPECTRAD_SPECTRA");
    const std::string kept = before ? before : "";
    const TemporaryFolder folder;
    folder.write("charts/two.csv", goodHead + goodRows);
    setenv("SPECTRAD_SPECTRA", folder.path().c_str(), 1);
    CHECK(Library::open().folder() == folder.path());
    CHECK(Library::open().find("charts/two"));

    const std::string missing = folder.path() / "missing";
    setenv("SPECTRAD_SPECTRA", missing.c_str(), 1);
    CHECK_THROWS_AS(Library::open(), MachineError);
    CHECK_THROWS_WITH(Library::open(), Catch::Contains(missing));
    CHECK_THROWS_WITH(Library(missing), Catch::Contains(missing));

    unsetenv("SPECTRAD_SPECTRA");
    CHECK(Library::open().find("illuminants/D65"));
    if (before) setenv("SPECTRAD_SPECTRA", kept.c_str(), 1);
}
