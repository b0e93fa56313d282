#include "samples.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <sys/resource.h>

using namespace spectrad;
using namespace spectrad::test;
using Catch::Matchers::Contains;

namespace {

/// A limit on file sizes stands in for a full disk: writes beyond it fail.
class SmallDisk {
  public:
    explicit SmallDisk(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &limit_);
        const rlimit small{bytes, limit_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallDisk() {
        ::setrlimit(RLIMIT_FSIZE, &limit_);
        std::signal(SIGXFSZ, before_);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

  private:
    void (*before_)(int);
    rlimit limit_{};
};

std::unique_ptr<CubeWriter> create(const std::filesystem::path& path, const CubeInfo& info,
                                   Compression compression) {
    return path.extension() == ".exr" ? createExr(path, info, {compression, false}) : createEnvi(path, info);
}

}  // namespace

TEST_CASE("an abandoned writer leaves nothing, and keeps the file that was there") {
    const char* name = GENERATE("a.exr", "a.img");
    const Folder folder;
    const Cube cube = sampleCube(20, 20, {400, 500});
    {
        auto writer = create(folder / name, cube.info, Compression::piz);
        writer->write(7, cube.row(0, 0), std::vector<float>(7 * 60).data());
    }
    CHECK(folder.files() == 0);
    writeBytes(folder / name, "before");
    {
        auto writer = create(folder / name, cube.info, Compression::none);
        writer->write(20, cube.row(0, 0), std::vector<float>(20 * 60).data());
    }
    CHECK(folder.files() == 1);
    CHECK(bytesOf(folder / name) == "before");
}

TEST_CASE("a full disk is an error of the machine, wherever it strikes, and the old file stays") {
    const char* name = GENERATE("a.exr", "a.img");
    const auto compression = GENERATE(Compression::none, Compression::piz);
    const Folder folder;
    const Cube cube = sampleCube(64, 64, ascending(400, 10, 10));
    writeStrips(*create(folder / name, cube.info, compression), cube);
    const auto whole = std::filesystem::file_size(folder / name);
    const long files = folder.files();
    writeBytes(folder / name, "before");
    for (const auto limit : {std::uintmax_t(1), std::uintmax_t(300), whole / 2, whole - 1}) {
        INFO(limit << " of " << whole);
        const SmallDisk disk(limit);
        CHECK_THROWS_AS(writeStrips(*create(folder / name, cube.info, compression), cube), MachineError);
        CHECK(folder.files() == files);
        CHECK(bytesOf(folder / name) == "before");
    }
}

TEST_CASE("a place that cannot be written is an error of the machine before anything is rendered") {
    const Folder folder;
    const Cube cube = sampleCube(2, 2, {400});
    CHECK_THROWS_AS(createExr(folder / "none/a.exr", cube.info, {}), MachineError);
    CHECK_THROWS_AS(createExr("/proc/a.exr", cube.info, {}), MachineError);
    CHECK_THROWS_AS(createEnvi(folder / "none/a.img", cube.info), MachineError);
}

TEST_CASE("a value that is not finite is named with its pixel and band") {
    const char* name = GENERATE("a.exr", "a.img");
    const float bad =
        GENERATE(std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                 std::numeric_limits<float>::quiet_NaN());
    const Folder folder;
    Cube cube = sampleCube(7, 50, {400, 500, 600});
    cube.values[(41 * 3 + 1) * 7 + 5] = bad;
    CHECK_THROWS_WITH(writeStrips(*create(folder / name, cube.info, Compression::zip), cube),
                      Contains("pixel 5,41, band 500 nm"));
    CHECK(folder.files() == 0);
}

TEST_CASE("a value beyond half is named with its pixel and band") {
    const Folder folder;
    Cube cube = sampleCube(7, 50, {400, 500, 600}, 1);
    cube.values[(41 * 3 + 1) * 7 + 5] = 70000;
    CHECK_THROWS_WITH(writeStrips(*createExr(folder / "a.exr", cube.info, {Compression::zip, true}), cube),
                      Contains("70000") && Contains("pixel 5,41, band 500 nm"));
}

TEST_CASE("a preview that is not a number is refused") {
    const Folder folder;
    const Cube cube = sampleCube(1, 1, {400});
    const float preview[3] = {0, std::numeric_limits<float>::quiet_NaN(), 0};
    auto writer = createExr(folder / "a.exr", cube.info, {});
    CHECK_THROWS_AS(writer->write(1, cube.values.data(), preview), InputError);
}

TEST_CASE("an image beyond the format is refused with its numbers before anything is rendered") {
    CubeInfo info;
    info.width = 65536;
    info.height = 2;
    info.wavelengths.nm = ascending(380, 1, 401);
    const Folder folder;
    CHECK_THROWS_WITH(createExr(folder / "a.exr", info, {}),
                      Contains("65536") && Contains("404") && Contains("2147483647") && Contains("zips"));
    CHECK(folder.files() == 0);
    info.wavelengths.nm = ascending(380, 0.01, 10000);
    CHECK_THROWS_WITH(createExr(folder / "a.exr", info, {Compression::zips, false}), Contains("envi"));
}

TEST_CASE("the default compression works for any width, and says when it is not the usual one") {
    CubeInfo info;
    info.width = 1920;
    info.height = 1080;
    info.wavelengths.nm = ascending(380, 5, 81);
    Notes notes;
    CHECK(chooseCompression(info, {}, false, notes) == Compression::piz);
    CHECK(notes.lines().empty());
    info.width = 65536;
    info.wavelengths.nm = ascending(380, 1, 401);
    CHECK(chooseCompression(info, {}, false, notes) == Compression::zips);
    REQUIRE(notes.lines().size() == 1);
    CHECK_THAT(notes.lines()[0], Contains("zips instead of piz"));
    CHECK_THROWS_AS(chooseCompression(info, {}, true, notes), InputError);
}

TEST_CASE("what no cube can be is refused") {
    const Folder folder;
    CubeInfo info;
    info.width = 4;
    info.height = 4;
    info.wavelengths.nm = {400, 500};
    const auto refused = [&](const CubeInfo& i) {
        CHECK_THROWS_AS(createExr(folder / "a.exr", i, {}), InputError);
        CHECK_THROWS_AS(createEnvi(folder / "a.img", i), InputError);
    };
    for (const auto& nm :
         {std::vector<double>{}, std::vector<double>{500, 400}, std::vector<double>{500, 500},
          std::vector<double>{0, 500}, std::vector<double>{500, std::numeric_limits<double>::infinity()}}) {
        CubeInfo bad = info;
        bad.wavelengths.nm = nm;
        refused(bad);
    }
    CubeInfo bad = info;
    bad.height = 0;
    refused(bad);
    bad = info;
    bad.attributes["projection"] = "would hide the file's own";
    refused(bad);
    bad = info;
    bad.attributes[std::string(23, 'x')] = "too long a name";
    CHECK_THROWS_AS(createExr(folder / "a.exr", bad, {}), InputError);
    bad = info;
    bad.attributes["lensTransmission"] = "no curve";
    CHECK_THROWS_AS(createExr(folder / "a.exr", bad, {}), InputError);
    CHECK(folder.files() == 0);
}

TEST_CASE("compressions are known by name, others are wrong usage") {
    CHECK(parseCompression("zips") == Compression::zips);
    CHECK(name(Compression::piz) == "piz");
    CHECK_THROWS_AS(parseCompression("dwaa"), UsageError);
}
