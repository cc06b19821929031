#pragma once

#include <cstddef>
#include <functional>

namespace mocha {

/// Calls work(0) to work(count - 1), each once, on up to `threads` threads (0: one for each core),
/// in about this order; returns when all have ended.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace mocha
