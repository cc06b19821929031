#include "planning/candidates/knot_map_choice.h"

#include "camouflage/camouflage_map.h"
#include "camouflage/reference_point.h"

namespace mocha {

template <int D>
std::shared_ptr<const KnotMap<D>> choose_knot_map(
    const Eigen::Matrix<double, D, Eigen::Dynamic>& path, const ObstacleField<D>& field,
    double travel_m, std::optional<BasicFallback<D>>& fallback) {
  const Eigen::Matrix<double, D, Eigen::Dynamic> prey = path.middleCols(1, path.cols() - 2);
  if (!fallback) {
    const auto chosen = choose_references<D>(path, field, travel_m);
    if (chosen) return std::make_shared<CamouflageMap<D>>(prey, chosen.references, travel_m);
    const bool bends = chosen.fault == ReferenceFault::kSharpBend;
    fallback = {bends ? FallbackKind::kSharpBend : FallbackKind::kCoincidentPoints, chosen.place};
  }
  return std::make_shared<WaypointMap<D>>(prey);
}

template std::shared_ptr<const KnotMap<2>> choose_knot_map(const Eigen::Matrix2Xd&,
                                                           const ObstacleField<2>&, double,
                                                           std::optional<BasicFallback<2>>&);
template std::shared_ptr<const KnotMap<3>> choose_knot_map(const Eigen::Matrix3Xd&,
                                                           const ObstacleField<3>&, double,
                                                           std::optional<BasicFallback<3>>&);

}  // namespace mocha
