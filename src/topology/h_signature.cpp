#include "topology/h_signature.h"

#include <numeric>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

/// Twice the area of the triangle a, b, c in the ground plane; positive where they turn left.
double turn(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

std::vector<Eigen::Vector2d> feet_of(const std::vector<Cuts<3>::Curve>& curves) {
  std::vector<Eigen::Vector2d> feet;
  for (const auto& curve : curves) {
    if (const auto* column = std::get_if<Column>(&curve)) feet.push_back(column->foot);
  }
  return feet;
}

}  // namespace

SignatureKey key_of(int obstacle) {
  // The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
  SignatureKey z = (static_cast<SignatureKey>(obstacle) + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

template <>
Cuts<2>::Cuts(const std::vector<Point>& representatives) {
  for (const Point& foot : representatives) rays_.push_back({foot, static_cast<int>(rays_.size())});
  std::stable_sort(rays_.begin(), rays_.end(),
                   [](const Ray& a, const Ray& b) { return a.foot.x() < b.foot.x(); });
}

Cuts<3>::Cuts(const std::vector<Curve>& curves)
    : obstacles_(static_cast<int>(curves.size())), columns_(feet_of(curves)) {
  for (int r = 0; r < obstacles_; ++r) {
    const auto* loop = std::get_if<Loop>(&curves[r]);
    if (loop == nullptr) {
      column_obstacles_.push_back(r);
      continue;
    }
    const std::size_t corners = loop->corners.size();
    if (corners < 3) {
      throw std::invalid_argument("loop: corners = " + std::to_string(corners) + ", at least 3");
    }
    for (std::size_t i = 0; i < corners; ++i) {
      sides_.push_back({loop->corners[i], loop->corners[(i + 1) % corners], r});
    }
  }
}

int Cuts<3>::crossing(const Side& side, const Point& p, const Point& q) {
  // Seen from above, the way crosses the side; a point on a line counts as left of it, for the way
  // as for the side, so that neighbours share corners without gap or overlap.
  const bool p_left = turn(side.from, side.to, p) >= 0.0;
  const bool q_left = turn(side.from, side.to, q) >= 0.0;
  if (p_left == q_left) return 0;
  const double from_turn = turn(p, q, side.from);
  const double to_turn = turn(p, q, side.to);
  if ((from_turn >= 0.0) == (to_turn >= 0.0)) return 0;
  // Where they cross, the way is to be above the side.
  const double p_turn = turn(side.from, side.to, p);
  const double q_turn = turn(side.from, side.to, q);
  const double way_z = p.z() + (q.z() - p.z()) * p_turn / (p_turn - q_turn);
  const double side_z =
      side.from.z() + (side.to.z() - side.from.z()) * from_turn / (from_turn - to_turn);
  if (way_z <= side_z) return 0;
  return q_left ? -1 : 1;
}

}  // namespace mocha
