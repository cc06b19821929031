#include "simulation/mover_path.h"

#include <algorithm>
#include <cmath>

namespace mocha {

std::optional<MoverState> mover_state(const Mover& mover, double elapsed_s) {
  const Keyframe& first = mover.keyframes.front();
  const Keyframe& last = mover.keyframes.back();
  const bool stands = mover.after_last == AfterLast::kStands;
  if (elapsed_s < first.time_s) {
    return stands ? std::optional<MoverState>({first.place, Vector2::Zero()}) : std::nullopt;
  }
  double time_s = elapsed_s;
  if (mover.after_last == AfterLast::kRepeats)
    time_s = first.time_s + std::fmod(elapsed_s - first.time_s, last.time_s - first.time_s);
  const auto is_later = [](double t, const Keyframe& keyframe) { return t < keyframe.time_s; };
  const auto next =
      std::upper_bound(mover.keyframes.begin(), mover.keyframes.end(), time_s, is_later);
  if (next == mover.keyframes.end()) {
    return stands || time_s == last.time_s
               ? std::optional<MoverState>({last.place, Vector2::Zero()})
               : std::nullopt;
  }
  const Keyframe& before = *std::prev(next);
  const Vector2 velocity = (next->place - before.place) / (next->time_s - before.time_s);
  return MoverState{before.place + (time_s - before.time_s) * velocity, velocity};
}

}  // namespace mocha
