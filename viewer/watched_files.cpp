#include "viewer/watched_files.h"

#include <system_error>
#include <utility>

namespace spectrad::view {

WatchedFiles::Stamp WatchedFiles::stampOf(const std::filesystem::path& file) {
    std::error_code absent;
    Stamp stamp{std::filesystem::last_write_time(file, absent), 0};
    if (absent) return {};
    stamp.bytes = std::filesystem::file_size(file, absent);
    return absent ? Stamp{} : stamp;
}

void WatchedFiles::watch(const std::vector<std::filesystem::path>& files) {
    std::map<std::filesystem::path, Stamp> wanted;
    for (const std::filesystem::path& file : files) {
        const auto known = files_.find(file);
        wanted.emplace(file, known == files_.end() ? stampOf(file) : known->second);
    }
    files_ = std::move(wanted);
}

bool WatchedFiles::changed() {
    bool any = false;
    for (auto& [file, stamp] : files_) {
        const Stamp now = stampOf(file);
        any = any || !(now == stamp);
        stamp = now;
    }
    return any;
}

}  // namespace spectrad::view
