// Errors and remarks. Library code throws an Error or adds a Note; only src/cli prints and exits.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace spectrad {

/// A place in a text file; line and column count from 1, 0 means "not known".
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column", shortened to what is known; empty if nothing is.
    [[nodiscard]] std::string str() const;
};

/// What the process returns for an error (FORMAT: Commands).
enum class ExitCode { ok = 0, input = 1, usage = 2, machine = 3 };

class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// The user's file, scene or number is wrong. One line: "scene.xml:12:5: unknown attribute 'radius' (allowed:
/// …)".
class InputError : public Error {
  public:
    explicit InputError(const std::string& message) : Error(ExitCode::input, message) {}
    InputError(const SourceLocation& where, const std::string& message);
};

/// The command line is wrong, or names a device that is not there.
class UsageError : public Error {
  public:
    explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// The machine failed: no OpenCL, disk full, a place that cannot be written.
class MachineError : public Error {
  public:
    explicit MachineError(const std::string& message) : Error(ExitCode::machine, message) {}
};

/// Remarks for the user that are not errors, each kept once, in the order they came.
class Notes {
  public:
    void warn(const std::string& message);
    void warn(const SourceLocation& where, const std::string& message);
    /// Something chosen on the user's behalf (a default lamp, a framed camera), said but not a warning.
    void say(const std::string& message);
    [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

  private:
    std::vector<std::string> lines_;
};

}  // namespace spectrad
