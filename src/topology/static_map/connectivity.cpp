#include "topology/static_map/connectivity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mocha {

Connectivity::Connectivity(const DistanceField& field, double clearance_m)
    : origin_(field.origin()), resolution_m_(field.resolution_m()) {
  UnionFind sets;  // of runs
  rows_.reserve(field.rows() + 1);
  rows_.push_back(0);
  for (int y = 0; y < field.rows(); ++y) add_row(field, y, static_cast<float>(clearance_m), sets);
  for (int i = 0; i < sets.size(); ++i) runs_[i].component = sets.root(i);
}

void Connectivity::add_row(const DistanceField& field, int y, float least_m, UnionFind& sets) {
  int before = y > 0 ? rows_[y - 1] : 0;
  const int begin = rows_[y];
  for (int x = 0; x < field.columns();) {
    if (field.at_corner(x, y) < least_m) {
      ++x;
      continue;
    }
    const int run = sets.size();
    sets.add();
    const int first = x;
    while (x < field.columns() && field.at_corner(x, y) >= least_m) ++x;
    runs_.push_back({first, x - 1, run});
    // Those below that end left of this one touch no later one, either.
    while (before < begin && runs_[before].last < first - 1) ++before;
    for (int i = before; i < begin && runs_[i].first <= x; ++i) sets.join(i, run);
  }
  rows_.push_back(static_cast<int>(runs_.size()));
}

std::vector<int> Connectivity::components_at(const Vector2& place) const {
  std::vector<int> components;
  const Vector2 at = (place - origin_) / resolution_m_;
  const int rows = static_cast<int>(rows_.size()) - 1;
  if (!(at.minCoeff() >= 0.0 && at.y() < rows && at.x() < std::numeric_limits<int>::max()))
    return components;
  const int x = static_cast<int>(at.x());
  for (int y = static_cast<int>(at.y()); y <= std::min(static_cast<int>(at.y()) + 1, rows - 1);
       ++y) {
    const auto end = runs_.begin() + rows_[y + 1];
    auto run = std::partition_point(runs_.begin() + rows_[y], end,
                                    [&](const Run& each) { return each.last < x; });
    for (; run != end && run->first <= x + 1; ++run) components.push_back(run->component);
  }
  return components;
}

bool Connectivity::connects(const Vector2& a, const Vector2& b) const {
  const std::vector<int> there = components_at(b);
  const std::vector<int> here = components_at(a);
  return std::find_first_of(here.begin(), here.end(), there.begin(), there.end()) != here.end();
}

std::optional<Vector2> Connectivity::nearest(const Vector2& from, const Vector2& to) const {
  const std::vector<int> here = components_at(from);
  const Vector2 at = (to - origin_) / resolution_m_;
  std::optional<Vector2> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int y = 0; y + 1 < static_cast<int>(rows_.size()); ++y) {
    for (int i = rows_[y]; i < rows_[y + 1]; ++i) {
      const Run& run = runs_[i];
      if (std::find(here.begin(), here.end(), run.component) == here.end()) continue;
      const Vector2 corner(std::clamp<double>(std::round(at.x()), run.first, run.last), y);
      const double squared = (corner - at).squaredNorm();
      if (squared >= least) continue;
      least = squared;
      nearest = origin_ + resolution_m_ * corner;
    }
  }
  return nearest;
}

}  // namespace mocha
