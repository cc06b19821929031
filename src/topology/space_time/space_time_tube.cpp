#include "topology/space_time/space_time_tube.h"

namespace mocha {
namespace {

constexpr double kChordError_m = 0.03;
constexpr double kShortest_s = 0.02;

void append(const MovingObstacle& obstacle, double from_s, double until_s, double keep_m,
            Tube<2>& tube) {
  const double span_s = until_s - from_s;
  const double error_m = obstacle.chord_error_m(from_s, until_s);
  if (error_m > kChordError_m && span_s > kShortest_s) {
    const double middle_s = from_s + 0.5 * span_s;
    append(obstacle, from_s, middle_s, keep_m, tube);
    append(obstacle, middle_s, until_s, keep_m, tube);
    return;
  }
  const MovingObstacle::Disc first = obstacle.at(from_s);
  const MovingObstacle::Disc last = obstacle.at(until_s);
  tube.push_back({from_s, until_s, first.centre, (last.centre - first.centre) / span_s,
                  first.radius_m + keep_m + error_m, (last.radius_m - first.radius_m) / span_s});
}

}  // namespace

Tube<2> tube_of(const MovingObstacle& obstacle, double from_s, double until_s, double keep_m) {
  Tube<2> tube;
  if (from_s < until_s) append(obstacle, from_s, until_s, keep_m, tube);
  return tube;
}

}  // namespace mocha
