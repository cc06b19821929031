#include "topology/static_map/travel_cost.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {
namespace {

std::vector<BlockedDisc> those_on(const Eigen::AlignedBox2d& bounds,
                                  std::vector<BlockedDisc> discs) {
  const auto is_off = [&](const BlockedDisc& disc) {
    return bounds.exteriorDistance(disc.centre) >= disc.radius_m;
  };
  discs.erase(std::remove_if(discs.begin(), discs.end(), is_off), discs.end());
  return discs;
}

}  // namespace

TravelCost::TravelCost(const StaticMap& static_map, const Vector2& start,
                       std::vector<BlockedDisc> blocked, const TravelOptions& options)
    : static_map_(static_map),
      start_(start),
      start_clearance_m_(static_map.field().sample(start).distance_m),
      blocked_(those_on(static_map.bounds(), std::move(blocked))),
      options_(options) {}

bool TravelCost::may_escape(const Vector2& p, double distance_m) const {
  return distance_m >= start_clearance_m_ - 1e-3 && distance_m > 0.0 &&
         (p - start_).norm() < options_.escape_radius_m;
}

double TravelCost::at(const Vector2& p, double distance_m) const {
  if (distance_m < options_.required_clearance_m && !may_escape(p, distance_m)) return kInfinity;
  if (is_blocked(p)) return kInfinity;
  const double lack = std::max(0.0, 1.0 - distance_m / options_.preferred_clearance_m);
  const double wary = 1.0 + options_.clearance_weight * lack * lack;
  const double spare_m = distance_m - options_.required_clearance_m;
  if (spare_m >= options_.room_for_speed_m) return wary;
  return wary / std::max(options_.slowest_share,
                         std::sqrt(std::max(0.0, spare_m / options_.room_for_speed_m)));
}

bool TravelCost::is_blocked(const Vector2& p) const {
  return std::any_of(blocked_.begin(), blocked_.end(), [&](const BlockedDisc& disc) {
    const double apart_m = (p - disc.centre).norm();
    return apart_m < disc.radius_m && apart_m < (start_ - disc.centre).norm() - 1e-6;
  });
}

double TravelCost::blocked_room_m(const Vector2& p) const {
  double room_m = kInfinity;
  for (const BlockedDisc& disc : blocked_)
    room_m = std::min(room_m, (p - disc.centre).norm() - disc.radius_m);
  return room_m;
}

double TravelCost::of_line(const Vector2& a, const Vector2& b) const {
  // Sampled in the same places whichever way it is gone.
  if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end())) return of_line(b, a);
  const double length_m = (b - a).norm();
  const double smallest_m = static_map_.detail_m();
  const double roomy_m = std::max(options_.preferred_clearance_m, options_.required_clearance_m);
  double sum = 0.0;
  double along_m = 0.0;
  double distance_m = static_map_.field().sample(a).distance_m;
  double cost = at(a, distance_m);
  Vector2 p = a;
  while (cost < kInfinity && along_m < length_m) {
    // As far as there is more room than could be wished for, a metre costs 1.
    const double room_m = std::min(distance_m - roomy_m, blocked_room_m(p));
    const double step_m = std::min(std::max(smallest_m, room_m), length_m - along_m);
    along_m += step_m;
    if (length_m - along_m < 1e-9 * length_m) along_m = length_m;
    p = a + (b - a) * (along_m / length_m);
    distance_m = static_map_.field().sample(p).distance_m;
    const double next = at(p, distance_m);
    sum += step_m * (room_m > smallest_m ? 1.0 : 0.5 * (cost + next));
    cost = next;
  }
  return cost < kInfinity ? sum : kInfinity;
}

}  // namespace mocha
