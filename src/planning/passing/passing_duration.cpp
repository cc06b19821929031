#include "planning/passing/passing_duration.h"

#include <algorithm>
#include <cmath>

#include "trajectory/plane_vectors.h"
#include "trajectory/polyline.h"

namespace mocha {
namespace {

constexpr double kShareOfAllTimes = 0.1;
constexpr double kBend_rad = 1.2;  // of more, it stops and turns in place
constexpr double kSame_s = 1e-6;

struct MoveTimes {
  double begins_s;
  double ends_s;
};

/// Between the end of one move and the beginning of the next [rad].
double bend(const std::vector<Vector2>& before, const std::vector<Vector2>& after) {
  return std::abs(angle_between(before.back() - before[before.size() - 2], after[1] - after[0]));
}

class Timing {
 public:
  Timing(const PassingOrder& order, const PassingPace& pace)
      : order_(order), pace_(pace), made_(order.size()) {}

  double run() {
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (std::size_t robot = 0; robot < order_.size(); ++robot) {
        while (made_[robot].size() < order_[robot].size() && make(robot)) goes_on = true;
      }
    }
    double last_s = 0.0;
    double all_s = 0.0;
    for (const auto& made : made_) {
      const double end_s = made.empty() ? 0.0 : made.back().ends_s;
      last_s = std::max(last_s, end_s);
      all_s += end_s;
    }
    return last_s + kShareOfAllTimes * all_s;
  }

 private:
  /// The next move of a robot; false while one that it waits for is not made.
  bool make(std::size_t robot) {
    const std::size_t move = made_[robot].size();
    const PassingTurn& turn = order_[robot][move];
    const double here_s = move > 0 ? made_[robot].back().ends_s : 0.0;
    double begins_s = here_s;
    for (const PassingProgress& progress : turn.after) {
      if (made_[progress.robot].size() < progress.moves) return false;
      begins_s =
          std::max(begins_s, made_[progress.robot][progress.moves - 1].begins_s + pace_.handover_s);
    }
    double drives_s = length_of(turn.path) / pace_.speed_mps;
    const double bend_rad = move > 0 ? bend(order_[robot][move - 1].path, turn.path) : 0.0;
    const bool stops = move == 0 || begins_s > here_s + kSame_s || bend_rad > kBend_rad;
    if (stops) drives_s += pace_.speed_mps / pace_.acceleration;
    // Who waits turns meanwhile.
    const double turns_rad = pace_.may_back ? std::min(bend_rad, M_PI - bend_rad) : bend_rad;
    if (bend_rad > kBend_rad) begins_s = std::max(begins_s, here_s + turns_rad / pace_.yaw_rate);
    made_[robot].push_back({begins_s, begins_s + drives_s});
    return true;
  }

  const PassingOrder& order_;
  const PassingPace pace_;
  std::vector<std::vector<MoveTimes>> made_;
};

}  // namespace

double duration_s(const PassingOrder& order, const PassingPace& pace) {
  return Timing(order, pace).run();
}

}  // namespace mocha
