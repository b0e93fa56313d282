// How the program speaks: results to standard output, remarks, progress and errors to standard error.
#pragma once

#include "base/error.h"
#include "base/stopwatch.h"

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <string>
#include <string_view>

namespace spectrad {

using Json = nlohmann::ordered_json;

/// Collects a command's remarks and prints them, each once, to standard error; also when an error ends the
/// command.
class Console {
  public:
    explicit Console(bool quiet) : quiet_(quiet) {}
    ~Console() { printNotes(); }
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    [[nodiscard]] Notes& notes() { return notes_; }
    /// Prints the remarks that came since the last call (nothing with --quiet).
    void printNotes() noexcept;

  private:
    bool quiet_;
    Notes notes_;
    size_t printed_ = 0;
};

/// A bar on standard error while something takes long; only on a terminal, and gone when it ends.
class ProgressBar {
  public:
    ProgressBar(std::string label, bool quiet);
    ~ProgressBar() { clear(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(double share);  ///< 0…1; redraws at most ten times a second
    void clear();

  private:
    std::string label_;
    bool enabled_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point start_, last_;
};

/// Result text, as it is.
void printText(std::string_view text);
/// One JSON value, objects indented, arrays of plain values on one line; what is not finite is null.
void printJson(const Json& value);
/// Flushes standard output; throws MachineError if it did not take everything (a full disk behind a
/// redirection).
void finishOutput();
/// "spectrad: message", one line to standard error.
void printError(std::string_view message) noexcept;

}  // namespace spectrad
