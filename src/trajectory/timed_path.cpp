#include "trajectory/timed_path.h"

#include <algorithm>

namespace mocha {

Vector2 position_at(const TimedPath& path, double time_s) {
  const auto later = std::find_if(path.begin(), path.end(),
                                  [&](const TimedPoint& point) { return point.time_s > time_s; });
  if (later == path.begin()) return path.front().position;
  if (later == path.end()) return path.back().position;
  const TimedPoint& before = *(later - 1);
  const double share = (time_s - before.time_s) / (later->time_s - before.time_s);
  return before.position + share * (later->position - before.position);
}

}  // namespace mocha
