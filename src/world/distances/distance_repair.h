#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/corner_window.h"

namespace mocha {

/// Brings the exact distances of a lattice up to date where few of its sites come or go, at the
/// cost of what is around those: only corners that a site which goes may have been nearest to look
/// for another, and not nearer than before.
///
/// Distances are signed [m], row by row. On the side +1, the sites are the corners with values that
/// are not positive, and distances to them are the positive values; on the side -1, the other way
/// round.
///
/// Work is counted in corners that are looked at. Where it is used up, remove() and add() return
/// false, and the distances are good for nothing.
class DistanceRepair {
 public:
  DistanceRepair(std::vector<float>& signed_m, int columns, int rows, float step_m, int side,
                 std::int64_t most_work);

  /// These are no sites any more; all of them were.
  bool remove(const std::vector<Eigen::Vector2i>& sites);

  /// These are sites now; none of them was. To be called after remove().
  bool add(const std::vector<Eigen::Vector2i>& sites);

  bool used_up() const { return work_left_ < 0; }

  /// Windows that hold all corners whose distances have changed so far; none of them is wide.
  const std::vector<CornerWindow>& touched() const { return touched_; }

 private:
  struct Affected {
    Eigen::Vector2i corner;
    Eigen::Vector2i lost;  // site
    double squared;        // of its distance before [steps^2]
  };

  float& at(int x, int y) { return signed_m_[static_cast<std::size_t>(y) * columns_ + x]; }
  float distance_m(int x, int y) const {
    return std::max(0.0f, side_ * signed_m_[static_cast<std::size_t>(y) * columns_ + x]);
  }
  bool is_site(int x, int y) const { return all_.holds(x, y) && distance_m(x, y) == 0.0f; }
  template <typename Visit>
  bool visit_cell(const Eigen::Vector2i& site, const Visit& visit);
  bool lose(const Eigen::Vector2i& site);
  double bound(const Affected& affected) const;
  double nearest(const Affected& affected);
  void touch(int x, int y);

  std::vector<float>& signed_m_;
  const int columns_;
  const CornerWindow all_;
  const float step_m_;
  const float side_;
  std::int64_t work_left_;
  std::vector<Affected> affected_;
  std::vector<CornerWindow> touched_;
  std::vector<int> touched_of_tile_;  // index into it, or -1
};

}  // namespace mocha
