#include "perception/tracking/scan_segments.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

constexpr double kStep_m = 0.08;         // between two hits on one surface, at least ...
constexpr double kStepBeams = 6.0;       // ... or so many times what is between two beams there
constexpr double kBeamsInSegment = 3.5;  // spacings; a beam farther off is no neighbour
constexpr double kBeside_rad = 0.15;     // the same, beside a segment: at edges many beams are lost
constexpr double kStepBehind_m = 0.25;   // so much farther away is something else
constexpr int kMixed = 1;  // beams beside a segment that may have hit both it and more

/// Between the directions of two beams, without sign.
double between_rad(const Beam& a, const Beam& b) { return std::abs(angle_between(ray(a), ray(b))); }

bool is_one_surface(const Beam& a, const Beam& b, double spacing_rad) {
  if (between_rad(a, b) > kBeamsInSegment * spacing_rad) return false;
  const double between_m = spacing_rad * std::min(ray(a).norm(), ray(b).norm());
  return (a.end - b.end).head<2>().norm() <= std::max(kStep_m, kStepBeams * between_m);
}

/// Whether what is seen beyond the outermost hit of a segment is clearly behind it. `direction` is
/// -1 or 1.
bool is_free_beyond(const std::vector<Beam>& beams, int outermost, int direction) {
  const int size = static_cast<int>(beams.size());
  const Beam& edge = beams[outermost];
  for (int step = 1; step <= std::min(1 + kMixed, size - 1); ++step) {
    const Beam& next = beams[(outermost + direction * step + size) % size];
    if (!is_usable(next) || between_rad(next, edge) > kBeside_rad) continue;
    if (next.kind == BeamEnd::kMiss || ray(next).norm() > ray(edge).norm() + kStepBehind_m)
      return true;
  }
  return false;
}

ScanSegment segment_of(const std::vector<Beam>& beams, BeamIndices hits, double spacing_rad) {
  const Beam& first = beams[hits.front()];
  const Beam& last = beams[hits.back()];
  const double nearest_m = std::min(ray(first).norm(), ray(last).norm());
  const double width_m = (last.end - first.end).head<2>().norm() + spacing_rad * nearest_m;
  const bool stands_free =
      is_free_beyond(beams, hits.front(), -1) && is_free_beyond(beams, hits.back(), 1);
  return {std::move(hits), width_m, stands_free};
}

}  // namespace

Vector2 ScanSegment::middle(const std::vector<Beam>& beams) const {
  return beams[hits[hits.size() / 2]].end.head<2>();
}

double beam_spacing_rad(const std::vector<Beam>& beams) {
  std::vector<double> spacings_rad;
  for (std::size_t i = 1; i < beams.size(); ++i) {
    if (is_usable(beams[i - 1]) && is_usable(beams[i]))
      spacings_rad.push_back(between_rad(beams[i - 1], beams[i]));
  }
  if (spacings_rad.empty()) return 0.0;
  const auto middle = spacings_rad.begin() + static_cast<std::ptrdiff_t>(spacings_rad.size() / 2);
  std::nth_element(spacings_rad.begin(), middle, spacings_rad.end());
  return *middle;
}

std::vector<ScanSegment> scan_segments(const std::vector<Beam>& beams) {
  const double spacing_rad = beam_spacing_rad(beams);
  BeamIndices hits;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].kind == BeamEnd::kHit && is_usable(beams[i])) hits.push_back(static_cast<int>(i));
  }
  const std::size_t size = hits.size();
  const auto goes_on = [&](std::size_t k) {
    return is_one_surface(beams[hits[k % size]], beams[hits[(k + 1) % size]], spacing_rad);
  };
  std::size_t begin = 0;  // after an edge, if there is one
  while (begin < size && goes_on(begin + size - 1)) ++begin;
  std::vector<ScanSegment> segments;
  BeamIndices segment;
  for (std::size_t k = begin; k < begin + size; ++k) {
    segment.push_back(hits[k % size]);
    if (goes_on(k) && k + 1 < begin + size) continue;
    segments.push_back(segment_of(beams, std::exchange(segment, {}), spacing_rad));
  }
  return segments;
}

}  // namespace mocha
