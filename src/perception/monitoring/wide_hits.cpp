#include "perception/monitoring/wide_hits.h"

#include <Eigen/Geometry>

namespace mocha {
namespace {

constexpr double kGap_m = 0.35;
constexpr double kWide_m = 2.0;

}  // namespace

std::vector<Beam> with_wide_hits_only(std::vector<Beam> beams) {
  std::vector<std::size_t> run;
  Eigen::AlignedBox2d box;
  const auto finish = [&] {
    if (!run.empty() && box.diagonal().norm() < kWide_m) {
      for (const std::size_t i : run) beams[i].kind = BeamEnd::kIgnored;
    }
    run.clear();
    box.setEmpty();
  };
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].kind != BeamEnd::kHit || !is_usable(beams[i])) continue;
    const Eigen::Vector2d end = beams[i].end.head<2>();
    if (!run.empty() && (end - beams[run.back()].end.head<2>()).norm() > kGap_m) finish();
    run.push_back(i);
    box.extend(end);
  }
  finish();
  return beams;
}

}  // namespace mocha
