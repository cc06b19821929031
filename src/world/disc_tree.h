#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "world/disc_cover.h"

namespace mocha {

/// Discs that move with a body, under discs that hold several of them: a question about all is
/// often answered by the few of those.
class DiscTree {
 public:
  struct Node : CoverDisc {
    double arm_m;  ///< of the centre about the base
    int next;      ///< the node after all that is under this one
  };

  DiscTree() = default;
  /// Over at least one disc, all of them within `reach_m` about the base.
  DiscTree(std::vector<CoverDisc> discs, double reach_m);

  const std::vector<CoverDisc>& discs() const { return discs_; }

  /// Whether `holds(node)` for all discs. What holds for a disc has to hold for every disc inside.
  template <typename Holds>
  bool all(const Holds& holds) const {
    const int count = static_cast<int>(nodes_.size());
    for (int i = 0; i < count;) {
      const bool skip = holds(nodes_[i]);
      if (!skip && nodes_[i].next == i + 1) return false;
      i = skip ? nodes_[i].next : i + 1;
    }
    return true;
  }

  /// The least `value(node)` of the discs, where that of a disc is at least that of one around it.
  template <typename Value>
  double least(const Value& value) const {
    double least = std::numeric_limits<double>::infinity();
    all([&](const Node& node) {
      const double here = value(node);
      if (is_disc(node)) least = std::min(least, here);
      return is_disc(node) || here >= least;
    });
    return least;
  }

 private:
  bool is_disc(const Node& node) const { return node.next == 1 + (&node - nodes_.data()); }
  void add(const CoverDisc& around, std::vector<CoverDisc>::iterator begin,
           std::vector<CoverDisc>::iterator end);

  std::vector<CoverDisc> discs_;
  std::vector<Node> nodes_;  // each before those under it
};

}  // namespace mocha
