#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "perception/sensor/beam.h"

namespace mocha {

using VoxelIndex = std::array<int, 3>;  ///< voxel i spans [i, i + 1) cell edges along each axis

/// A box of voxels, both corners included.
struct VoxelBox {
  VoxelIndex low;
  VoxelIndex high;
};

/// A beam in units of voxel edges.
struct GridBeam {
  Vector3 origin;
  Vector3 end;
  BeamEnd kind;
};

/// The voxels that the beams of one scan touch: each counts once per scan however many beams pass
/// it, and a hit outweighs all that pass.
class BeamRaster {
 public:
  /// Empties the raster and lays it over a box. Throws MapError if that is too large to be a scan.
  void reset(const VoxelBox& box);

  /// Adds a beam that lies in the box.
  void add(const GridBeam& beam);

  /// Calls visit(index, hit) for every voxel touched, row by row.
  template <class Visit>
  void for_each(Visit visit) const {
    VoxelIndex at;
    for (at[2] = box_.low[2]; at[2] <= box_.high[2]; ++at[2]) {
      for (at[1] = box_.low[1]; at[1] <= box_.high[1]; ++at[1]) {
        const std::uint8_t* marks = &marks_[offset({box_.low[0], at[1], at[2]})];
        for (at[0] = box_.low[0]; at[0] <= box_.high[0]; ++at[0], ++marks) {
          if (*marks != 0) visit(at, (*marks & kHit) != 0);
        }
      }
    }
  }

 private:
  static constexpr std::uint8_t kFree = 1;
  static constexpr std::uint8_t kHit = 2;

  std::ptrdiff_t offset(const VoxelIndex& voxel) const {
    return first_ + voxel[0] + voxel[1] * strides_[1] + voxel[2] * strides_[2];
  }

  VoxelBox box_{};
  std::ptrdiff_t first_ = 0;  // where voxel (0, 0, 0) would be
  std::array<std::ptrdiff_t, 3> strides_{};
  std::vector<std::uint8_t> marks_;  // of the box and one voxel around it
};

}  // namespace mocha
