#include "viewer/watched_files.h"

#include <system_error>

namespace spectrad::view {

WatchedFiles::Stamp WatchedFiles::stampOf(const std::filesystem::path& file) {
    std::error_code absent;
    Stamp stamp{std::filesystem::last_write_time(file, absent), 0};
    if (absent) return {};
    stamp.bytes = std::filesystem::file_size(file, absent);
    return absent ? Stamp{} : stamp;
}

void WatchedFiles::watch(const std::vector<std::filesystem::path>& files) {
    files_ = files;
    stamps_.clear();
    for (const std::filesystem::path& file : files_)
        stamps_.push_back(stampOf(file));
}

bool WatchedFiles::changed() {
    bool any = false;
    for (size_t i = 0; i < files_.size(); ++i) {
        const Stamp now = stampOf(files_[i]);
        any = any || !(now == stamps_[i]);
        stamps_[i] = now;
    }
    return any;
}

}  // namespace spectrad::view
