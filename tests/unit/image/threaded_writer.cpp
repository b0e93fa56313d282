#include "samples.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <thread>

using namespace spectrad;
using namespace spectrad::test;

namespace {

/// What a writer was given, seen from the test.
struct Seen {
    std::vector<float> values;
    std::atomic<int> strips{0};
    std::atomic<bool> blocked{false}, finished{false}, gone{false};
    int failAt = -1;
};

class WatchedWriter : public CubeWriter {
  public:
    explicit WatchedWriter(Seen& seen, size_t row) : seen_(seen), row_(row) {}
    ~WatchedWriter() override { seen_.gone = true; }
    void write(int rows, const float* bands, const float*) override {
        while (seen_.blocked)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (seen_.strips == seen_.failAt) throw MachineError("disk full");
        seen_.values.insert(seen_.values.end(), bands, bands + static_cast<size_t>(rows) * row_);
        ++seen_.strips;
    }
    WriteReport finish() override {
        seen_.finished = true;
        return {42, 0};
    }

  private:
    Seen& seen_;
    size_t row_;
};

struct Threaded {
    explicit Threaded(size_t queueBytes, int failAt = -1) {
        seen.failAt = failAt;
        writer = onOwnThread(std::make_unique<WatchedWriter>(seen, 40), queueBytes, cube.info);
    }
    Cube cube = sampleCube(20, 50, {400, 500});
    Seen seen;
    std::unique_ptr<CubeWriter> writer;
};

constexpr size_t rowBytes = (40 + 60) * sizeof(float);

}  // namespace

TEST_CASE("rows reach the writer in order, through a queue of any size") {
    Threaded t(GENERATE(size_t(0), rowBytes, 3 * rowBytes, size_t(1) << 30));
    CHECK(writeStrips(*t.writer, t.cube).underflows == 42);
    CHECK(t.seen.values == t.cube.values);
    CHECK(t.seen.finished);
}

TEST_CASE("the queue takes no more than its bytes, and write waits only then") {
    Threaded t(4 * rowBytes);
    t.seen.blocked = true;
    const std::vector<float> preview(60);
    std::atomic<int> written{0};
    std::thread feeder([&] {
        for (int y = 0; y < 6; ++y, ++written)
            t.writer->write(1, t.cube.row(y, 0), preview.data());
    });
    for (int i = 0; i < 2000 && written < 4; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(written == 4);
    t.seen.blocked = false;
    feeder.join();
    CHECK(written == 6);
}

TEST_CASE("an error of the thread comes out of the next write or of finish") {
    Threaded t(rowBytes, GENERATE(0, 3));
    CHECK_THROWS_WITH(writeStrips(*t.writer, t.cube), "disk full");
    CHECK_FALSE(t.seen.finished);
    Threaded last(size_t(1) << 30, 0);
    CHECK_THROWS_WITH(writeStrips(*last.writer, last.cube, {50}), "disk full");
}

TEST_CASE("a threaded writer that is not finished abandons its file") {
    Threaded t(size_t(1) << 30);
    const std::vector<float> preview(60);
    t.writer->write(1, t.cube.row(0, 0), preview.data());
    t.writer.reset();
    CHECK(t.seen.gone);
    CHECK_FALSE(t.seen.finished);

    const Folder folder;
    writeBytes(folder / "a.exr", "before");
    {
        auto writer = onOwnThread(createExr(folder / "a.exr", t.cube.info, {}), 1 << 20, t.cube.info);
        writer->write(1, t.cube.row(0, 0), preview.data());
    }
    CHECK(bytesOf(folder / "a.exr") == "before");
    CHECK(folder.files() == 1);
}

TEST_CASE("an EXR written on a thread of its own is the same file") {
    const Folder folder;
    const Cube cube = sampleCube(20, 50, {400, 500});
    writeStrips(*createExr(folder / "a.exr", cube.info, {}), cube);
    writeStrips(*onOwnThread(createExr(folder / "b.exr", cube.info, {}), 10000, cube.info), cube);
    CHECK(bytesOf(folder / "a.exr") == bytesOf(folder / "b.exr"));
}
