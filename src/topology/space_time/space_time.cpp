#include "topology/space_time/space_time.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace mocha {
namespace {

constexpr double kLeastLater_m = 1e-6;
constexpr double kRounding = 1e-9;
constexpr double kSlack_m = 0.003;  // as in the proofs of leaving
constexpr double kLeaving = 0.1;    // of max_speed

template <int D>
constexpr int entries_each() {
  return D == 2 ? 1 : static_cast<int>(kProjectionPlanes.size());
}

/// The crossings of a relative path with the cut of an obstacle at the origin.
template <typename Place, typename Visit>
void cross_origin(const Place& from, const Place& to, int first_entry, const Visit& visit) {
  for (int i = 0; i < entries_each<Place::RowsAtCompileTime>(); ++i) {
    const auto [a, b] = kProjectionPlanes[i];
    const int sign = Cuts<2>::crossing({0.0, 0.0}, {from[a], from[b]}, {to[a], to[b]});
    if (sign != 0) visit(first_entry + i, sign);
  }
}

template <int D>
const SpaceTimeEnds<D>& checked(const SpaceTimeEnds<D>& ends, double max_speed) {
  const auto require = [](bool condition, const std::string& what) {
    if (!condition) throw std::invalid_argument("SpaceTime: " + what);
  };
  require(ends.start.allFinite() && ends.goal.allFinite(), "an end is not finite");
  require(std::isfinite(ends.start_s) && std::isfinite(ends.goal_s) && ends.start_s < ends.goal_s,
          "goal_s = " + std::to_string(ends.goal_s) +
              ": expected a finite time after start_s = " + std::to_string(ends.start_s));
  require(max_speed > 0.0 && std::isfinite(max_speed),
          "max_speed = " + std::to_string(max_speed) + ": expected a finite value above 0");
  return ends;
}

}  // namespace

template <int D>
SpaceTime<D>::SpaceTime(const ObstacleField<D>& field, const Cuts<D>& cuts, const Box& bounds,
                        const SpaceTimeEnds<D>& ends, double max_speed, std::vector<Tube<D>> tubes,
                        const ClearanceOptions& options)
    : ends_(checked(ends, max_speed)),
      max_speed_(max_speed),
      bounds_(bounds),
      still_(field, cuts, bounds, ends.start, options),
      cuts_(cuts),
      entries_(cuts.obstacles()) {
  for (Tube<D>& tube : tubes) {
    for (TubePiece<D>& piece : tube) {
      piece.start_s -= ends.start_s;
      piece.end_s -= ends.start_s;
    }
    tube = forgiven(tube);
    const std::size_t before = threats_.size();
    std::copy_if(tube.begin(), tube.end(), std::back_inserter(threats_),
                 [this](const TubePiece<D>& piece) { return reachable(piece); });
    if (threats_.size() > before) moving_.push_back({entries_, std::move(tube)});
    entries_ += entries_each<D>();
  }
}

template <int D>
Tube<D> SpaceTime<D>::forgiven(const Tube<D>& tube) const {
  if (tube.empty()) return tube;
  const TubePiece<D>& first = tube.front();
  const double lack_m = first.radius_m - (ends_.start - first.centre).norm() + kSlack_m;
  if (first.start_s > 0.0 || !(lack_m > kSlack_m)) return tube;
  const double rate = kLeaving * max_speed_;
  const double regained_s = lack_m / rate;
  Tube<D> parts;
  for (TubePiece<D> piece : tube) {
    if (piece.start_s < regained_s) {
      TubePiece<D> leaving = piece;
      leaving.end_s = std::min(piece.end_s, regained_s);
      leaving.radius_m -= lack_m - rate * piece.start_s;
      leaving.radius_rate += rate;
      parts.push_back(leaving);
      if (piece.end_s <= regained_s) continue;
      piece.centre = piece.centre_at(regained_s);
      piece.radius_m = piece.radius_at(regained_s);
      piece.start_s = regained_s;
    }
    parts.push_back(piece);
  }
  return parts;
}

/// Grown by what one can drive since the start, or until the goal, it would have to touch the start
/// and the goal. What is not a number counts as reachable.
template <int D>
bool SpaceTime<D>::reachable(const TubePiece<D>& piece) const {
  TubePiece<D> grown = piece;
  grown.radius_m += max_speed_ * piece.start_s;
  grown.radius_rate += max_speed_;
  const double whole_s = duration_s();
  if (least_gap_m<D>(grown, ends_.start, 0.0, ends_.start, whole_s) > 0.0) return false;
  grown.radius_m = piece.radius_m + max_speed_ * (whole_s - piece.start_s);
  grown.radius_rate = piece.radius_rate - max_speed_;
  return !(least_gap_m<D>(grown, ends_.goal, 0.0, ends_.goal, whole_s) > 0.0);
}

template <int D>
auto SpaceTime<D>::point(const Place& place, double time_s) const -> Point {
  Point p;
  p << place, max_speed_ * (time_s - ends_.start_s);
  return p;
}

