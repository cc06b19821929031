#pragma once

#include <cmath>

#include "perception/mapping/beam_raster.h"
#include "trajectory/motion.h"

namespace mocha {

/// The cells that a disc may touch, in cell indices.
struct CellDisc {
  CellDisc(const Vector2& centre_m, double radius_m, double resolution_m)
      : centre(centre_m / resolution_m), radius(radius_m / resolution_m) {}

  VoxelIndex low() const {
    return {static_cast<int>(std::floor(centre.x() - radius)),
            static_cast<int>(std::floor(centre.y() - radius)), 0};
  }
  VoxelIndex high() const {
    return {static_cast<int>(std::floor(centre.x() + radius)),
            static_cast<int>(std::floor(centre.y() + radius)), 0};
  }

  /// Calls visit(x, y) for the cells with centres in the disc.
  template <class Visit>
  void for_each(Visit visit) const {
    const VoxelIndex last = high();
    for (int y = low()[1]; y <= last[1]; ++y) {
      for (int x = low()[0]; x <= last[0]; ++x) {
        if ((Vector2(x + 0.5, y + 0.5) - centre).norm() <= radius) visit(x, y);
      }
    }
  }

  Vector2 centre;
  double radius;
};

}  // namespace mocha
