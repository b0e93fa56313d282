// Running the built program as a user does, in a folder of its own.
#pragma once

#include "image/cube.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cli {

namespace fs = std::filesystem;

/// A fresh folder, removed at the end.
class Folder {
  public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }
    [[nodiscard]] const fs::path& path() const { return path_; }
    /// Names of everything in it, hidden files too, sorted.
    [[nodiscard]] std::vector<std::string> names() const;
    void write(const std::string& name, const std::string& text) const;

  private:
    fs::path path_;
};

struct Outcome {
    int code = -1;   ///< exit code, or -1 where a signal ended it
    int signal = 0;  ///< that signal
    std::string out, err;

    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs `spectrad arguments…` in `folder`. `meanwhile` gets the process id as soon as it runs.
Outcome run(const Folder& folder, const std::vector<std::string>& arguments,
            const std::function<void(int)>& meanwhile = {});

/// One line, that starts with "spectrad: ".
[[nodiscard]] bool isOneLine(const std::string& text);
/// Fails the test unless the run ended with `code`, said so in one line, and printed nothing else.
void requireError(const Outcome& outcome, int code, const std::string& mention);

/// A cube whose value at pixel (x, y) and wavelength nm is value(x, y, nm).
void writeCube(const fs::path& path, int width, int height, const std::string& wavelengths,
               const std::function<double(int, int, double)>& value,
               spectrad::CubeKind kind = spectrad::CubeKind::radiance,
               const std::map<std::string, std::string>& attributes = {});
[[nodiscard]] std::string bytesOf(const fs::path& path);

/// Largest difference of two pictures' 8-bit codes; fails the test unless they are of one size.
[[nodiscard]] int codesApart(const fs::path& a, const fs::path& b);
/// Fails the test unless `observe cube options…` makes that picture, within one code.
void requireObserved(const Folder& folder, const std::string& cube, const std::string& picture,
                     const std::vector<std::string>& options);

/// Whether `view` made its picture off screen; false, and said, where that cannot be had. Fails the test for
/// any other failure.
[[nodiscard]] bool canDraw(const Outcome& outcome);

/// True where an OpenCL device is; else says that the test is skipped.
[[nodiscard]] bool haveDevice();

}  // namespace cli
