#pragma once

#include <type_traits>
#include <vector>

#include "world/obstacle.h"
#include "world/obstacle_field.h"

namespace mocha {

/// Analytic obstacles: circles and polygons in the plane, upright cylinders in space. All distances
/// are signed, exact and without a map's cells; gradients are unit vectors everywhere.
///
/// A uniform grid over x and y lists in each cell what is near, nearest first, so that a question
/// about a place looks at few primitives. Without primitives the distance is infinite and the
/// gradient zero. At a point that is not finite the sample is not a number and the distance bound
/// is 0.
template <int D>
class PrimitiveField : public ObstacleField<D> {
 public:
  using Primitive = std::conditional_t<D == 2, Obstacle, Cylinder>;
  using typename ObstacleField<D>::Vector;
  using typename ObstacleField<D>::Box;
  using typename ObstacleField<D>::Sample;
  using typename ObstacleField<D>::Visitor;

  /// `reach_m` > 0 is the largest radius that is often asked about. Answers are as right beyond it,
  /// but slower: from twice that radius on, or the mean spacing of the primitives if that is more,
  /// every primitive is looked at. Throws std::invalid_argument for another reach, negative radii,
  /// values that are not numbers or beyond 1e12 m, and polygons with a fault.
  PrimitiveField(std::vector<Primitive> primitives, double reach_m);

  Sample sample(const Vector& p) const override;
  void visit_near(const Vector& p, double radius_m, Visitor visit) const override;
  double distance_bound(const Vector& p) const override;  ///< exact
  double room(const Vector& p, double radius_m) const override;
  bool clear(const Box& box, double radius_m) const override;  ///< exact

  const std::vector<Primitive>& primitives() const { return primitives_; }

 private:
  struct Entry {
    double bound_m;  ///< least distance between the primitive and the cell, at least 0
    int primitive;
  };
  struct List {
    const Entry* first;
    const Entry* last;
    const Entry* begin() const { return first; }
    const Entry* end() const { return last; }
  };

  bool fill(const Eigen::AlignedBox2d& ground, double cell_m);
  Box cell_box(int column, int row) const;
  /// What is within listed_m_ of the cell that holds p, nearest to the cell first; nothing for a p
  /// outside of the grid, which is farther than that from everything.
  List listed(const Vector& p) const {
    const double x = (p.x() - origin_.x()) * cells_per_m_;
    const double y = (p.y() - origin_.y()) * cells_per_m_;
    if (!(x >= 0.0 && x < columns_ && y >= 0.0 && y < rows_)) return {nullptr, nullptr};
    const int* start = &starts_[static_cast<int>(y) * columns_ + static_cast<int>(x)];
    return {entries_.data() + start[0], entries_.data() + start[1]};
  }

  std::vector<Primitive> primitives_;
  double listed_m_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double cell_m_ = 1.0;
  double cells_per_m_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> starts_;  // of each cell's entries, and the end of the last
  std::vector<Entry> entries_;
};

extern template class PrimitiveField<2>;
extern template class PrimitiveField<3>;

}  // namespace mocha
