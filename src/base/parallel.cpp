#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace spectrad {

void inParallel(size_t count, const std::function<void(size_t)>& part) {
    std::atomic<size_t> next{0};
    std::atomic<bool> failed{false};
    std::vector<std::exception_ptr> error(count);
    const auto work = [&] {
        for (size_t i = next++; i < count && !failed; i = next++) {
            try {
                part(i);
            } catch (...) {
                error[i] = std::current_exception();
                failed = true;
            }
        }
    };
    const size_t cores = std::max(1u, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> others;
        for (size_t k = 1; k < std::min(cores, count); ++k)
            others.emplace_back(work);
        work();
    }
    for (const std::exception_ptr& each : error)
        if (each) std::rethrow_exception(each);
}

}  // namespace spectrad
