#include "simulation/mover_path.h"

#include <algorithm>
#include <cmath>

namespace mocha {

MoverState mover_state(const Mover& mover, double elapsed_s) {
  const std::size_t points = mover.path.size();
  const std::size_t sides = mover.loop ? points : points - 1;
  double round = 0.0;
  for (std::size_t i = 0; i < sides; ++i) {
    round += (mover.path[(i + 1) % points] - mover.path[i]).norm();
  }
  double ahead = mover.speed_mps * std::max(0.0, elapsed_s);
  if (mover.loop && round > 0.0) ahead = std::fmod(ahead, round);
  for (std::size_t i = 0; i < sides; ++i) {
    const Vector2 side = mover.path[(i + 1) % points] - mover.path[i];
    const double length = side.norm();
    if (ahead < length) {
      const Vector2 along = side / length;
      return {mover.path[i] + ahead * along, mover.speed_mps * along};
    }
    ahead -= length;
  }
  return {mover.loop ? mover.path.front() : mover.path.back(), Vector2::Zero()};
}

}  // namespace mocha
