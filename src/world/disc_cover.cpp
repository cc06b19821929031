#include "world/disc_cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr int kDirections = 24;
constexpr int kThirds = 8;
constexpr double kPrecision = 0.1;     // of places, in tolerances
constexpr double kShareOfDepth = 0.5;  // that cells inside may take

double depth_m(const Vector2& p, const Polygon& body) { return -gap(p, body).distance_m; }

/// The body in square cells, fine at the outline and coarse inside, and which of them no disc holds
/// yet. A cell counts as held when one disc holds all of it.
class Cells {
 public:
  Cells(const Polygon& body, double tolerance_m) : body_(body) {
    Eigen::AlignedBox2d box;
    for (const Vector2& corner : body.corners) box.extend(corner);
    const double size_m = box.sizes().maxCoeff();
    finest_m_ = std::clamp(2e-4 * size_m, 0.1 * tolerance_m, 0.2 * tolerance_m);
    double half_m = finest_m_;
    while (half_m < 0.5 * size_m) half_m *= 2.0;
    middle_ = box.center();
    nodes_.push_back({middle_, half_m, 0, 0});
    cut(0);
  }

  int left() const { return nodes_[0].left; }

  /// How many of the cells left the disc holds.
  int count(const CoverDisc& disc, int node = 0) const {
    const Node& here = nodes_[node];
    if (here.left == 0 || is_off(here, disc)) return 0;
    if (is_held(here, disc)) return here.left;
    int sum = 0;
    for (int k = 0; here.children != 0 && k < 4; ++k) sum += count(disc, here.children + k);
    return sum;
  }

  void take(const CoverDisc& disc, int node = 0) {
    Node& here = nodes_[node];
    if (here.left == 0 || is_off(here, disc)) return;
    if (is_held(here, disc)) {
      here.left = 0;
    } else if (here.children != 0) {
      here.left = 0;
      for (int k = here.children; k < here.children + 4; ++k) {
        take(disc, k);
        here.left += nodes_[k].left;
      }
    }
  }

  /// Of the cells left, the one farthest from the middle: the disc around it.
  CoverDisc farthest() const {
    CoverDisc best{middle_, 0.0};
    double best_m = -1.0;
    look(0, best, best_m);
    return best;
  }

 private:
  struct Node {
    Vector2 centre;
    double half_m;
    int children;  // the first of four; 0: none
    int left;      // cells below, or itself
  };

  static double radius_m(const Node& node) { return M_SQRT2 * node.half_m; }
  static bool is_off(const Node& node, const CoverDisc& disc) {
    const double apart_m = disc.radius_m + radius_m(node);
    return (node.centre - disc.offset_m).squaredNorm() > apart_m * apart_m;
  }
  static bool is_held(const Node& node, const CoverDisc& disc) {
    const Vector2 away = (node.centre - disc.offset_m).cwiseAbs();
    return (away.array() + node.half_m).matrix().squaredNorm() <= disc.radius_m * disc.radius_m;
  }

  void cut(int node) {
    const Node here = nodes_[node];
    const double depth = depth_m(here.centre, body_);
    if (depth < -radius_m(here)) return;
    if (here.half_m <= std::max(finest_m_, M_SQRT1_2 * kShareOfDepth * depth)) {
      nodes_[node].left = 1;
      return;
    }
    const int first = static_cast<int>(nodes_.size());
    nodes_[node].children = first;
    const double half_m = 0.5 * here.half_m;
    for (const double x : {-half_m, half_m}) {
      for (const double y : {-half_m, half_m})
        nodes_.push_back({here.centre + Vector2(x, y), half_m, 0, 0});
    }
    for (int k = first; k < first + 4; ++k) {
      cut(k);
      nodes_[node].left += nodes_[k].left;
    }
  }

  void look(int node, CoverDisc& best, double& best_m) const {
    const Node& here = nodes_[node];
    const double away_m = (here.centre - middle_).norm();
    if (here.left == 0 || away_m + radius_m(here) <= best_m) return;
    if (here.children == 0 && away_m > best_m) {
      best_m = away_m;
      best = {here.centre, radius_m(here)};
    }
    for (int k = 0; here.children != 0 && k < 4; ++k) look(here.children + k, best, best_m);
  }

