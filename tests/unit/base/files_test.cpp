// Files appear whole or not at all.
#include "base/files.h"

#include "base/error.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using namespace spectrad;
namespace fs = std::filesystem;

namespace {

size_t filesIn(const fs::path& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("A file is written whole and read back") {
    const TemporaryFolder folder;
    const std::string bytes("a\0b\r\n\xff", 6);
    writeFile(folder.path() / "x.bin", bytes);
    CHECK(readFile(folder.path() / "x.bin") == bytes);
    writeFile(folder.path() / "x.bin", "");
    CHECK(readFile(folder.path() / "x.bin").empty());
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("A folder, nothing and what lies below a file are no files; extensions are told in lower case") {
    const TemporaryFolder folder;
    writeFile(folder.path() / "x.BIN", "1");
    CHECK(isFile(folder.path() / "x.BIN"));
    CHECK_FALSE(isFile(folder.path()));
    CHECK_FALSE(isFile(folder.path() / "y"));
    CHECK_FALSE(isFile(folder.path() / "x.BIN" / "y"));
    CHECK(extensionOf(folder.path() / "x.BIN") == ".bin");
    CHECK(extensionOf("a.b/c").empty());
}

TEST_CASE("Until it is committed a pending file leaves its target as it was, and afterwards no trace") {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "out.exr";
    writeFile(target, "old");
    {
        const PendingFile pending(target);
        CHECK(pending.path().extension() == ".exr");
        CHECK(pending.path().parent_path() == folder.path());
        CHECK(pending.target() == target);
        CHECK(filesIn(folder.path()) == 2);
        CHECK(readFile(target) == "old");
    }
    CHECK(filesIn(folder.path()) == 1);
    PendingFile pending(target);
    pending.commit();
    CHECK(readFile(target).empty());
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("A process that dies of a signal removes what it had pending") {
    const TemporaryFolder folder;
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const PendingFile pending(folder.path() / "out.exr");
        removePendingFiles();
        _exit(fs::is_empty(folder.path()) ? 0 : 1);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE(
    "What a killed process left is removed by the next one that writes the same file, what a living one "
    "holds is not") {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "image.exr";
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const PendingFile pending(target);
        ::raise(SIGKILL);
    }
    ::waitpid(child, nullptr, 0);
    CHECK(filesIn(folder.path()) == 1);
    writeFile(folder.path() / ".image.notes-1.exr", "not ours");
    {
        const PendingFile first(target), second(target);
        CHECK(filesIn(folder.path()) == 3);  // the foreign file, and both of this process
        CHECK(fs::exists(first.path()));
    }
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("A place that cannot be written is the machine's error, a file that cannot be read the input's") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(PendingFile(folder.path() / "absent/out.exr"), MachineError);
    CHECK_THROWS_AS(PendingFile(folder.path()), MachineError);
    CHECK_THROWS_AS(writeFile(folder.path() / "absent/x", "x"), MachineError);
    CHECK_THROWS_AS(readFile(folder.path() / "absent"), InputError);
    CHECK_THROWS_WITH(readFile(folder.path()), folder.path().string() + ": is a folder");
}

TEST_CASE("A file beyond the limit is refused with both numbers") {
    const TemporaryFolder folder;
    writeFile(folder.path() / "x", "12345");
    CHECK(readFile(folder.path() / "x", 5) == "12345");
    CHECK_THROWS_WITH(readFile(folder.path() / "x", 4),
                      (folder.path() / "x").string() + ": 5 bytes, more than the limit of 4");
}

TEST_CASE("SHA-256 is that of FIPS 180-4") {
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
