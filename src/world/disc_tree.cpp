#include "world/disc_tree.h"

#include <Eigen/Geometry>
#include <utility>

namespace mocha {
namespace {

using Iterator = std::vector<CoverDisc>::iterator;

/// A disc around others, nearly the smallest: it moves towards whatever reaches farthest, by less
/// and less.
CoverDisc disc_around(Iterator begin, Iterator end) {
  constexpr int kSteps = 200;
  CoverDisc around = *begin;
  const auto reach_m = [&](const CoverDisc& disc) {
    return (disc.offset_m - around.offset_m).norm() + disc.radius_m;
  };
  const auto nearer = [&](const CoverDisc& a, const CoverDisc& b) {
    return reach_m(a) < reach_m(b);
  };
  for (int i = 1; i <= kSteps; ++i) {
    const CoverDisc& farthest = *std::max_element(begin, end, nearer);
    around.offset_m += (farthest.offset_m - around.offset_m) / (i + 1);
  }
  around.radius_m = reach_m(*std::max_element(begin, end, nearer));
  return around;
}

}  // namespace

DiscTree::DiscTree(std::vector<CoverDisc> discs, double reach_m) : discs_(std::move(discs)) {
  if (discs_.size() == 1)
    add(discs_.front(), discs_.begin(), discs_.end());
  else
    add({Vector2::Zero(), reach_m}, discs_.begin(), discs_.end());
}

void DiscTree::add(const CoverDisc& around, Iterator begin, Iterator end) {
  const std::size_t own = nodes_.size();
  nodes_.push_back({around, around.offset_m.norm(), 0});
  if (end - begin > 1) {
    Eigen::AlignedBox2d centres;
    for (auto disc = begin; disc != end; ++disc) centres.extend(disc->offset_m);
    const int axis = centres.sizes().x() < centres.sizes().y() ? 1 : 0;
    std::sort(begin, end, [axis](const CoverDisc& a, const CoverDisc& b) {
      return a.offset_m[axis] < b.offset_m[axis];
    });
    const auto middle = begin + (end - begin) / 2;
    add(disc_around(begin, middle), begin, middle);
    add(disc_around(middle, end), middle, end);
  }
  nodes_[own].next = static_cast<int>(nodes_.size());
}

}  // namespace mocha
