// Errors carry their place and exit code; notes keep each remark once.
#include "base/error.h"

#include <catch2/catch.hpp>

using namespace spectrad;

TEST_CASE("A place is written as far as it is known") {
    CHECK(SourceLocation{}.str().empty());
    CHECK(SourceLocation{"s.xml"}.str() == "s.xml");
    CHECK(SourceLocation{"s.xml", 3}.str() == "s.xml:3");
    CHECK(SourceLocation{"s.xml", 3, 7}.str() == "s.xml:3:7");
}

TEST_CASE("Errors say where, and bear the program's exit code") {
    CHECK(std::string(InputError({"s.xml", 3, 7}, "bad").what()) == "s.xml:3:7: bad");
    CHECK(std::string(InputError(SourceLocation{}, "bad").what()) == "bad");
    CHECK(InputError("x").code() == ExitCode::input);
    CHECK(UsageError("x").code() == ExitCode::usage);
    CHECK(MachineError("x").code() == ExitCode::machine);
    CHECK(static_cast<int>(ExitCode::input) == 1);
    CHECK(static_cast<int>(ExitCode::usage) == 2);
    CHECK(static_cast<int>(ExitCode::machine) == 3);
}

TEST_CASE("Notes are kept once, in the order they came") {
    Notes notes;
    notes.warn("first");
    notes.say("second");
    notes.warn({"s.xml", 2, 1}, "third");
    notes.warn("first");
    CHECK(notes.lines() == std::vector<std::string>{"warning: first", "second", "s.xml:2:1: warning: third"});
}