  const Polygon& body_;
  double finest_m_;
  Vector2 middle_;
  std::vector<Node> nodes_;
};

/// The discs that hold a cell and reach no more than the tolerance out of the body.
class DiscsAround {
 public:
  DiscsAround(const Polygon& body, double tolerance_m, const CoverDisc& cell)
      : body_(body), tolerance_m_(tolerance_m), cell_(cell) {
    for (const Vector2& corner : body.corners)
      extent_m_ = std::max(extent_m_, (corner - cell.offset_m).norm());
  }

  /// In each direction the farthest one, and the largest ones.
  std::vector<CoverDisc> all() const {
    constexpr double kStep_rad = 2.0 * M_PI / kDirections;
    std::array<double, kDirections> away_m;
    std::vector<CoverDisc> discs;
    for (int i = 0; i < kDirections; ++i) {
      away_m[i] = farthest_m(i * kStep_rad);
      discs.push_back(disc(i * kStep_rad, away_m[i]));
    }
    for (int i = 0; i < kDirections; ++i) {
      if (away_m[i] < away_m[(i + kDirections - 1) % kDirections]) continue;
      if (away_m[i] < away_m[(i + 1) % kDirections]) continue;
      for (const double side : {-1.0, 1.0})
        discs.push_back(largest_between(i * kStep_rad, (i + side) * kStep_rad));
    }
    return discs;
  }

 private:
  static Vector2 direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

  CoverDisc disc(double angle_rad, double away_m) const {
    const Vector2 centre = cell_.offset_m + away_m * direction(angle_rad);
    return {centre, depth_m(centre, body_) + tolerance_m_};
  }

  CoverDisc largest_between(double first_rad, double last_rad) const {
    for (int i = 0; i < kThirds; ++i) {
      const double third_rad = (last_rad - first_rad) / 3.0;
      const bool later = farthest_m(first_rad + third_rad) < farthest_m(last_rad - third_rad);
      (later ? first_rad : last_rad) += later ? third_rad : -third_rad;
    }
    const double middle_rad = 0.5 * (first_rad + last_rad);
    return disc(middle_rad, farthest_m(middle_rad));
  }

  /// How far off the cell a disc may be centred and still hold it. Its radius grows no faster than
  /// it moves away: from there on, none holds it.
  double farthest_m(double angle_rad) const {
    const Vector2 along = direction(angle_rad);
    double near_m = 0.0;
    double far_m = extent_m_;
    while (far_m - near_m > kPrecision * tolerance_m_) {
      const double middle_m = 0.5 * (near_m + far_m);
      const double radius_m = depth_m(cell_.offset_m + middle_m * along, body_) + tolerance_m_;
      (radius_m >= middle_m + cell_.radius_m ? near_m : far_m) = middle_m;
    }
    return near_m;
  }

  const Polygon& body_;
  double tolerance_m_;
  CoverDisc cell_;
  double extent_m_ = 0.0;
};

}  // namespace

std::vector<CoverDisc> disc_cover(const std::vector<Vector2>& corners, double tolerance_m) {
  const Polygon body{corners};
  Cells cells(body, tolerance_m);
  std::vector<CoverDisc> cover;
  while (cells.left() > 0) {
    CoverDisc best{};
    int most = 0;
    for (const CoverDisc& disc : DiscsAround(body, tolerance_m, cells.farthest()).all()) {
      const int held = cells.count(disc);
      if (held <= most) continue;
      most = held;
      best = disc;
    }
    cells.take(best);
    cover.push_back(best);
  }
  return cover;
}

std::vector<CoverDisc> soft_disc_cover(const std::vector<Vector2>& corners, double tolerance_m) {
  constexpr int kHalvings = 6;
  // Discs that all hold the body when they grow by the tolerance leave out no more than that.
  std::vector<CoverDisc> cover = disc_cover(corners, 2.0 * tolerance_m);
  double too_little_m = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (too_little_m + tolerance_m);
    std::vector<CoverDisc> closer = disc_cover(corners, 2.0 * middle_m);
    const bool is_enough = closer.size() <= cover.size();
    (is_enough ? tolerance_m : too_little_m) = middle_m;
    if (is_enough) cover = std::move(closer);
  }
  for (CoverDisc& disc : cover) disc.radius_m -= tolerance_m;
  return cover;
}

}  // namespace mocha
