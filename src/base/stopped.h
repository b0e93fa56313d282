// Work that ends early because whoever wanted it does not want it any more.
#pragma once

#include <exception>
#include <stop_token>

namespace spectrad {

/// No Error: nothing is wrong. Caught by whoever asked the work to stop.
class Stopped : public std::exception {
  public:
    [[nodiscard]] const char* what() const noexcept override { return "stopped"; }
};

inline void throwIfStopped(const std::stop_token& stop) {
    if (stop.stop_requested()) throw Stopped();
}

}  // namespace spectrad
