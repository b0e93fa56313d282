#include "image/exr_sink.h"

#include <ImfThreading.h>

#include <algorithm>
#include <thread>

namespace spectrad {

int exrThreads() {
    static const int threads = [] {
        const int cores = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 256u));
        Imf::setGlobalThreadCount(cores);
        return cores;
    }();
    return threads;
}

}  // namespace spectrad
