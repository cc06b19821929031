#include "perception/monitoring/blind_beams.h"

#include <cmath>
#include <complex>

namespace mocha {
namespace {

constexpr std::size_t kEvery = 3;  // so many beams one is looked at
constexpr double kFarthest_m = 10.0;
constexpr double kShare = 0.9;  // of a beam: at the end of its reach a wall may be lost
constexpr double kStep_m = 0.05;
constexpr double kWall_m = 0.03;  // about a step

bool passes_wall(const Beam& beam, const OccupancyMap& map) {
  const Vector2 from = beam.origin.head<2>();
  const Vector2 way = (beam.end - beam.origin).head<2>();
  const double length_m = std::min(kShare * way.norm(), kFarthest_m);
  const Vector2 step = kStep_m * way.normalized();
  for (int i = 1; i * kStep_m < length_m; ++i) {
    if (map.is_occupied_within(from + i * step, kWall_m, false)) return true;
  }
  return false;
}

}  // namespace

BlindBeams blind_beams(const std::vector<Beam>& beams, double increment_rad,
                       const OccupancyMap& map) {
  BlindBeams blind;
  std::complex<double> sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < beams.size(); i += kEvery) {
    const Beam& beam = beams[i];
    if (beam.kind != BeamEnd::kMiss || !is_usable(beam) || !passes_wall(beam, map)) continue;
    const Vector2 way = (beam.end - beam.origin).head<2>().normalized();
    sum += std::complex<double>(way.x(), way.y());
    ++count;
  }
  if (count == 0) return blind;
  blind.width_rad = std::abs(increment_rad) * static_cast<double>(kEvery * count);
  blind.middle_rad = std::arg(sum);
  return blind;
}

}  // namespace mocha
