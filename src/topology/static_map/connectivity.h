#pragma once

#include <optional>
#include <vector>

#include "topology/static_map/union_find.h"
#include "world/distances/distance_field.h"

namespace mocha {

/// Which places of a map are connected for a point that keeps a clearance: the connected components
/// of the corners of its cells with so much of it, eight neighbours each, as runs along the rows.
/// A path that keeps so much clearance, and half the diagonal of a cell beside it, stays in one
/// component. Takes one pass over the map.
class Connectivity {
 public:
  /// `clearance_m` >= 0.
  Connectivity(const DistanceField& field, double clearance_m);

  /// Whether a corner of the cell of `a` is connected with one of the cell of `b`. Never where
  /// either place has no such corner, or is outside the map.
  bool connects(const Vector2& a, const Vector2& b) const;

  /// Whether any corner of the cell of a place has the clearance.
  bool holds(const Vector2& place) const { return !components_at(place).empty(); }

  /// The corner nearest to `to` of those that are connected with the cell of `from`.
  std::optional<Vector2> nearest(const Vector2& from, const Vector2& to) const;

 private:
  struct Run {
    int first;  // columns
    int last;
    int component;  // one of its runs, which stands for all
  };

  void add_row(const DistanceField& field, int y, float least_m, UnionFind& sets);
  std::vector<int> components_at(const Vector2& place) const;

  Vector2 origin_;
  double resolution_m_;
  std::vector<Run> runs_;
  std::vector<int> rows_;  // the first run of each row, and one more
};

}  // namespace mocha
