#include "base/files.h"

#include "base/error.h"
#include "base/text.h"

#include <nettle/sha2.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

// Names of pending files, in plain memory so that a signal handler can read them.
constexpr int slotCount = 16;
struct Slot {
    std::atomic<bool> used{false}, live{false};
    std::array<char, 4096> name{};
};
Slot slots[slotCount];

int claimSlot(const std::string& name) {
    for (int i = 0; i < slotCount; ++i) {
        bool expected = false;
        if (!slots[i].used.compare_exchange_strong(expected, true)) continue;
        if (name.size() + 1 > slots[i].name.size()) {
            slots[i].used = false;
            return -1;
        }
        std::memcpy(slots[i].name.data(), name.c_str(), name.size() + 1);
        slots[i].live = true;
        return i;
    }
    return -1;
}

void releaseSlot(int slot) {
    if (slot < 0) return;
    slots[slot].live = false;
    slots[slot].used = false;
}

}  // namespace

void removePendingFiles() noexcept {
    for (Slot& slot : slots)
        if (slot.live) ::unlink(slot.name.data());
}

namespace {

/// "123-4": process and number of a pending file.
bool isUnique(std::string_view text) {
    const size_t dash = text.find('-');
    const auto digits = [](std::string_view part) {
        return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
    };
    return dash != std::string_view::npos && digits(text.substr(0, dash)) && digits(text.substr(dash + 1));
}

/// Pending files of the target that no living process holds.
void removeLeftOvers(const fs::path& folder, std::string_view prefix, std::string_view suffix) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) ||
            !name.ends_with(suffix) ||
            !isUnique(
                std::string_view(name).substr(prefix.size(), name.size() - prefix.size() - suffix.size())))
            continue;
        const int file = ::open(entry.path().c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
        if (file < 0) continue;
        if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(entry.path().c_str());
        ::close(file);
    }
}

}  // namespace

PendingFile::PendingFile(fs::path target) : target_(std::move(target)) {
    std::error_code ignored;
    if (fs::is_directory(target_, ignored))
        throw MachineError("cannot write '" + target_.string() + "': it is a folder");
    const std::string prefix = "." + target_.stem().string() + ".", suffix = target_.extension().string();
    removeLeftOvers(target_.has_parent_path() ? target_.parent_path() : fs::path("."), prefix, suffix);
    create(prefix, suffix);
}

void PendingFile::create(const std::string& prefix, const std::string& suffix) {
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    static std::atomic<unsigned> counter{0};
    for (;;) {
        pending_ = folder / (prefix + std::to_string(::getpid()) + "-" + std::to_string(counter++) + suffix);
        slot_ = claimSlot(pending_.string());  // first, so that no signal falls between
        lock_ = ::open(pending_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (lock_ < 0) {
            const int error = errno;
            releaseSlot(slot_);
            throw MachineError("cannot write '" + target_.string() + "': " + std::strerror(error));
        }
        // Another process may have taken it for a left-over before it was locked.
        struct stat status {};
        static_cast<void>(::flock(lock_, LOCK_EX | LOCK_NB));
        if (::fstat(lock_, &status) != 0 || status.st_nlink > 0) return;
        ::close(lock_);
        releaseSlot(slot_);
    }
}

PendingFile::~PendingFile() {
    if (!committed_) ::unlink(pending_.c_str());
    ::close(lock_);
    releaseSlot(slot_);
}

void PendingFile::commit() {
    const int file = ::open(pending_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool flushed = file >= 0 && ::fsync(file) == 0;
    const int flushError = errno;
    if (file >= 0) ::close(file);
    if (!flushed) throw MachineError("cannot write '" + target_.string() + "': " + std::strerror(flushError));
    if (::rename(pending_.c_str(), target_.c_str()) != 0)
        throw MachineError("cannot write '" + target_.string() + "': " + std::strerror(errno));
    committed_ = true;
}

std::string extensionOf(const fs::path& path) {
    return lowerCase(path.extension().string());
}

bool isFile(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

std::string readFile(const fs::path& path, std::uintmax_t limit) {
    std::error_code error;
    if (fs::is_directory(path, error)) throw InputError(path.string() + ": is a folder");
    const std::uintmax_t size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
    if (!error && size > limit)
        throw InputError(path.string() + ": " + std::to_string(size) + " bytes, more than the limit of " +
                         std::to_string(limit));
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
    std::string bytes;
    bytes.reserve(static_cast<size_t>(size) + 1);
    std::array<char, 65536> piece{};
    while (file.read(piece.data(), piece.size()) || file.gcount() > 0) {
        bytes.append(piece.data(), static_cast<size_t>(file.gcount()));
        if (bytes.size() > limit)
            throw InputError(path.string() + ": more than the limit of " + std::to_string(limit) + " bytes");
    }
    if (file.bad()) throw InputError(path.string() + ": cannot be read to its end");
    return bytes;
}

void writeFile(const fs::path& path, std::string_view bytes) {
    PendingFile pending(path);
    {
        std::ofstream file(pending.path(), std::ios::binary);
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        file.close();
        if (!file) throw MachineError("cannot write '" + path.string() + "': " + std::strerror(errno));
    }
    pending.commit();
}

std::string sha256(std::string_view bytes) {
    sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, bytes.size(), reinterpret_cast<const uint8_t*>(bytes.data()));
    std::array<uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&context, digest.size(), digest.data());
    static constexpr std::string_view hex = "0123456789abcdef";
    std::string text;
    for (uint8_t byte : digest) {
        text += hex[byte >> 4];
        text += hex[byte & 15];
    }
    return text;
}

}  // namespace spectrad
