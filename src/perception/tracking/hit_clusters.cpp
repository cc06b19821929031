#include "perception/tracking/hit_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace mocha {
namespace {

constexpr int kPassing = 2;  // beams in a row; one alone may be without return

Vector2 end_of(const Beam& beam) { return beam.end.head<2>(); }

double range_m(const Beam& beam) { return ray(beam).norm(); }

/// The root of a group, with the paths to it shortened.
int root_of(std::vector<int>& parents, int i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// The beams in their order round the sensor, from behind the widest gap on: a cluster may lie
/// across where the sweep begins.
BeamIndices in_order(const std::vector<Beam>& beams, const BeamIndices& cluster) {
  const int size = static_cast<int>(beams.size());
  std::size_t first = 0;
  int widest = cluster.front() + size - cluster.back();
  for (std::size_t i = 1; i < cluster.size(); ++i) {
    if (cluster[i] - cluster[i - 1] <= widest) continue;
    widest = cluster[i] - cluster[i - 1];
    first = i;
  }
  BeamIndices ordered = cluster;
  std::rotate(ordered.begin(), ordered.begin() + static_cast<std::ptrdiff_t>(first), ordered.end());
  return ordered;
}

/// How deep the ranges are notched before each: how far they jump there, or how far the nearer one
/// of the two is behind the nearest on either side.
std::vector<double> notches(const std::vector<double>& ranges_m) {
  const std::size_t size = ranges_m.size();
  std::vector<double> after_m(size + 1, std::numeric_limits<double>::infinity());
  for (std::size_t i = size; i-- > 0;) after_m[i] = std::min(after_m[i + 1], ranges_m[i]);
  std::vector<double> depths_m(size, 0.0);
  double before_m = ranges_m.empty() ? 0.0 : ranges_m[0];
  for (std::size_t i = 1; i < size; ++i) {
    const double jump_m = std::abs(ranges_m[i] - ranges_m[i - 1]);
    const double valley_m = std::min(ranges_m[i], ranges_m[i - 1]) - std::max(before_m, after_m[i]);
    depths_m[i] = std::max(jump_m, valley_m);
    before_m = std::min(before_m, ranges_m[i]);
  }
  return depths_m;
}

/// Whether beams pass between two neighbours of a cluster, `from` the first in the sweep.
bool is_open_between(const std::vector<Beam>& beams, int from, int to, double notch_m) {
  const int size = static_cast<int>(beams.size());
  const double behind_m = std::max(range_m(beams[from]), range_m(beams[to])) + notch_m;
  int passing = 0;
  for (int i = (from + 1) % size; i != to; i = (i + 1) % size) {
    const bool passes = beams[i].kind == BeamEnd::kMiss || range_m(beams[i]) > behind_m;
    passing = passes ? passing + 1 : 0;
    if (passing == kPassing) return true;
  }
  return false;
}

}  // namespace

std::vector<BeamIndices> cluster_hits(const std::vector<Beam>& beams, const BeamIndices& hits,
                                      double gap_m) {
  BeamIndices sorted = hits;
  std::sort(sorted.begin(), sorted.end(),
            [&](int a, int b) { return beams[a].end.x() < beams[b].end.x(); });
  std::vector<int> parents(sorted.size());
  std::iota(parents.begin(), parents.end(), 0);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Vector2 here = end_of(beams[sorted[i]]);
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      const Vector2 step = end_of(beams[sorted[j]]) - here;
      if (step.x() > gap_m) break;
      if (step.norm() <= gap_m)
        parents[root_of(parents, static_cast<int>(j))] = root_of(parents, static_cast<int>(i));
    }
  }
  std::map<int, BeamIndices> groups;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    groups[root_of(parents, static_cast<int>(i))].push_back(sorted[i]);
  std::vector<BeamIndices> clusters;
  for (auto& [root, group] : groups) {
    std::sort(group.begin(), group.end());
    clusters.push_back(std::move(group));
  }
  return clusters;
}

std::vector<BeamIndices> part_cluster(const std::vector<Beam>& beams, const BeamIndices& cluster,
                                      const std::vector<Vector2>& centres) {
  std::vector<BeamIndices> parts(centres.size());
  for (int i : cluster) {
    const auto farther = [&](const Vector2& a, const Vector2& b) {
      return (end_of(beams[i]) - a).squaredNorm() < (end_of(beams[i]) - b).squaredNorm();
    };
    parts[std::min_element(centres.begin(), centres.end(), farther) - centres.begin()].push_back(i);
  }
  return parts;
}

std::vector<BeamIndices> part_at_notches(const std::vector<Beam>& beams, const BeamIndices& cluster,
                                         double notch_m) {
  if (cluster.empty()) return {};
  const BeamIndices ordered = in_order(beams, cluster);
  std::vector<double> ranges_m;
  for (const int i : ordered) ranges_m.push_back(range_m(beams[i]));
  std::vector<double> depths_m = notches(ranges_m);
  for (std::size_t i = 1; i < ordered.size(); ++i) {
    if (is_open_between(beams, ordered[i - 1], ordered[i], notch_m))
      depths_m[i] = std::numeric_limits<double>::infinity();
  }
  const auto deepest = std::max_element(depths_m.begin(), depths_m.end());
  if (*deepest <= notch_m) return {cluster};
  const auto middle = ordered.begin() + (deepest - depths_m.begin());
  std::vector<BeamIndices> parts;
  for (BeamIndices half :
       {BeamIndices(ordered.begin(), middle), BeamIndices(middle, ordered.end())}) {
    std::sort(half.begin(), half.end());
    for (BeamIndices& part : part_at_notches(beams, half, notch_m))
      parts.push_back(std::move(part));
  }
  return parts;
}

double extent_m(const std::vector<Beam>& beams, const BeamIndices& cluster) {
  double squared = 0.0;
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector2 apart = end_of(beams[cluster[i]]) - end_of(beams[cluster[j]]);
      squared = std::max(squared, apart.squaredNorm());
    }
  }
  return std::sqrt(squared);
}

}  // namespace mocha
