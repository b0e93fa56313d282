#include "image/file_sink.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>

namespace spectrad {

FileSink::FileSink(const std::filesystem::path& path, const std::filesystem::path& target)
    : target_(target.string()), file_(std::fopen(path.c_str(), "wb")) {
    check(file_ != nullptr);
    // OpenEXR writes its header and its table of chunks a few bytes at a time.
    std::setvbuf(file_, nullptr, _IOFBF, 1 << 18);
}

FileSink::~FileSink() {
    if (file_) std::fclose(file_);
}

void FileSink::check(bool done) {
    if (!done && error_ == 0) error_ = errno != 0 ? errno : EIO;
    if (error_ != 0) throw MachineError("cannot write '" + target_ + "': " + std::strerror(error_));
}

void FileSink::write(const void* bytes, size_t count) {
    // After a failure nothing more is tried: the file is lost.
    check(error_ == 0 && std::fwrite(bytes, 1, count, file_) == count);
    position_ += count;
}

void FileSink::seek(std::uint64_t position) {
    check(error_ == 0 && ::fseeko(file_, static_cast<off_t>(position), SEEK_SET) == 0);
    position_ = position;
}

void FileSink::close() {
    const bool closed = std::fclose(file_) == 0;
    file_ = nullptr;
    check(closed);
}

}  // namespace spectrad
