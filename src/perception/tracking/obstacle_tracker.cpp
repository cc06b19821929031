#include "perception/tracking/obstacle_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

constexpr double kFarthest_m = 2.0;      // from where a track is expected
constexpr double kGate = 9.21;           // chi-squared, two degrees of freedom, 99 %
constexpr double kFirstSpeed_mps = 1.0;  // standard deviation of an unknown velocity, one axis
constexpr double kFastest_mps = 2.5;     // of a thing that turns
constexpr double kTurn_s = 0.25;         // since it was last seen, at most
constexpr double kPartNoise = 0.7;       // times the difference of the radii, for a part
constexpr double kGrowth = 0.5;          // of the radius, share of the difference per detection
constexpr double kShrinkage = 0.05;
constexpr double kHiddenNoise = 3.0;  // times the noise, if only a part is seen
constexpr double kRoundNoise = 0.6;   // the same, of hits on what is a disc
constexpr double kUnsteady_m = 0.04;  // of what is new
constexpr double kRound_m = 0.03;     // steadier than this is a disc
constexpr double kSettling = 0.1;     // share of the difference per detection
constexpr int kMissingScans = 2;      // that see a known track's place free end it ...
constexpr int kMissingNew = 3;        // ... a new one's, of which the velocity is not known yet ...
constexpr int kMissingLegs = 5;       // ... that of legs: beams pass between them
constexpr int kLegPairs = 2;          // detections that look like two legs are a person's
constexpr double kSlow_mps = 0.7;     // of what is given the time to leave its place
constexpr double kMoment_s = 0.5;     // for which one place left makes a mover

Eigen::Matrix2d square(double sigma_m) { return sigma_m * sigma_m * Eigen::Matrix2d::Identity(); }

void require_of_tracker(bool holds, const std::string& name, double value,
                        const std::string& range) {
  if (holds) return;
  throw std::invalid_argument("ObstacleTracker: " + name + " is " + std::to_string(value) +
                              ", but must be " + range);
}

}  // namespace

ObstacleTracker::ObstacleTracker(const TrackerOptions& options) : options_(options) {
  const TrackerOptions& o = options_;
  require_of_tracker(o.min_radius_m > 0.0, "min_radius", o.min_radius_m, "above 0 m");
  require_of_tracker(o.max_radius_m >= o.min_radius_m, "max_radius", o.max_radius_m,
                     "at least min_radius");
  require_of_tracker(o.measurement_noise_m > 0.0, "measurement_noise", o.measurement_noise_m,
                     "above 0 m");
  require_of_tracker(o.acceleration_psd > 0.0, "acceleration_psd", o.acceleration_psd,
                     "above 0 m^2/s^3");
  require_of_tracker(o.confirmation_hits >= 1, "confirmation_hits", o.confirmation_hits,
                     "at least 1");
  require_of_tracker(o.track_timeout_s > 0.0, "track_timeout", o.track_timeout_s, "above 0 s");
  require_of_tracker(o.occlusion_timeout_s > 0.0, "occlusion_timeout", o.occlusion_timeout_s,
                     "above 0 s");
  require_of_tracker(o.standing_time_s > 0.0, "standing_time", o.standing_time_s, "above 0 s");
}

std::vector<bool> ObstacleTracker::update(const std::vector<Detection>& detections,
                                          const std::vector<Beam>& beams, double time_s) {
  std::vector<int> partners = associate(detections);
  follow_turns(detections, partners);
  std::vector<bool> moving(detections.size(), true);
  std::vector<bool> taken(detections.size(), false);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (partners[i] < 0) {
      miss(tracks_[i], beams, time_s);
      continue;
    }
    Track& track = tracks_[i];
    see(track, detections[partners[i]], beams);
    taken[partners[i]] = true;
    moving[partners[i]] = !stands(track);
  }
  for (std::size_t j = 0; j < detections.size(); ++j) {
    if (taken[j]) continue;
    begin(detections[j]);
    moving[j] = !stands(tracks_.back());
  }
  join();
  tracks_.erase(
      std::remove_if(tracks_.begin(), tracks_.end(), [](const Track& t) { return t.lost; }),
      tracks_.end());
  return moving;
}

