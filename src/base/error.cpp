#include "base/error.h"

#include <algorithm>

namespace spectrad {

std::string SourceLocation::str() const {
    if (file.empty()) return {};
    if (line <= 0) return file;
    if (column <= 0) return file + ":" + std::to_string(line);
    return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

static std::string placed(const SourceLocation& where, const std::string& message) {
    const std::string place = where.str();
    return place.empty() ? message : place + ": " + message;
}

InputError::InputError(const SourceLocation& where, const std::string& message)
    : Error(ExitCode::input, placed(where, message)) {}

void Notes::say(const std::string& message) {
    if (std::find(lines_.begin(), lines_.end(), message) == lines_.end()) lines_.push_back(message);
}

void Notes::warn(const std::string& message) {
    say("warning: " + message);
}

void Notes::warn(const SourceLocation& where, const std::string& message) {
    const std::string place = where.str();
    say(place.empty() ? "warning: " + message : place + ": warning: " + message);
}

}  // namespace spectrad
