#include "topology/space/moving_paths.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "topology/paths/euclidean_shortcutting.h"

namespace mocha {
namespace {

constexpr int kPlaces = 12;  // along a static path, and as many times, from which it is sampled

using SpaceTimePoint = Eigen::Vector4d;

Eigen::Vector3d place_along(const SpacePath& path, double along_m) {
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Eigen::Vector3d step = path.points[i] - path.points[i - 1];
    if (along_m <= step.norm() || i + 1 == path.points.size())
      return path.points[i - 1] + std::min(1.0, along_m / step.norm()) * step;
    along_m -= step.norm();
  }
  return path.points.back();
}

/// Places of the static paths, each at several times at which one can be there.
std::vector<SpaceTimePoint> along_static(const std::vector<SpacePath>& paths,
                                         const SpaceTime<3>& space, const MovingQuery& query) {
  const double span_s = query.ends.goal_s - query.ends.start_s;
  std::vector<SpaceTimePoint> places;
  for (const SpacePath& path : paths) {
    for (int i = 1; i < kPlaces; ++i) {
      for (int k = 1; k < kPlaces; ++k) {
        const SpaceTimePoint place = space.point(place_along(path, path.length_m * i / kPlaces),
                                                 query.ends.start_s + span_s * k / kPlaces);
        if (space.in_order(space.start(), place) && space.in_order(place, space.goal()))
          places.push_back(place);
      }
    }
  }
  return places;
}

}  // namespace

std::vector<TimedSpacePath> find_moving_paths(const VoxelDistanceField& field,
                                              const SpaceRegion& region, const MovingQuery& query,
                                              const std::vector<SpacePath>& static_paths,
                                              const SpacePathOptions& options,
                                              const std::function<bool()>& should_stop) {
  const SpaceTime<3> space(field, region.cuts(), field.bounds(), query.ends, query.max_speed,
                           query.tubes, options.clearance);
  if (!space.in_order(space.start(), space.goal()) || !space.clearance_m(space.start()) ||
      !space.clearance_m(space.goal()))
    return {};
  VisibilityPrmOptions sampling = options.roadmap;
  sampling.reach_m *= M_SQRT2;  // time is an axis as well
  const Roadmap<4> roadmap = visibility_prm<4>(space, space.start(), space.goal(), sampling,
                                               along_static(static_paths, space, query));
  ClassSearchOptions search{options.classes, M_SQRT2 * options.longest_ratio};
  search.should_stop = should_stop;
  std::vector<TimedSpacePath> paths;
  for (ClassPath<4>& found : shortest_classes<4>(roadmap, space, search)) {
    TimedSpacePath& path = paths.emplace_back();
    if (!should_stop()) found.points = with_shortcuts<4>(std::move(found.points), space);
    for (const SpaceTimePoint& point : found.points) {
      path.points.push_back(point.head<3>());
      path.times_s.push_back(space.since_start_s(point));
    }
  }
  return paths;
}

}  // namespace mocha