/// The detection of each track, -1 for none.
std::vector<int> ObstacleTracker::associate(const std::vector<Detection>& detections) const {
  struct Pair {
    double cost;  ///< minus the logarithm of the likelihood, but for a factor and a constant
    int track;
    int detection;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    for (std::size_t j = 0; j < detections.size(); ++j) {
      ConstantVelocityFilter filter = tracks_[i].filter;
      filter.predict(detections[j].time_s, options_.acceleration_psd);
      if ((detections[j].centre(tracks_[i].radius_m) - filter.position()).norm() > kFarthest_m)
        continue;
      const DiscFit seen = fit(detections[j], tracks_[i].radius_m, tracks_[i].unsteady_m);
      const auto mismatch = filter.mismatch(seen.centre, seen.covariance);
      if (mismatch.squared < kGate) {
        pairs.push_back({mismatch.squared + mismatch.log_determinant, static_cast<int>(i),
                         static_cast<int>(j)});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
  std::vector<int> partners(tracks_.size(), -1);
  std::vector<bool> taken(detections.size(), false);
  for (const Pair& pair : pairs) {
    if (partners[pair.track] >= 0 || taken[pair.detection]) continue;
    partners[pair.track] = pair.detection;
    taken[pair.detection] = true;
  }
  return partners;
}

/// What is seen near where a known track has just been, though not where it was going, is the same
/// thing that has turned or stopped: it is followed from there, at a velocity that is not known.
void ObstacleTracker::follow_turns(const std::vector<Detection>& detections,
                                   std::vector<int>& partners) {
  std::vector<bool> taken(detections.size(), false);
  for (const int partner : partners) {
    if (partner >= 0) taken[partner] = true;
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (partners[i] >= 0 || track.id == 0 || stands(track)) continue;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < detections.size(); ++j) {
      const double since_s = detections[j].time_s - track.seen_s;
      if (taken[j] || since_s <= 0.0 || since_s > kTurn_s) continue;
      const DiscFit seen = fit(detections[j], track.radius_m, track.unsteady_m);
      const double off_m = (seen.centre - track.seen_at).norm();
      const double reach_m =
          kFastest_mps * since_s + 2.0 * std::sqrt(seen.covariance.trace() / 2.0);
      if (off_m > std::min(reach_m, nearest_m)) continue;
      nearest_m = off_m;
      partners[i] = static_cast<int>(j);
    }
    if (partners[i] < 0) continue;
    taken[partners[i]] = true;
    track.filter = {track.seen_s, track.seen_at, square(options_.measurement_noise_m),
                    kFirstSpeed_mps};
  }
}

void ObstacleTracker::see(Track& track, const Detection& detection,
                          const std::vector<Beam>& beams) {
  track.filter.predict(detection.time_s, options_.acceleration_psd);
  const DiscFit seen = fit(detection, track.radius_m, track.unsteady_m);
  track.filter.update(seen.centre, seen.covariance);
  resize(track, detection);
  if (detection.time_s >= track.seen_s) {
    track.seen_s = detection.time_s;
    track.seen_at = seen.centre;
  }
  track.missing = 0;
  track.hidden = false;
  track.is_seen = true;
  track.has_come = detection.has_come;
  track.leg_pairs += detection.legs == 2 ? 1 : 0;
  ++track.detections;
  if (!detection.is_continued) look_for_departure(track, detection, seen.centre, beams);
  const bool is_known = track.detections >= options_.confirmation_hits || is_mover(track);
  if (track.id == 0 && is_known) track.id = ++last_id_;
}

/// Counts a place that was seen to be left. Where nothing shows the place, a thing that has gone
/// farther than it is wide is watched from its new place on, unless it stands: that has to be seen.
void ObstacleTracker::look_for_departure(Track& track, const Detection& detection,
                                         const Vector2& centre,
                                         const std::vector<Beam>& beams) const {
  const Departure left = departure(track.place, detection, centre, beams);
  if (left == Departure::kNone) return;
  const double gone_m = (centre - track.place.centre).norm();
  const bool has_gone = !stands(track) && gone_m > 2.0 * track.radius_m + kDepartureGap_m;
  if (left == Departure::kUntold && !has_gone) return;
  if (left == Departure::kLeft) {
    ++track.departures;
    track.left_s = detection.time_s;
  }
  track.place = {centre, detection.hits};
  track.arrived_s = detection.time_s;
}

void ObstacleTracker::resize(Track& track, const Detection& detection) const {
  const double growth_m = clamped_radius(detection) - track.radius_m;
  if (!detection.is_hidden())
    track.unsteady_m += kSettling * (std::abs(growth_m) - track.unsteady_m);
  if (growth_m > 0.0) track.radius_m += kGrowth * growth_m;
  if (growth_m < 0.0 && !detection.is_hidden()) track.radius_m += kShrinkage * growth_m;
}

/// What is not sure to move is given the time in which something slow leaves its place.
bool ObstacleTracker::stands(const Track& track) const {
  const double slow_s = (2.0 * track.radius_m + kDepartureGap_m) / kSlow_mps;
  const double given_s =
      track.departures > 1 ? options_.standing_time_s : std::min(slow_s, options_.standing_time_s);
  return track.seen_s - track.arrived_s >= given_s;
}

/// One place that seems to be left may be an error, as where another part of a thing is seen: that
/// counts for a moment only.
bool ObstacleTracker::is_mover(const Track& track) const {
  if (track.leg_pairs >= kLegPairs) return true;
  if (track.departures > 1) return !stands(track);
  return track.departures == 1 && track.seen_s - track.left_s < kMoment_s;
}

void ObstacleTracker::miss(Track& track, const std::vector<Beam>& beams, double time_s) const {
  track.is_seen = false;
  track.filter.predict(time_s, options_.acceleration_psd);
  const View view = view_of(beams, track.filter.position(), track.radius_m);
  if (view == View::kFree) ++track.missing;
  if (view != View::kUnseen) track.hidden = view == View::kHidden;
  const double patience_s =
      track.id > 0 && track.hidden ? options_.occlusion_timeout_s : options_.track_timeout_s;
  const int most_missing = track.leg_pairs > 0 ? kMissingLegs
                           : track.id > 0      ? kMissingScans
                                               : kMissingNew;
  track.lost = time_s - track.seen_s > patience_s || track.missing >= most_missing;
}

void ObstacleTracker::begin(const Detection& detection) {
  const double radius_m = clamped_radius(detection);
  const DiscFit seen = fit(detection, radius_m, kUnsteady_m);
  const double stood_s = detection.has_come ? 0.0 : options_.standing_time_s;
  Track track{0,
              {detection.time_s, seen.centre, seen.covariance, kFirstSpeed_mps},
              radius_m,
              kUnsteady_m,
              {seen.centre, detection.hits},
              detection.time_s - stood_s,
              detection.has_come,
              detection.legs == 2 ? 1 : 0};
  track.seen_s = detection.time_s;
  track.seen_at = seen.centre;
  if (options_.confirmation_hits == 1) track.id = ++last_id_;
  tracks_.push_back(track);
}

/// Of a disc that is known to have this radius; of the part that is seen, if that is smaller: a
/// part, such as one leg, may be anywhere in the disc. What changes its size from scan to scan, as
/// two legs do, is no disc to be fitted, but somewhere in its sector.
DiscFit ObstacleTracker::fit(const Detection& detection, double radius_m, double unsteady_m) const {
  if (detection.legs > 0) return fit_legs(detection);
  const bool hidden = detection.is_hidden();
  const double part_m = hidden ? radius_m : std::min(radius_m, clamped_radius(detection));
  const double part_noise_m = kPartNoise * (radius_m - part_m);
  if (unsteady_m < kRound_m) {
    DiscFit seen = fit_disc(detection, part_m, kRoundNoise * options_.measurement_noise_m);
    seen.covariance += square(part_noise_m);
    return seen;
  }
  const double whole_m = (hidden ? kHiddenNoise : 1.0) * options_.measurement_noise_m;
  return {detection.centre(part_m), square(std::hypot(whole_m, part_noise_m))};
}

/// Of things that cannot be apart, such as legs, the younger belongs to the older.
void ObstacleTracker::join() {
  for (Track& younger : tracks_) {
    for (const Track& older : tracks_) {
      if (older.lost || older.id == 0 || younger.id <= older.id) continue;
      if (is_mover(younger) && !is_mover(older)) continue;
      const double apart_m = (younger.filter.position() - older.filter.position()).norm();
      if (apart_m < std::max(younger.radius_m, older.radius_m)) younger.lost = true;
    }
  }
}

double ObstacleTracker::clamped_radius(const Detection& detection) const {
  return std::clamp(detection.radius_m, options_.min_radius_m, options_.max_radius_m);
}

std::vector<TrackedObstacle> ObstacleTracker::at(double time_s) const {
  std::vector<TrackedObstacle> obstacles;
  for (const Track& track : tracks_) {
    if (track.id == 0) continue;
    ConstantVelocityFilter filter = track.filter;
    filter.predict(time_s, options_.acceleration_psd);
    obstacles.push_back({track.id, time_s, filter.position(), filter.velocity(), track.radius_m,
                         filter.covariance(), is_mover(track), stands(track),
                         stands(track) && !track.has_come, track.is_seen, track.seen_at});
  }
  return obstacles;
}

}  // namespace mocha
