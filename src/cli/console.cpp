#include "cli/console.h"

#include "base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace spectrad {

namespace {

/// Errors and remarks are one line each, whatever a message (a compiler's log, a file's name) holds.
std::string oneLine(std::string_view message) {
    std::string line;
    for (char c : trimmed(message)) {
        if (c == '\n' || c == '\r')
            line += line.ends_with(' ') ? "" : " ";
        else if (static_cast<unsigned char>(c) >= 0x20)
            line += c;
    }
    return line;
}

bool isPlain(const Json& value) {
    return std::none_of(value.begin(), value.end(), [](const Json& item) { return item.is_structured(); });
}

std::string dumped(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void append(const Json& value, std::string& out, int depth) {
    if (!value.is_structured() || value.empty()) {
        out += dumped(value);
        return;
    }
    if (value.is_array() && isPlain(value)) {
        out += '[';
        for (size_t i = 0; i < value.size(); ++i)
            out += (i ? ", " : "") + dumped(value[i]);
        out += ']';
        return;
    }
    const std::string indent(static_cast<size_t>(depth) * 2 + 2, ' ');
    out += value.is_array() ? "[\n" : "{\n";
    bool first = true;
    for (const auto& item : value.items()) {
        if (!first) out += ",\n";
        first = false;
        out += indent;
        if (value.is_object()) out += dumped(Json(item.key())) + ": ";
        append(item.value(), out, depth + 1);
    }
    out += '\n' + indent.substr(2) + (value.is_array() ? ']' : '}');
}

}  // namespace

void Console::printNotes() noexcept {
    for (; printed_ < notes_.lines().size(); ++printed_)
        if (!quiet_) printError(notes_.lines()[printed_]);
}

ProgressBar::ProgressBar(std::string label, bool quiet)
    : label_(std::move(label)),
      enabled_(!quiet && ::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

void ProgressBar::show(double share) {
    const auto now = std::chrono::steady_clock::now();
    if (!enabled_ || now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    drawn_ = true;
    constexpr int width = 30;
    const double done = std::clamp(share, 0.0, 1.0);
    const int full = static_cast<int>(std::lround(done * width));
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    std::string left;
    if (done > 0.02 && elapsed > 1) left = fmt::format(", {:.0f} s left", elapsed * (1 - done) / done);
    const std::string line =
        fmt::format("\r{} [{}{}] {:3.0f} %{}\x1b[K", label_, std::string(static_cast<size_t>(full), '#'),
                    std::string(static_cast<size_t>(width - full), '.'), done * 100, left);
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
}

void ProgressBar::clear() {
    if (!drawn_) return;
    drawn_ = false;
    std::fputs("\r\x1b[K", stderr);
    std::fflush(stderr);
}

void printText(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
}

void printJson(const Json& value) {
    std::string text;
    append(value, text, 0);
    printText(text + '\n');
}

void finishOutput() {
    const bool flushed = std::fflush(stdout) == 0;
    if (!flushed || std::ferror(stdout))
        throw MachineError(std::string("cannot write the results to standard output: ") +
                           std::strerror(errno));
}

void printError(std::string_view message) noexcept {
    try {
        const std::string line = "spectrad: " + oneLine(message) + "\n";
        std::fputs(line.c_str(), stderr);
    } catch (const std::bad_alloc&) {
        std::fputs("spectrad: out of memory\n", stderr);
    }
}

}  // namespace spectrad
