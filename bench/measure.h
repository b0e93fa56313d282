// Timing of contestants in turn (A B A B …), so that whatever else the machine does meets all of them alike.
#pragma once

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace spectrad::bench {

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Seconds of the rounds of one contestant: by the clock, and of work on all cores together.
struct Times {
    std::vector<double> rounds, work;
    [[nodiscard]] double typical() const { return median(rounds); }
    [[nodiscard]] double best() const { return *std::min_element(rounds.begin(), rounds.end()); }
};

/// How many times faster `ours` is than `theirs`: the median over rounds of neighbours in time, the ratio of
/// the best rounds, and how many times less work it takes. A busy machine spoils the last one least; idle
/// cores do not count in it.
struct Ratio {
    double typical = 0, best = 0, work = 0;
};
inline Ratio ratio(const Times& ours, const Times& theirs) {
    std::vector<double> each;
    for (size_t i = 0; i < ours.rounds.size(); ++i)
        each.push_back(theirs.rounds[i] / ours.rounds[i]);
    return {median(each), theirs.best() / ours.best(), median(theirs.work) / median(ours.work)};
}

/// Seconds that all threads of this process have run.
inline double workSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs the contestants in turn: once to warm up (compilers, first touch of memory), then `rounds` times
/// under the clock.
inline std::vector<Times> inTurn(const std::vector<std::function<void()>>& contestants, int rounds) {
    using Clock = std::chrono::steady_clock;
    std::vector<Times> times(contestants.size());
    for (const auto& run : contestants)
        run();
    for (int round = 0; round < rounds; ++round) {
        for (size_t i = 0; i < contestants.size(); ++i) {
            const auto start = Clock::now();
            const double work = workSeconds();
            contestants[i]();
            times[i].work.push_back(workSeconds() - work);
            times[i].rounds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
        }
    }
    return times;
}

/// The value after `option` on the command line, else `otherwise`.
inline std::string valueOf(const std::string& option, const std::string& otherwise, int argc, char** argv) {
    for (int i = 1; i + 1 < argc; ++i)
        if (argv[i] == option) return argv[i + 1];
    return otherwise;
}

/// Rounds from the command line ("--rounds 15"), at least 7.
inline int roundsFrom(int argc, char** argv) {
    return std::max(7, std::atoi(valueOf("--rounds", "7", argc, argv).c_str()));
}

/// A benchmark's main(): an error is one line and exit code 1.
inline int reported(const std::function<void()>& benchmark) {
    try {
        benchmark();
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}

}  // namespace spectrad::bench
