#include "perception/tracking/moving_object_filter.h"

#include <algorithm>
#include <stdexcept>

namespace mocha {
namespace {

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
  tracker.standing_time_s = values.number("standing_time");
  return options;
}

MovingObjectFilter::MovingObjectFilter(const MovingObjectFilterOptions& options)
    : options_(checked(options)),
      detector_({options.cluster_gap_m, options.cluster_points, options.cluster_extent_m,
                 options.map_tolerance_m}),
      tracker_(options.tracker) {}

void MovingObjectFilter::sort(std::vector<Beam>& beams, const OccupancyMap& map) {
  if (beams.empty()) return;
  const double time_s = time_of(beams);
  const std::vector<TrackedObstacle> known = tracker_.at(time_s);
  const auto things = detector_.detect(beams, come_hits(beams, map, known), known);
  std::vector<Detection> detections;
  for (const Detector::Thing& thing : things) detections.push_back(thing.detection);
  const std::vector<bool> moving = tracker_.update(detections, beams, time_s);
  errors_.update(this->moving(time_s));
  moving_hits_ = 0;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (!moving[i]) continue;
    for (int beam : things[i].hits) beams[beam].kind = BeamEnd::kIgnored;
    moving_hits_ += static_cast<int>(things[i].hits.size());
  }
}

BeamIndices MovingObjectFilter::come_hits(const std::vector<Beam>& beams, const OccupancyMap& map,
                                          const std::vector<TrackedObstacle>& known) const {
  BeamIndices hits;
  const double gap_rad = beam_spacing_rad(beams);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].kind != BeamEnd::kHit || !is_usable(beams[i])) continue;
    const Vector2 end = beams[i].end.head<2>();
    const double range_m = ray(beams[i]).norm();
    const double tolerance_m = options_.map_tolerance_m + options_.map_tolerance_rad * range_m;
    const bool on_known = std::any_of(known.begin(), known.end(), [&](const TrackedObstacle& disc) {
      return !disc.stands &&
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

std::vector<TrackedObstacle> MovingObjectFilter::things(double time_s) const {
  std::vector<TrackedObstacle> things = tracker_.at(time_s);
  things.erase(std::remove_if(
                   things.begin(), things.end(),
                   [](const TrackedObstacle& thing) { return thing.is_mapped && !thing.is_mover; }),
               things.end());
  return things;
}

std::vector<TrackedObstacle> MovingObjectFilter::moving(double time_s) const {
  std::vector<TrackedObstacle> things = tracker_.at(time_s);
  things.erase(std::remove_if(things.begin(), things.end(),
                              [](const TrackedObstacle& thing) { return thing.is_mapped; }),
               things.end());
  return things;
}

void MovingObjectFilter::clear() {
  tracker_.clear();
  errors_.forget();
  moving_hits_ = 0;
}

}  // namespace mocha
