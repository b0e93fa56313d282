// Files whose change on disk is of interest: looked at from time to time, by time of change and size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace spectrad::view {

class WatchedFiles {
  public:
    /// As they are now.
    void watch(const std::vector<std::filesystem::path>& files);
    /// Whether one has changed since watch() or since the last call that said so.
    [[nodiscard]] bool changed();

  private:
    struct Stamp {
        std::filesystem::file_time_type time{};
        std::uintmax_t bytes = 0;  ///< 0 and no time: the file is not there
        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    [[nodiscard]] static Stamp stampOf(const std::filesystem::path& file);

    std::vector<std::filesystem::path> files_;
    std::vector<Stamp> stamps_;
};

}  // namespace spectrad::view
