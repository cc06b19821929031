#include "perception/monitoring/blind_beams.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mocha {
namespace {

constexpr std::size_t kEvery = 6;  // so many beams one is looked at
constexpr double kFarthestWall_m = 10.0;
constexpr double kShare = 0.9;  // of a beam: at the end of its reach a wall may be lost
constexpr double kStep_m = 0.1;
constexpr double kWall_m = 0.06;  // about a step
constexpr double kStays_m = 1.2;  // what is smaller may have left

/// Where a beam without return passes what stands on the map.
std::optional<Vector2> wall_passed(const Beam& beam, const OccupancyMap& map) {
  if (beam.kind != BeamEnd::kMiss || !is_usable(beam)) return std::nullopt;
  const Vector2 from = beam.origin.head<2>();
  const Vector2 way = ray(beam);
  const double length_m = std::min(kShare * way.norm(), kFarthestWall_m);
  const Vector2 step = kStep_m * way.normalized();
  for (int i = 1; i * kStep_m < length_m; ++i) {
    if (map.is_occupied_within(from + i * step, kWall_m, false)) return Vector2(from + i * step);
  }
  return std::nullopt;
}

/// Neighbouring beams that pass what stands.
struct Run {
  int beams = 0;
  Vector2 first = Vector2::Zero();
  Vector2 last = Vector2::Zero();
  Vector2 ways = Vector2::Zero();  // their sum

  bool is_wide() const { return beams > 0 && (last - first).norm() > kStays_m; }
};

}  // namespace

BlindBeams blind_beams(const std::vector<Beam>& beams, double increment_rad,
                       const OccupancyMap& map) {
  int count = 0;
  Vector2 ways = Vector2::Zero();
  Run run;
  const auto finish = [&] {
    if (run.is_wide()) {
      count += run.beams;
      ways += run.ways;
    }
    run = Run();
  };
  for (std::size_t i = 0; i < beams.size(); i += kEvery) {
    const auto place = wall_passed(beams[i], map);
    if (!place) {
      finish();
      continue;
    }
    if (run.beams++ == 0) run.first = *place;
    run.last = *place;
    run.ways += ray(beams[i]).normalized();
  }
  finish();
  if (count == 0) return {};
  return {std::abs(increment_rad) * static_cast<double>(kEvery * count),
          std::atan2(ways.y(), ways.x())};
}

}  // namespace mocha
