#include "topology/paths/taut_path.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr int kSweeps = 20;            // over all corners, at most
constexpr int kHalvings = 4;           // of a pull that meets something
constexpr double kWorthASweep = 1e-3;  // of the spacing of corners: a sweep that moved none farther

class CornerPuller {
 public:
  explicit CornerPuller(const SampledSpace<3>& space) : space_(space) {}

  /// Moves the corner `p` between `before` and `after`; returns how far.
  double pull(const Eigen::Vector3d& before, Eigen::Vector3d& p,
              const Eigen::Vector3d& after) const {
    const Eigen::Vector3d from = p;
    for (const Eigen::Vector3d& axes : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 0, 0),
                                        Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
      const Eigen::Vector3d chord = after - before;
      const double length2 = chord.squaredNorm();
      if (!(length2 > 0.0)) break;
      const double share = std::clamp(chord.dot(p - before) / length2, 0.0, 1.0);
      Eigen::Vector3d step = (before + share * chord - p).cwiseProduct(axes);
      for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
        if (!may_be_at(before, p, p + step, after)) continue;
        p += step;
        break;
      }
    }
    return (p - from).norm();
  }

 private:
  bool may_be_at(const Eigen::Vector3d& before, const Eigen::Vector3d& p,
                 const Eigen::Vector3d& next, const Eigen::Vector3d& after) const {
    return space_.clearance_m(before, next) && space_.clearance_m(next, after) &&
           space_.key(before, next) + space_.key(next, after) ==
               space_.key(before, p) + space_.key(p, after);
  }

  const SampledSpace<3>& space_;
};

}  // namespace

std::vector<Eigen::Vector3d> pulled_taut(std::vector<Eigen::Vector3d> path,
                                         const SampledSpace<3>& space) {
  const CornerPuller puller(space);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool has_moved = false;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      const double spacing_m = (path[i + 1] - path[i - 1]).norm();
      has_moved |= puller.pull(path[i - 1], path[i], path[i + 1]) > kWorthASweep * spacing_m;
    }
    if (!has_moved) break;
  }
  return path;
}

}  // namespace mocha
