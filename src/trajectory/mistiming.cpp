#include "trajectory/mistiming.h"

#include <algorithm>

#include "trajectory/separation.h"

namespace mocha {

Mistiming mistiming(const Motion& a, const Motion& b, double error_s) {
  if (error_s <= 0.0) return {};
  return {error_s * std::min(bounds(a).speed, bounds(b).speed),
          std::max(a.start_time(), b.start_time()) - error_s,
          std::min(a.end_time(), b.end_time()) + error_s};
}

}  // namespace mocha
