#include "scene/import_isolate.h"

#include "base/error.h"
#include "base/machine.h"
#include "base/text.h"

#include <climits>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace spectrad {

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool addressSanitizer = true;  // reserves terabytes of address space for itself
#else
constexpr bool addressSanitizer = false;
#endif

constexpr int childPipe = 3;
constexpr int exitThrew = 3, exitNoMemory = 4;

/// Bytes of address space that this process has mapped; 0 if the system does not say.
std::uint64_t addressSpaceUsed() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0;
    return file >> pages ? pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

void limitTo(__rlimit_resource_t resource, rlim_t soft, rlim_t hard) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return;
    const rlimit wanted{std::min(soft, now.rlim_max), std::min(hard, now.rlim_max)};
    ::setrlimit(resource, &wanted);
}

/// Everything that the child must not share with its parent.
void enterChild(int pipe, const ChildLimits& limits, std::uint64_t addressSpace) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (int number = 1; number < NSIG; ++number)
        std::signal(number, SIG_DFL);  // SIGKILL and SIGSTOP refuse: no matter
    sigset_t all;
    ::sigemptyset(&all);
    ::sigprocmask(SIG_SETMASK, &all, nullptr);
    ::dup2(pipe, childPipe);
    const int nothing = ::open("/dev/null", O_RDWR);
    for (int standard = 0; standard < 3; ++standard)
        ::dup2(nothing, standard);
    // Write ends of other imports' pipes, files half written, sockets: a child that outlives its use must not
    // hold them.
    ::close_range(childPipe + 1, UINT_MAX, 0);
    const auto seconds = static_cast<rlim_t>(std::ceil(limits.seconds));
    limitTo(RLIMIT_CPU, seconds + 1, seconds + 2);
    limitTo(RLIMIT_CORE, 0, 0);
    limitTo(RLIMIT_FSIZE, 0, 0);
    if (!addressSanitizer) limitTo(RLIMIT_AS, addressSpace, addressSpace);
}

void writeAll(const void* bytes, size_t size) {
    const char* at = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t written = ::write(childPipe, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) ::_exit(exitThrew);
        at += written;
        size -= static_cast<size_t>(written);
    }
}

/// Never returns, and runs no destructor and no exit handler of the parent's.
[[noreturn]] void runChild(const std::function<void(const ByteSink&)>& work) {
    int code = 0;
    try {
        work(writeAll);
    } catch (const std::bad_alloc&) {
        code = exitNoMemory;
    } catch (...) {
        code = exitThrew;
    }
    ::_exit(code);
}

class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    void close() {
        if (fd_ >= 0) ::close(fd_);
        fd_ = -1;
    }
    [[nodiscard]] int get() const { return fd_; }

  private:
    int fd_;
};

/// Reaps the child whatever happens in the parent (out of memory while reading, say).
class Child {
  public:
    explicit Child(pid_t pid) : pid_(pid) {}
    ~Child() {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        (void)wait();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    void kill() const { ::kill(pid_, SIGKILL); }
    int wait() {
        int status = 0;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = 0;
        return status;
    }

  private:
    pid_t pid_;
};

/// Reads to the end; false when the time is up.
bool readUntil(int fd, std::chrono::steady_clock::time_point deadline, std::string& bytes) {
    std::vector<char> piece(1 << 20);
    while (true) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0) return false;
        pollfd waiting{fd, POLLIN, 0};
        const int ready = ::poll(&waiting, 1, static_cast<int>(std::min<long long>(left.count(), INT_MAX)));
        if (ready < 0 && errno != EINTR) throw MachineError(std::string("import: ") + std::strerror(errno));
        if (ready <= 0) continue;
        const ssize_t got = ::read(fd, piece.data(), piece.size());
        if (got == 0) return true;
        if (got < 0 && errno != EINTR) throw MachineError(std::string("import: ") + std::strerror(errno));
        if (got > 0) bytes.append(piece.data(), static_cast<size_t>(got));
    }
}

std::string describe(int status) {
    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        if (number == SIGXCPU) return "took too much processor time";
        if (number == SIGKILL) return "was killed (signal 9; out of memory?)";
        return "crashed (signal " + std::to_string(number) + ")";
    }
    const int code = WEXITSTATUS(status);
    if (code == 0) return {};
    if (code == exitNoMemory) return "ran out of memory";
    return "failed (exit code " + std::to_string(code) + ")";
}

}  // namespace

ChildOutcome runInChild(const std::function<void(const ByteSink&)>& work, const ChildLimits& limits) {
    const auto deadline =
        std::chrono::steady_clock::now() +
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(limits.seconds));
    const std::uint64_t most = memoryOfMachine() / 4 * 3;
    const std::uint64_t addressSpace =
        addressSpaceUsed() + (limits.memoryBytes > 0 ? std::min(limits.memoryBytes, most) : most);

    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw MachineError(std::string("cannot start a process for the import: ") + std::strerror(errno));
    Descriptor readEnd(ends[0]), writeEnd(ends[1]);
    const pid_t pid = ::fork();
    if (pid < 0)
        throw MachineError(std::string("cannot start a process for the import: ") + std::strerror(errno));
    if (pid == 0) {
        enterChild(writeEnd.get(), limits, addressSpace);
        runChild(work);
    }
    Child child(pid);
    writeEnd.close();

    ChildOutcome outcome;
    const bool inTime = readUntil(readEnd.get(), deadline, outcome.bytes);
    if (!inTime) child.kill();
    const int status = child.wait();
    outcome.failure = inTime ? describe(status) : "took longer than " + shortest(limits.seconds) + " s";
    return outcome;
}

}  // namespace spectrad