template <int D>
auto SpaceTime<D>::at(const Point& shares) const -> Point {
  const double apart_m = (ends_.goal - ends_.start).norm();
  const double since_m = shares[D] * max_speed_ * duration_s();
  const double rest_m = max_speed_ * duration_s() - since_m;
  // Where the balls overlap that one can drive from the start and to the goal.
  const double first_m = std::max(-since_m, apart_m - rest_m);
  const double last_m = std::min(since_m, apart_m + rest_m);
  const double along_m = first_m + shares[0] * (last_m - first_m);
  const double off_m = apart_m - along_m;
  const double radius_m = std::sqrt(std::max(
      0.0, std::min(since_m * since_m - along_m * along_m, rest_m * rest_m - off_m * off_m)));
  Place aside = Place::Zero();  // of the line from start to goal, in a frame along it
  aside[0] = along_m;
  if constexpr (D == 2) {
    aside[1] = radius_m * (2.0 * shares[1] - 1.0);
  } else {
    const double angle = 2.0 * M_PI * shares[2];
    aside[1] = radius_m * std::sqrt(shares[1]) * std::cos(angle);
    aside[2] = radius_m * std::sqrt(shares[1]) * std::sin(angle);
  }
  Place place = ends_.start + aside;
  if (apart_m > 0.0) {  // mirrored, so that the first axis points to the goal
    const Place ahead = (ends_.goal - ends_.start) / apart_m;
    const Place normal = Place::UnitX() - ahead;
    const double norm2 = normal.squaredNorm();
    if (norm2 > 0.0) place -= 2.0 * normal.dot(aside) / norm2 * normal;
  }
  Point p;
  p << place, since_m;
  return p;
}

template <int D>
bool SpaceTime<D>::in_order(const Point& p, const Point& q) const {
  const double later_m = q[D] - p[D];
  const double reach_m = (1.0 + kRounding) * later_m;
  return later_m >= kLeastLater_m && (q - p).template head<D>().squaredNorm() <= reach_m * reach_m;
}

template <int D>
std::optional<double> SpaceTime<D>::clearance_m(const Point& p, const Point& q) const {
  const Place from = p.template head<D>();
  const Place to = q.template head<D>();
  if (!bounds_.contains(from) || !bounds_.contains(to)) return std::nullopt;
  const double from_s = since_start_s(p);
  const double to_s = since_start_s(q);
  double least_m = std::numeric_limits<double>::infinity();
  for (const TubePiece<D>& piece : threats_) {
    if (piece.end_s < from_s || piece.start_s > to_s) continue;
    const double gap_m = least_gap_m<D>(piece, from, from_s, to, to_s);
    if (!(gap_m >= 0.0)) return std::nullopt;
    least_m = std::min(least_m, gap_m);
  }
  const auto still_m = still_.clearance_m(from, to);
  return still_m ? std::optional(std::min(*still_m, least_m)) : std::nullopt;
}

template <int D>
template <typename Visit>
void SpaceTime<D>::cross(const Point& p, const Point& q, const Visit& visit) const {
  cuts_.cross(p.template head<D>(), q.template head<D>(), visit);
  for (const Moving& moving : moving_) cross(moving, p, q, visit);
}

/// The relative path bends where one piece of the tube ends and the next starts. Its corners are
/// found by the same sums whichever way they are met, so that none lies on both sides of a cut.
template <int D>
template <typename Visit>
void SpaceTime<D>::cross(const Moving& moving, const Point& p, const Point& q,
                         const Visit& visit) const {
  const double p_s = since_start_s(p);
  const double q_s = since_start_s(q);
  const Place from = p.template head<D>();
  const Place to = q.template head<D>();
  auto piece = moving.tube.begin();
  while (piece != moving.tube.end() && piece->end_s <= p_s) ++piece;
  if (piece == moving.tube.end()) return;
  Place last = from - piece->centre_at(p_s);
  for (; q_s >= piece->end_s; ++piece) {
    const Place there = from + (piece->end_s - p_s) / (q_s - p_s) * (to - from);
    const bool gone = piece + 1 == moving.tube.end();
    const Place centre = gone ? piece->centre_at(piece->end_s) : (piece + 1)->centre;
    cross_origin<Place>(last, there - centre, moving.entry, visit);
    last = there - centre;
    if (gone) return cross_origin<Place>(last, ends_.goal - centre, moving.entry, visit);
  }
  cross_origin<Place>(last, to - piece->centre_at(q_s), moving.entry, visit);
}

template <int D>
SignatureKey SpaceTime<D>::key(const Point& p, const Point& q) const {
  SignatureKey key = 0;
  cross(p, q, [&](int entry, int sign) { key += sign * key_of(entry); });
  return key;
}

template <int D>
Signature SpaceTime<D>::signature_of(const std::vector<Point>& path) const {
  Signature signature(entries_, 0);
  for (std::size_t i = 1; i < path.size(); ++i)
    cross(path[i - 1], path[i], [&](int entry, int sign) { signature[entry] += sign; });
  return signature;
}

template class SpaceTime<2>;
template class SpaceTime<3>;

}  // namespace mocha
