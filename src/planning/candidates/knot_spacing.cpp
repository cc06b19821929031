#include "planning/candidates/knot_spacing.h"

#include <algorithm>
#include <cstddef>

namespace mocha {
namespace {

constexpr double kSpacingOfRoom = 1.5;  // knots apart, over the room beside the path
constexpr double kLeastPieces = 10.0;   // of a path, for its ramps

}  // namespace

template <int D>
double knot_spacing_for_room(const std::vector<Eigen::Matrix<double, D, 1>>& path,
                             const ObstacleField<D>& field, const KnotSpacings& spacings) {
  std::vector<double> room_m;
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Matrix<double, D, 1> step = path[i] - path[i - 1];
    const int parts = 1 + static_cast<int>(std::min(step.norm() / spacings.narrow_m, 1e3));
    for (int k = 0; k < parts; ++k)
      room_m.push_back(field.distance_bound(path[i - 1] + step * k / parts));
    length_m += step.norm();
  }
  // The narrower fifth decides.
  const auto fifth = room_m.begin() + static_cast<std::ptrdiff_t>(room_m.size() / 5);
  std::nth_element(room_m.begin(), fifth, room_m.end());
  const double coarsest =
      std::max(spacings.narrow_m, std::min(spacings.open_m, length_m / kLeastPieces));
  return std::clamp(kSpacingOfRoom * *fifth, spacings.narrow_m, coarsest);
}

template double knot_spacing_for_room<2>(const std::vector<Eigen::Vector2d>&,
                                         const ObstacleField<2>&, const KnotSpacings&);
template double knot_spacing_for_room<3>(const std::vector<Eigen::Vector3d>&,
                                         const ObstacleField<3>&, const KnotSpacings&);

}  // namespace mocha
