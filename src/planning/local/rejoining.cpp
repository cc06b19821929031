#include "planning/local/rejoining.h"

#include <algorithm>
#include <utility>

namespace mocha {
namespace {

constexpr double kStep_s = 0.05;      // between the places of a plan that are looked at
constexpr double kNearer_m = 0.02;    // by less, a later place is not nearer
constexpr double kLeast_s = 0.3;      // of a drive that is worth joining
constexpr double kAlmostEnd_s = 0.6;  // of a drive: it is joined at its end

}  // namespace

std::optional<double> progress_on(const Motion& plan, const Vector2& p, double from_s,
                                  double within_m) {
  std::optional<double> best_s;
  if (plan.empty()) return best_s;
  double nearest_m = within_m;
  for (double t = std::max(from_s, plan.start_time()); t <= plan.end_time(); t += kStep_s) {
    const double distance_m = (plan.position(t) - p).norm();
    if (!(distance_m < nearest_m - (best_s ? kNearer_m : 0.0))) continue;
    nearest_m = distance_m;
    best_s = t;
  }
  return best_s;
}

std::optional<RejoinPoint> find_rejoin_point(const Motion& plan, double progress_s,
                                             double ahead_s) {
  for (int i = 0; i < static_cast<int>(plan.phases().size()); ++i) {
    const double begin_s = plan.phase_start_time(i);
    const double end_s = begin_s + duration_s(plan.phases()[i]);
    const auto* drive = std::get_if<DrivePhase>(&plan.phases()[i]);
    const double from_s = std::max(progress_s, begin_s);
    if (end_s - from_s < kLeast_s || drive == nullptr) continue;
    if (drive->direction < 0) return std::nullopt;
    double at_s = from_s + ahead_s;
    if (at_s > end_s - kAlmostEnd_s) at_s = end_s;
    return RejoinPoint{at_s, drive->path.state(at_s - begin_s), at_s - from_s};
  }
  return std::nullopt;
}

}  // namespace mocha
