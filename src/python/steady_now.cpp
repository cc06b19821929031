#include "python/steady_now.h"

#include <chrono>

namespace mocha {

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace mocha
