#pragma once

#include <Eigen/Core>
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
class DistanceRepair {
 public:
  DistanceRepair(std::vector<float>& signed_m, int columns, int rows, float step_m, int side);

  /// These are no sites any more; all of them were. False where so much depends on them that all is
  /// better made anew; distances around them are spoilt then.
  bool remove(const std::vector<Eigen::Vector2i>& sites);

  /// These are sites now; none of them was. To be called after remove().
  void add(const std::vector<Eigen::Vector2i>& sites);

  /// Windows that hold all corners whose distances have changed; none of them is wide.
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
  void visit_cell(const Eigen::Vector2i& site, const Visit& visit);
  bool lose(const Eigen::Vector2i& site);
  double bound(const Affected& affected) const;
  double nearest(const Affected& affected) const;
  void touch(int x, int y);

  std::vector<float>& signed_m_;
  const int columns_;
  const CornerWindow all_;
  const float step_m_;
  const float side_;
  std::vector<Affected> affected_;
  std::vector<CornerWindow> touched_;
};

}  // namespace mocha
