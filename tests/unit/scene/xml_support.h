// Scenes written to a folder of their own, and what loading them says.
#pragma once

#include "base/files.h"
#include "base/text.h"
#include "scene/load.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace spectrad::testing {

/// A folder that goes away with the test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("spectrad-scene-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path write(const std::string& name, std::string_view text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        writeFile(path_ / name, text);
        return path_ / name;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline const Library& library() {
    static const Library shipped = Library::open();
    return shipped;
}

/// `text` without the folder's path before file names.
inline std::string withoutFolder(std::string text, const TemporaryFolder& folder) {
    const std::string prefix = folder.path().string() + "/";
    for (size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
        text.erase(at, prefix.size());
    return text;
}

struct Loaded {
    Scene scene;
    std::vector<std::string> notes;
};

inline Loaded load(const TemporaryFolder& folder, std::string_view xml, std::vector<std::string> set = {},
                   bool restricted = false) {
    Notes notes;
    LoadOptions options;
    options.set = std::move(set);
    options.restricted = restricted;
    Loaded result;
    result.scene = loadScene(folder.write("scene.xml", xml), library(), options, notes);
    for (const std::string& line : notes.lines())
        result.notes.push_back(withoutFolder(line, folder));
    return result;
}

inline Loaded load(std::string_view xml, std::vector<std::string> set = {}) {
    return load(TemporaryFolder(), xml, std::move(set));
}

/// The message with which a scene is refused; empty if it is not.
inline std::string refusal(const TemporaryFolder& folder, std::string_view xml,
                           std::vector<std::string> set = {}, bool restricted = false) {
    try {
        static_cast<void>(load(folder, xml, std::move(set), restricted));
    } catch (const Error& error) {
        return withoutFolder(error.what(), folder);
    }
    return {};
}

inline std::string refusal(std::string_view xml, std::vector<std::string> set = {}) {
    return refusal(TemporaryFolder(), xml, std::move(set));
}

/// `content` in a scene with a camera and a light, on line 2.
inline std::string inScene(std::string_view content, std::string_view attributes = "version=\"1\"") {
    return "<scene " + std::string(attributes) + ">\n" + std::string(content) +
           "\n<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/>\n<camera look-from=\"0 0 "
           "5\"/>\n</scene>\n";
}

}  // namespace spectrad::testing
