#include "perception/mapping/resampling.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kRounding = 1e-6;  // of a cell

struct Span {
  int first;
  int last;

  template <class Visit>
  void for_each(Visit visit) const {
    for (int i = first; i <= last; ++i) visit(i);
  }
};

/// The cells that overlap the cell i of another size, along an axis; `ratio`: that size to theirs.
Span overlapping(int i, double ratio) {
  return {static_cast<int>(std::floor(i * ratio + kRounding)),
          static_cast<int>(std::ceil((i + 1) * ratio - kRounding)) - 1};
}

class Resampling {
 public:
  Resampling(const VoxelBand& from, VoxelBand& to)
      : from_(from), to_(to), ratio_(from.resolution_m / to.resolution_m) {}

  void run() {
    const CornerWindow& known = from_.columns.known();
    if (known.empty()) return;
    to_.columns.reserve(
        {overlapping(known.x0, ratio_).first, overlapping(known.y0, ratio_).first, 0},
        {overlapping(known.x1, ratio_).last, overlapping(known.y1, ratio_).last, 0});
    for (const bool occupied : {true, false}) {
      from_.columns.for_each_known([&](const VoxelIndex& voxel, float log_odds) {
        if (ColumnGrid::is_occupied(log_odds) == occupied) copy(voxel, log_odds);
      });
    }
  }

 private:
  void copy(const VoxelIndex& voxel, float log_odds) {
    const Span layers = layers_of(voxel[2]);
    overlapping(voxel[1], ratio_).for_each([&](int y) {
      overlapping(voxel[0], ratio_).for_each([&](int x) {
        if (!ColumnGrid::is_occupied(log_odds) && !is_known(x, y, voxel[2])) return;
        layers.for_each([&](int z) {
          const float there = to_.columns.log_odds({x, y, z});
          to_.columns.set({x, y, z}, std::isnan(there) ? log_odds : std::max(there, log_odds));
        });
      });
    });
  }

  Span layers_of(int layer) const {
    if (layer == from_.scan_layer) return {to_.scan_layer, to_.scan_layer};
    const int lowest = to_.columns.first_layer();
    const int highest = to_.columns.last_layer();
    const Span all = overlapping(layer, ratio_);
    return {std::clamp(all.first, lowest, highest), std::clamp(all.last, lowest, highest)};
  }

  /// All that a new cell covers in a layer of the old ones.
  bool is_known(int x, int y, int layer) const {
    const Span rows = overlapping(y, 1.0 / ratio_);
    const Span columns = overlapping(x, 1.0 / ratio_);
    for (int j = rows.first; j <= rows.last; ++j) {
      for (int i = columns.first; i <= columns.last; ++i) {
        if (std::isnan(from_.columns.log_odds({i, j, layer}))) return false;
      }
    }
    return true;
  }

  const VoxelBand& from_;
  VoxelBand& to_;
  const double ratio_;
};

}  // namespace

void resample(const VoxelBand& from, VoxelBand& to) { Resampling(from, to).run(); }

}  // namespace mocha
