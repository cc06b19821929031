#include "perception/tracking/moving_object_filter.h"

#include <algorithm>
#include <stdexcept>

namespace mocha {
namespace {

constexpr double kNotch_m = 0.15;  // between two things, in the ranges of the beams that hit them

MovingObjectFilterOptions checked(const MovingObjectFilterOptions& o) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("MovingObjectFilter: ") + what);
  };
  require(o.map_tolerance_m >= 0.0 && o.map_tolerance_m <= 2.0, "map_tolerance must be 0 to 2 m");
  require(o.map_tolerance_rad >= 0.0 && o.map_tolerance_rad <= 0.5,
          "map_tolerance_angle must be 0 to 0.5 rad");
  require(o.cluster_gap_m > 0.0, "cluster_gap must be above 0 m");
  require(o.cluster_points >= 1, "cluster_points must be at least 1");
  require(o.cluster_extent_m > 0.0, "cluster_extent must be above 0 m");
  return o;
}

double time_of(const std::vector<Beam>& beams) {
  double sum_s = 0.0;
  for (const Beam& beam : beams) sum_s += beam.time_s / static_cast<double>(beams.size());
  return sum_s;
}

/// The angle between neighbouring beams, the median: beams may be missing.
double gap_between_beams_rad(const std::vector<Beam>& beams) {
  std::vector<double> gaps_rad;
  for (std::size_t i = 1; i < beams.size(); ++i) {
    if (!is_usable(beams[i - 1]) || !is_usable(beams[i])) continue;
    const Vector2 before = (beams[i - 1].end - beams[i - 1].origin).head<2>();
    const Vector2 after = (beams[i].end - beams[i].origin).head<2>();
    const double cross = before.x() * after.y() - before.y() * after.x();
    gaps_rad.push_back(std::abs(std::atan2(cross, before.dot(after))));
  }
  if (gaps_rad.empty()) return 0.0;
  const auto middle = gaps_rad.begin() + gaps_rad.size() / 2;
  std::nth_element(gaps_rad.begin(), middle, gaps_rad.end());
  return *middle;
}

/// Whether unseen space begins within reach of a hit: a disc that is wider than what two beams
/// leave between them.
bool is_beside_unseen(const Vector2& hit, double reach_m, double gap_m, const OccupancyMap& map) {
  constexpr int kDirections = 8;
  const double radius_m = 0.5 * gap_m + 0.75 * map.options().resolution_m;  // holds a cell's centre
  for (int k = 0; k < kDirections; ++k) {
    const double angle_rad = 2.0 * M_PI * k / kDirections;
    const Vector2 beside = hit + reach_m * Vector2(std::cos(angle_rad), std::sin(angle_rad));
    if (map.is_unknown_within(beside, radius_m)) return true;
  }
  return false;
}

}  // namespace

MovingObjectFilterOptions MovingObjectFilterOptions::from(const ParameterTable& values) {
  MovingObjectFilterOptions options;
  options.map_tolerance_m = values.number("map_tolerance");
  options.map_tolerance_rad = values.number("map_tolerance_angle");
  options.cluster_gap_m = values.number("cluster_gap");
  options.cluster_points = values.integer("cluster_points");
  options.cluster_extent_m = values.number("cluster_extent");
  TrackerOptions& tracker = options.tracker;
  tracker.min_radius_m = values.number("moving_min_radius");
  tracker.max_radius_m = values.number("moving_max_radius");
  tracker.measurement_noise_m = values.number("measurement_noise");
  tracker.acceleration_psd = values.number("acceleration_psd");
  tracker.confirmation_hits = values.integer("confirmation_hits");
  tracker.track_timeout_s = values.number("track_timeout");
  tracker.occlusion_timeout_s = values.number("occlusion_timeout");
  tracker.standing_speed_mps = values.number("standing_speed");
  tracker.standing_time_s = values.number("standing_time");
  return options;
}

MovingObjectFilter::MovingObjectFilter(const MovingObjectFilterOptions& options)
    : options_(checked(options)), tracker_(options.tracker) {}

void MovingObjectFilter::sort(std::vector<Beam>& beams, const OccupancyMap& map) {
  if (beams.empty()) return;
  const double time_s = time_of(beams);
  const std::vector<TrackedObstacle> known = tracker_.at(time_s);
  const auto clusters = things(beams, candidates(beams, map, known), known);
  std::vector<Detection> detections;
  for (const BeamIndices& cluster : clusters) detections.push_back(sight_disc(beams, cluster));
  const std::vector<bool> moving = tracker_.update(detections, beams, time_s);
  errors_.update(tracker_.at(time_s));
  moving_hits_ = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (!moving[i]) continue;
    for (int beam : clusters[i]) beams[beam].kind = BeamEnd::kIgnored;
    moving_hits_ += static_cast<int>(clusters[i].size());
  }
}

