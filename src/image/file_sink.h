// Bytes on their way to a file, with no failure lost.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace spectrad {

/// write, seek and close throw MachineError naming `target` and the system's reason, and does so again after
/// the first failure: a caller that must swallow one (OpenEXR's destructor, which writes the table without
/// which a file cannot be read) hears of it from close().
class FileSink {
  public:
    FileSink(const std::filesystem::path& path, const std::filesystem::path& target);
    ~FileSink();
    FileSink(const FileSink&) = delete;
    FileSink& operator=(const FileSink&) = delete;

    void write(const void* bytes, size_t count);
    [[nodiscard]] std::uint64_t position() const noexcept { return position_; }
    void seek(std::uint64_t position);
    void close();

  private:
    void check(bool done);

    std::string target_;
    std::FILE* file_ = nullptr;
    std::uint64_t position_ = 0;
    int error_ = 0;  ///< errno of the first failure
};

}  // namespace spectrad
