#include "topology/signatures/h_signature.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

/// Twice the area of the triangle a, b, c in the ground plane; positive where they turn left.
double turn(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Whether points on the line from a to b come to be left of it when they are shifted a little
/// towards +x, and far less than that towards +y.
bool leftward(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return b.y() < a.y() || (b.y() == a.y() && b.x() > a.x());
}

bool is_left(double turn, bool if_on_line) { return turn > 0.0 || (turn == 0.0 && if_on_line); }

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

Cuts<2>::Cuts(const std::vector<Point>& representatives) {
  for (const Point& foot : representatives) rays_.push_back({foot, static_cast<int>(rays_.size())});
  std::stable_sort(rays_.begin(), rays_.end(),
                   [](const Ray& a, const Ray& b) { return a.foot.x() < b.foot.x(); });
}

Cuts<3>::Cuts(const std::vector<Curve>& curves)
    : obstacles_(static_cast<int>(curves.size())), columns_(feet_of(curves)) {
  for (int r = 0; r < obstacles_; ++r) {
    if (const auto* loop = std::get_if<Loop>(&curves[r])) {
      add_sides(loop->corners, 3, true, r);
    } else if (const auto* arch = std::get_if<Arch>(&curves[r])) {
      add_sides(arch->corners, 2, false, r);
    } else {
      column_obstacles_.push_back(r);
    }
  }
  std::stable_sort(sides_.begin(), sides_.end(),
                   [](const Side& a, const Side& b) { return a.low.x() < b.low.x(); });
  for (std::size_t i = 1; i < sides_.size(); ++i)
    sides_[i].reach_x = std::max(sides_[i].reach_x, sides_[i - 1].reach_x);
}

void Cuts<3>::add_sides(const std::vector<Point>& corners, std::size_t least, bool is_closed,
                        int obstacle) {
  if (corners.size() < least) {
    throw std::invalid_argument(std::string(is_closed ? "loop" : "arch") +
                                ": corners = " + std::to_string(corners.size()) + ", at least " +
                                std::to_string(least));
  }
  for (std::size_t i = 1; i < corners.size(); ++i) add_side(corners[i - 1], corners[i], obstacle);
  if (is_closed) add_side(corners.back(), corners.front(), obstacle);
}

void Cuts<3>::add_side(const Point& from, const Point& to, int obstacle) {
  const Point a = snapped(from);
  const Point b = snapped(to);
  const Point high = a.cwiseMax(b);
  sides_.push_back({a.cwiseMin(b), high.x(), high.y(), high.x(), a, b, obstacle});
}

/// To a grid so coarse that turns of points up to 500 m from the origin are exact.
Cuts<3>::Point Cuts<3>::snapped(const Point& p) {
  constexpr double kPerMetre = 65536.0;
  return {std::round(p.x() * kPerMetre) / kPerMetre, std::round(p.y() * kPerMetre) / kPerMetre,
          p.z()};
}

int Cuts<3>::crossing(const Side& side, const Point& p, const Point& q) {
  // Seen from above, the way is to cross the side. Where points lie on lines, the way counts as
  // shifted a little: the same shift for all, so that neighbours share corners without gap or
  // overlap, and too little to move a closed path across a curve.
  const bool left_of_side = leftward(side.from, side.to);
  const double p_turn = turn(side.from, side.to, p);
  const double q_turn = turn(side.from, side.to, q);
  const bool q_left = is_left(q_turn, left_of_side);
  if (is_left(p_turn, left_of_side) == q_left) return 0;
  const bool left_of_way = leftward(q, p);  // seen from the way, the side is shifted back
  const double from_turn = turn(p, q, side.from);
  const double to_turn = turn(p, q, side.to);
  if (is_left(from_turn, left_of_way) == is_left(to_turn, left_of_way)) return 0;
  // Where they cross, the way is to be above the side.
  const double way_z = p.z() + (q.z() - p.z()) * p_turn / (p_turn - q_turn);
  const double side_z =
      side.from.z() + (side.to.z() - side.from.z()) * from_turn / (from_turn - to_turn);
  if (way_z <= side_z) return 0;
  return q_left ? -1 : 1;
}

}  // namespace mocha
