// Text out of files, fit for a message.
#pragma once

#include <string>
#include <string_view>

namespace spectrad {

/// The text on one line: control characters become '?', and what goes beyond 60 bytes an ellipsis.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace spectrad
