#include "topology/space_time/projected_signature.h"

#include <algorithm>
#include <utility>

namespace mocha {
namespace {

using Path = std::vector<Eigen::Vector4d>;

Eigen::Vector2d onto(const ProjectionPlane& plane, const Eigen::Vector3d& v) {
  return {v[plane.first], v[plane.second]};
}

bool meets_shadow(const SpaceTime<3>& space, const Path& path, const Tube<3>& ball,
                  const ProjectionPlane& plane, double clearance_m) {
  for (const TubePiece<3>& piece : ball) {
    const TubePiece<2> shadow = {
        piece.start_s,  piece.end_s,      onto(plane, piece.centre), onto(plane, piece.velocity),
        piece.radius_m, piece.radius_rate};
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double gap_m = least_gap_m<2>(
          shadow, onto(plane, path[i - 1].head<3>()), space.since_start_s(path[i - 1]),
          onto(plane, path[i].head<3>()), space.since_start_s(path[i]));
      if (!(gap_m >= clearance_m && gap_m > 0.0)) return true;
    }
  }
  return false;
}

}  // namespace

ProjectedSignature projected_signature(const SpaceTime<3>& space, const Path& path,
                                       double clearance_m) {
  const Signature whole = space.signature_of(path);
  ProjectedSignature entries(whole.begin(), whole.end());
  for (const auto& moving : space.moving()) {
    for (std::size_t i = 0; i < kProjectionPlanes.size(); ++i) {
      if (meets_shadow(space, path, moving.tube, kProjectionPlanes[i], clearance_m))
        entries[moving.entry + i].reset();
    }
  }
  return entries;
}

bool differ(const ProjectedSignature& a, const ProjectedSignature& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] && b[i] && *a[i] != *b[i]) return true;
  }
  return false;
}

std::vector<ClassPath<4>> pairwise_different(std::vector<ClassPath<4>> paths,
                                             const SpaceTime<3>& space, double clearance_m) {
  std::vector<ProjectedSignature> signatures;
  for (const ClassPath<4>& path : paths)
    signatures.push_back(projected_signature(space, path.points, clearance_m));
  std::vector<std::size_t> most;
  for (std::size_t first = 0; first < paths.size(); ++first) {
    std::vector<std::size_t> chosen = {first};
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const bool is_new = std::all_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
        return differ(signatures[i], signatures[other]);
      });
      if (is_new) chosen.push_back(i);
    }
    if (chosen.size() > most.size()) most = std::move(chosen);
  }
  std::sort(most.begin(), most.end());
  std::vector<ClassPath<4>> kept;
  for (const std::size_t i : most) kept.push_back(std::move(paths[i]));
  return kept;
}

}  // namespace mocha
