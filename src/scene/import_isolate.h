// Runs work that may crash, hang or eat all memory in a child process, and brings back the bytes that it
// writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace spectrad {

using ByteSink = std::function<void(const void* bytes, std::size_t size)>;

struct ChildLimits {
    double seconds = 60;  ///< of wall clock; of processor time about the same
    /// Address space beyond what this process has mapped; 0, and at most: three quarters of the machine's
    /// memory.
    std::uint64_t memoryBytes = 0;
};

struct ChildOutcome {
    std::string bytes;
    std::string
        failure;  ///< empty if the work returned; else "crashed (signal 11)", "took longer than 60 s", …
};

/// fork(), not posix_spawn() of this program with a hidden argument: the library then works the same from the
/// program, from tests and from whoever links it. In a process with several threads only the calling one goes
/// on in the child; glibc makes its heap usable there, and a lock that another thread held in some other
/// library ends as a timeout. Work therefore runs before devices are opened. In the child, standard output
/// and error are closed, no other file stays open, signals have their default meaning, and an exception from
/// `work` counts as a failure. Throws MachineError if no process can be made.
[[nodiscard]] ChildOutcome runInChild(const std::function<void(const ByteSink&)>& work,
                                      const ChildLimits& limits);

}  // namespace spectrad
