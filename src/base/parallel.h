// Work on several threads whose result does not depend on them.
#pragma once

#include <cstddef>
#include <functional>

namespace spectrad {

/// Calls part(0) … part(count − 1), each once, from as many threads as the machine has cores, and returns
/// when all are done. Parts must not depend on each other. The first exception, by the parts' order among
/// those begun, is thrown on; parts not yet begun are then left out.
void inParallel(size_t count, const std::function<void(size_t)>& part);

}  // namespace spectrad