BeamIndices MovingObjectFilter::candidates(const std::vector<Beam>& beams, const OccupancyMap& map,
                                           const std::vector<TrackedObstacle>& known) const {
  BeamIndices hits;
  const double gap_rad = gap_between_beams_rad(beams);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].kind != BeamEnd::kHit || !is_usable(beams[i])) continue;
    const Vector2 end = beams[i].end.head<2>();
    const double range_m = (beams[i].end - beams[i].origin).head<2>().norm();
    const double tolerance_m = options_.map_tolerance_m + options_.map_tolerance_rad * range_m;
    const bool on_known = std::any_of(known.begin(), known.end(), [&](const TrackedObstacle& disc) {
      return !disc.standing &&
             (end - disc.position).norm() <= disc.radius_m + options_.map_tolerance_m;
    });
    // Cells that moving things have hit once or twice are no walls yet, or such things would drag
    // their walls along. Before what was never seen is a wall, of which few beams at a grazing
    // angle have hit something so far.
    const bool came = map.is_surely_free(end) &&
                      !map.is_occupied_within(end, 0.5 * tolerance_m, false) &&
                      !is_beside_unseen(end, 0.5 * tolerance_m, gap_rad * range_m, map);
    if ((on_known || came) && !map.is_occupied_within(end, tolerance_m, true))
      hits.push_back(static_cast<int>(i));
  }
  return hits;
}

/// Clusters of hits that are small enough to move. Those within reach of a known thing are one, as
/// the legs of a walking person; one that several known things can reach is parted among them. What
/// is too large for one thing may be several that are near to each other.
std::vector<BeamIndices> MovingObjectFilter::things(
    const std::vector<Beam>& beams, const BeamIndices& hits,
    const std::vector<TrackedObstacle>& known) const {
  std::vector<BeamIndices> owned(known.size());
  std::vector<BeamIndices> others;
  for (BeamIndices& cluster : cluster_hits(beams, hits, options_.cluster_gap_m)) {
    std::vector<std::size_t> owners;
    std::vector<Vector2> centres;
    for (std::size_t k = 0; k < known.size(); ++k) {
      const bool holds = std::any_of(cluster.begin(), cluster.end(),
                                     [&](int i) { return is_in_reach(beams[i], known[k]); });
      if (!holds) continue;
      owners.push_back(k);
      centres.push_back(known[k].position);
    }
    if (owners.empty()) {
      others.push_back(std::move(cluster));
      continue;
    }
    const auto parts = part_cluster(beams, cluster, centres);
    for (std::size_t k = 0; k < owners.size(); ++k)
      owned[owners[k]].insert(owned[owners[k]].end(), parts[k].begin(), parts[k].end());
  }
  for (std::size_t k = 0; k < known.size(); ++k) {
    for (BeamIndices& rest : keep_to_reach(beams, known[k], owned[k]))
      others.push_back(std::move(rest));
  }
  for (const BeamIndices& other : others) {
    if (is_one_thing(beams, other)) {
      owned.push_back(other);
      continue;
    }
    for (BeamIndices& part : part_at_notches(beams, other, kNotch_m))
      owned.push_back(std::move(part));
  }
  const auto moves = [&](const BeamIndices& group) {
    return static_cast<int>(group.size()) >= options_.cluster_points && is_one_thing(beams, group);
  };
  owned.erase(std::stable_partition(owned.begin(), owned.end(), moves), owned.end());
  return owned;
}

bool MovingObjectFilter::is_in_reach(const Beam& beam, const TrackedObstacle& thing) const {
  return (beam.end.head<2>() - thing.position).norm() <=
         thing.radius_m + 0.5 * options_.cluster_gap_m;
}

bool MovingObjectFilter::is_one_thing(const std::vector<Beam>& beams,
                                      const BeamIndices& group) const {
  return extent_m(beams, group) <= options_.cluster_extent_m;
}

/// Of a group that is too large, the hits out of the thing's reach are others'.
std::vector<BeamIndices> MovingObjectFilter::keep_to_reach(const std::vector<Beam>& beams,
                                                           const TrackedObstacle& thing,
                                                           BeamIndices& group) const {
  if (is_one_thing(beams, group)) return {};
  const auto rest = std::stable_partition(group.begin(), group.end(),
                                          [&](int i) { return is_in_reach(beams[i], thing); });
  const BeamIndices others(rest, group.end());
  group.erase(rest, group.end());
  return cluster_hits(beams, others, options_.cluster_gap_m);
}

void MovingObjectFilter::clear() {
  tracker_.clear();
  errors_.forget();
  moving_hits_ = 0;
}

}  // namespace mocha
