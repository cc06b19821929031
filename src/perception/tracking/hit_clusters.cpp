#include "perception/tracking/hit_clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace mocha {
namespace {

Vector2 end_of(const Beam& beam) { return beam.end.head<2>(); }

/// The root of a group, with the paths to it shortened.
int root_of(std::vector<int>& parents, int i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
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
