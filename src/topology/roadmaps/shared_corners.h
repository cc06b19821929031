#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace mocha {

/// The corners of a polyline. They never change, so copies share them.
template <typename Point>
class SharedCorners {
 public:
  using Points = std::vector<Point>;

  /// None.
  SharedCorners() = default;
  SharedCorners(Points points)  // NOLINT: a list of points is one
      : points_(points.empty() ? nullptr : std::make_shared<const Points>(std::move(points))) {}

  const Points& points() const {
    static const Points kNone;
    return points_ ? *points_ : kNone;
  }

  bool empty() const { return !points_; }
  auto begin() const { return points().begin(); }
  auto end() const { return points().end(); }
  auto rbegin() const { return points().rbegin(); }
  auto rend() const { return points().rend(); }

  bool operator==(const SharedCorners& other) const {
    return points_ == other.points_ || points() == other.points();
  }

 private:
  std::shared_ptr<const Points> points_;
};

}  // namespace mocha
