// Files that appear whole or not at all, and the hash that says which bytes they were.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// Claims a hidden name beside `target`; commit() moves what was written there onto the target in one step.
/// Unless committed, the destructor removes it, and what stood at the target stays untouched. A fatal signal
/// removes it too (see removePendingFiles). What a process left that was killed (SIGKILL, a power cut) is
/// removed by the next one that writes the same target: pending files are locked while their process lives.
class PendingFile {
  public:
    /// Throws MachineError if the folder does not exist or cannot be written.
    explicit PendingFile(std::filesystem::path target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    /// Where to write meanwhile; keeps the target's extension.
    [[nodiscard]] const std::filesystem::path& path() const { return pending_; }
    [[nodiscard]] const std::filesystem::path& target() const { return target_; }
    /// Flushes the file to disk and renames it. Throws MachineError.
    void commit();

  private:
    void create(const std::string& prefix, const std::string& suffix);

    std::filesystem::path target_, pending_;
    int slot_ = -1, lock_ = -1;
    bool committed_ = false;
};

/// Removes the pending files of this process; async-signal-safe, for the program's signal handlers.
void removePendingFiles() noexcept;

/// The extension in lower case: ".exr" of "a/B.EXR".
[[nodiscard]] std::string extensionOf(const std::filesystem::path& path);
/// False for what is not there or cannot be asked about, too.
[[nodiscard]] bool isFile(const std::filesystem::path& path);
/// Whole file; throws InputError when it cannot be read, or is larger than `limit` bytes (names both
/// numbers).
[[nodiscard]] std::string readFile(const std::filesystem::path& path, std::uintmax_t limit = 1u << 30);
/// Writes whole or not at all.
void writeFile(const std::filesystem::path& path, std::string_view bytes);

/// SHA-256 as 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace spectrad
