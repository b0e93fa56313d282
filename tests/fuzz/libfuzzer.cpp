// The target FUZZ_TARGET for libFuzzer (clang): counts which branches inputs reach and keeps those that reach
// new ones.
#include "fuzz/targets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto& target =
        *std::find_if(spectrad::fuzz::targets().begin(), spectrad::fuzz::targets().end(),
                      [](const auto& t) { return t.name == FUZZ_TARGET; });
    target.run({reinterpret_cast<const char*>(data), size});
    return 0;
}
