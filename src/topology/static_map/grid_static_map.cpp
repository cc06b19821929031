#include "topology/static_map/grid_static_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "topology/roadmaps/map_skeleton.h"

namespace mocha {
namespace {

constexpr double kTile_m = 0.15;   // circles of at most this size, so that narrow paths stay open
constexpr double kRimCells = 1.5;  // matter deeper inside is hidden by that of the rim
constexpr double kJitter_m = 1e-4;
constexpr double kSlackCells = 0.5;  // of a gap: between corners, distances are interpolated
constexpr int kNone = -1;

/// Corners of a map, from the first to before the end.
struct Window {
  int x0, y0, x1, y1;

  Window(const DistanceField& field, const Eigen::AlignedBox2d& box) {
    const auto index = [&](double m, int axis, int corners) {
      const double cells = (m - field.origin()[axis]) / field.resolution_m();
      return static_cast<int>(std::clamp(cells, 0.0, static_cast<double>(corners)));
    };
    x0 = index(box.min().x(), 0, field.columns());
    y0 = index(box.min().y(), 1, field.rows());
    x1 = index(box.max().x() + 1.5 * field.resolution_m(), 0, field.columns());
    y1 = index(box.max().y() + 1.5 * field.resolution_m(), 1, field.rows());
  }
};

/// Numbers the components of what a map's solid matter and the impassable gaps between it make up,
/// as far as a window shows.
class Components {
 public:
  Components(const DistanceField& field, const Window& window, double clearance_m)
      : field_(field),
        window_(window),
        clearance_m_(clearance_m),
        number_(static_cast<std::size_t>(window.x1 - window.x0) * (window.y1 - window.y0), kNone) {
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        if (field.at_corner(x, y) <= 0.0 && number_[index(x, y)] == kNone) spread(x, y);
      }
    }
  }

  /// Of a solid corner.
  int at(int x, int y) const { return number_[index(x, y)]; }
  /// A solid corner of each component.
  const std::vector<Vector2>& representatives() const { return representatives_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * (window_.x1 - window_.x0) + (x - window_.x0);
  }

  /// Whether a robot may come through between two neighbouring corners: no point between them is
  /// farther from solid matter than half of `gap_m`.
  bool passable(int x, int y, int nx, int ny) const {
    const double outside_m = field_.at_corner(x, y) + field_.at_corner(nx, ny);
    const double gap_m = outside_m + (field_.corner(nx, ny) - field_.corner(x, y)).norm();
    const double slack_m = outside_m > 0.0 ? kSlackCells * field_.resolution_m() : 0.0;
    return gap_m >= 2.0 * clearance_m_ - slack_m;
  }

  void spread(int x, int y) {
    const int number = static_cast<int>(representatives_.size());
    number_[index(x, y)] = number;
    front_.assign(1, {x, y});
    std::vector<Vector2> solid;
    while (!front_.empty()) {
      const auto [cx, cy] = front_.back();
      front_.pop_back();
      if (field_.at_corner(cx, cy) <= 0.0) solid.push_back(field_.corner(cx, cy));
      for (int ny = std::max(window_.y0, cy - 1); ny < std::min(window_.y1, cy + 2); ++ny) {
        for (int nx = std::max(window_.x0, cx - 1); nx < std::min(window_.x1, cx + 2); ++nx) {
          if (number_[index(nx, ny)] != kNone || passable(cx, cy, nx, ny)) continue;
          number_[index(nx, ny)] = number;
          front_.push_back({nx, ny});
        }
      }
    }
    representatives_.push_back(innermost(solid));
  }

  /// The one nearest to their mean, so that a path which only touches the rim of the matter is
  /// still classified by the side on which it passes.
  static Vector2 innermost(const std::vector<Vector2>& points) {
    Vector2 mean = Vector2::Zero();
    for (const Vector2& point : points) mean += point / static_cast<double>(points.size());
    return *std::min_element(points.begin(), points.end(), [&](const Vector2& a, const Vector2& b) {
      return (a - mean).squaredNorm() < (b - mean).squaredNorm();
    });
  }

  const DistanceField& field_;
  const Window window_;
  double clearance_m_;
  std::vector<int> number_;
  std::vector<std::pair<int, int>> front_;
  std::vector<Vector2> representatives_;
};

/// A little aside, so that no four circles touch a common one: only slow, exact arithmetic could
/// tell that from nearly touching.
Vector2 off_the_lattice(const Vector2& p) {
  const double angle = 1e3 * (p.x() + M_SQRT2 * p.y());
  return p + kJitter_m * Vector2(std::cos(angle), std::sin(M_SQRT2 * angle));
}

}  // namespace

GridStaticMap::GridStaticMap(std::shared_ptr<const DistanceField> field)
    : field_(std::move(field)),
      bounds_(field_->origin(), field_->corner(field_->columns() - 1, field_->rows() - 1)) {}

GridStaticMap::GridStaticMap(std::shared_ptr<const DistanceField> field, SkeletonTiles tiles)
    : GridStaticMap(std::move(field)) {
  skeleton_ = std::make_shared<MapSkeleton>(field_, std::move(tiles));
}

std::shared_ptr<const MapSkeleton> GridStaticMap::skeleton(const TravelOptions& options) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!skeleton_ || !(skeleton_->options() == options))
    skeleton_ = std::make_shared<MapSkeleton>(
        field_, SkeletonTiles(options, field_->columns(), field_->rows()));
  return skeleton_;
}

std::optional<SkeletonTiles> GridStaticMap::tiles() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return skeleton_ ? std::optional(skeleton_->tiles()) : std::nullopt;
}

std::vector<ObstacleGroup> GridStaticMap::groups_within(const Eigen::AlignedBox2d& box,
                                                        double clearance_m) const {
  const DistanceField& field = *field_;
  const double cell_m = field.resolution_m();
  const Window window(field, box);
  const Components components(field, window, clearance_m);
  std::vector<ObstacleGroup> groups(components.representatives().size());
  for (std::size_t r = 0; r < groups.size(); ++r)
    groups[r].representative = components.representatives()[r];
  const int tile = std::max(1, static_cast<int>(std::lround(kTile_m / cell_m)));
  std::map<int, Eigen::AlignedBox2d> parts;  // of the tile, by component
  for (int y = window.y0; y < window.y1; y += tile) {
    for (int x = window.x0; x < window.x1; x += tile) {
      parts.clear();
      for (int cy = y; cy < std::min(y + tile, window.y1); ++cy) {
        for (int cx = x; cx < std::min(x + tile, window.x1); ++cx) {
          const double distance_m = field.at_corner(cx, cy);
          if (distance_m > 0.0 || distance_m < -kRimCells * cell_m) continue;
          parts[components.at(cx, cy)].extend(field.corner(cx, cy));
        }
      }
      for (const auto& [component, box] : parts) {
        groups[component].cover.push_back(
            {off_the_lattice(box.center()), 0.5 * box.diagonal().norm()});
      }
    }
  }
  return groups;
}

}  // namespace mocha
