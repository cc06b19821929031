#include "topology/roadmaps/static_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace mocha {
namespace {

// Paths that come closer than this to what is required count as too close, so that a search of
// their nearest place ends.
constexpr double kLeastStep_m = 1e-3;

void check(const char* name, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  throw std::invalid_argument(std::string("ClearanceOptions: ") + name + " = " +
                              std::to_string(value) + ": expected a finite value of at least 0");
}

/// The shares of the way from p to q between which it is inside of the ball; equal ones if it never
/// is.
template <typename Point>
std::pair<double, double> part_inside(const Point& p, const Point& q, const Point& centre,
                                      double radius_m) {
  const Point along = q - p;
  const double length2 = along.squaredNorm();
  if (length2 == 0.0) return {0.0, (p - centre).norm() < radius_m ? 1.0 : 0.0};
  const double middle = along.dot(centre - p) / length2;
  const double off2 = (p + middle * along - centre).squaredNorm();
  const double half = std::sqrt(std::max(0.0, (radius_m * radius_m - off2) / length2));
  return {std::clamp(middle - half, 0.0, 1.0), std::clamp(middle + half, 0.0, 1.0)};
}

}  // namespace

template <int D>
StaticSpace<D>::StaticSpace(const ObstacleField<D>& field, const Cuts<D>& cuts, const Box& bounds,
                            const Point& start, const ClearanceOptions& options)
    : field_(field), cuts_(cuts), bounds_(bounds), start_(start), options_(options) {
  check("required_m", options.required_m);
  check("escape_radius_m", options.escape_radius_m);
  const double start_m = field.distance_bound(start);
  escape_m_ = std::min(options.required_m, std::max(0.5 * start_m, start_m - 2.0 * kLeastStep_m));
}

template <int D>
auto StaticSpace<D>::at(const Point& shares) const -> Point {
  return bounds_.min() + shares.cwiseProduct(bounds_.sizes());
}

template <int D>
std::optional<double> StaticSpace<D>::clearance_m(const Point& p) const {
  return clearance_m(p, p);
}

template <int D>
std::optional<double> StaticSpace<D>::clearance_m(const Point& p, const Point& q) const {
  if (escape_m_ >= options_.required_m) return traced(p, q, options_.required_m);
  const auto [from, to] = part_inside(p, q, start_, options_.escape_radius_m);
  if (!(from < to)) return traced(p, q, options_.required_m);
  const Point inward = p + from * (q - p);
  const Point outward = p + to * (q - p);
  auto least = traced(inward, outward, escape_m_);
  const auto include = [&](const Point& a, const Point& b) {
    if (!least) return;
    const auto part = traced(a, b, options_.required_m);
    least = part ? std::optional(std::min(*least, *part)) : std::nullopt;
  };
  if (from > 0.0) include(p, inward);
  if (to < 1.0) include(outward, q);
  return least;
}

/// Sphere tracing from the middle, where a path that is blocked is found out soonest: around each
/// place that is looked at, a part of the way is done that is half as long, to both sides, as the
/// distance to obstacles would let it, so that half of what is beyond the required clearance is
/// proved.
template <int D>
std::optional<double> StaticSpace<D>::traced(const Point& p, const Point& q,
                                             double required_m) const {
  const Point middle = 0.5 * (p + q);
  const double distance_m = field_.distance_bound(middle);
  if (!(distance_m > 0.0 && distance_m >= required_m)) return std::nullopt;
  const double half_m = 0.5 * (q - p).norm();
  const double done_m = 0.5 * (distance_m - required_m);
  if (half_m <= done_m) return distance_m - half_m;
  if (!(done_m >= 0.5 * kLeastStep_m) || !std::isfinite(half_m)) return std::nullopt;
  const Point aside = done_m / half_m * 0.5 * (q - p);
  const auto first = traced(p, middle - aside, required_m);
  if (!first) return std::nullopt;
  const auto second = traced(middle + aside, q, required_m);
  if (!second) return std::nullopt;
  return std::min({distance_m - done_m, *first, *second});
}

template class StaticSpace<2>;
template class StaticSpace<3>;

}  // namespace mocha
