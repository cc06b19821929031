#pragma once

#include <utility>
#include <vector>

#include "world/corner_window.h"
#include "world/distances/distance_field.h"

namespace mocha {

/// What hangs together of a map's solid matter and of the gaps in it that a robot cannot pass,
/// whose centre keeps a clearance, as far as a window shows.
class ObstacleComponents {
 public:
  static constexpr int kNone = -1;

  /// Which ones are numbered: those that have solid matter, or also those that are all gap.
  enum class Kind { kSolid, kAny };

  ObstacleComponents(const DistanceField& field, const CornerWindow& window, double clearance_m,
                     Kind kind);

  int size() const { return static_cast<int>(solid_.size()); }
  /// The number of the component that has a corner of the window, or kNone.
  int at(int x, int y) const { return number_[index(x, y)]; }
  /// The corners of a component that are solid matter.
  const std::vector<Vector2>& solid(int component) const { return solid_[component]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * window_.columns() + (x - window_.x0);
  }
  bool passable(int x, int y, int nx, int ny) const;
  void flood(int x, int y);

  const DistanceField& field_;
  const CornerWindow window_;
  const double least_gap_m_;
  std::vector<int> number_;  // of each corner
  std::vector<std::vector<Vector2>> solid_;
  std::vector<std::pair<int, int>> front_;
};

/// That one of some points, at least one, which is nearest to a place.
const Vector2& nearest_to(const Vector2& place, const std::vector<Vector2>& points);

}  // namespace mocha
