// Files whose change on disk is of interest: looked at from time to time, by time of change and size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace spectrad::view {

class WatchedFiles {
  public:
    /// From now on these; of one that was watched before, no change is missed.
    void watch(const std::vector<std::filesystem::path>& files);
    /// Whether one has changed since it was first watched, or since the last call.
    [[nodiscard]] bool changed();

  private:
    struct Stamp {
        std::filesystem::file_time_type time{};
        std::uintmax_t bytes = 0;  ///< 0 and no time: the file is not there
        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    [[nodiscard]] static Stamp stampOf(const std::filesystem::path& file);

    std::map<std::filesystem::path, Stamp> files_;
};

}  // namespace spectrad::view
