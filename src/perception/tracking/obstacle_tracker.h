#pragma once

#include <cstdint>
#include <vector>

#include "perception/tracking/constant_velocity_filter.h"
#include "perception/tracking/departure.h"
#include "perception/tracking/detection.h"
#include "perception/tracking/disc_fit.h"

namespace mocha {

struct TrackerOptions {
  double min_radius_m;  ///< of the discs
  double max_radius_m;
  double measurement_noise_m;  ///< standard deviation of a sighted centre along each axis
  double acceleration_psd;     ///< of what the things do, per axis [m^2/s^3]
  int confirmation_hits;       ///< that make a track known
  double track_timeout_s;      ///< a track ends after so long without detection
  double occlusion_timeout_s;  ///< the same while something nearer hides its place
  double standing_time_s;      ///< what has not left its place for so long stands
};

/// A thing that may move, at one time, map frame.
struct TrackedObstacle {
  std::uint32_t id;  ///< stable while it is tracked
  double time_s;
  Vector2 position;  ///< [m]
  Vector2 velocity;  ///< [m/s]
  double radius_m;
  Eigen::Matrix4d covariance;  ///< of (x, y, vx, vy)
  bool is_mover;               ///< it has been seen to move, or looks like a person
  bool stands;                 ///< it has stood for so long that it belongs into the map ...
  bool is_mapped;              ///< ... and the map has it
  bool is_seen;                ///< in the newest scan ...
  Vector2 seen_at;             ///< ... or in the last that saw it, where that scan showed it
};

/// Follows discs from scan to scan: a Kalman filter each, the best fitting pairs of track and
/// detection first. Scans may come from several sensors and somewhat out of order. What has come
/// moves once it has left its place; what looks like two legs is a person, also where it stands.
class ObstacleTracker {
 public:
  /// Throws std::invalid_argument, naming the value and its range.
  explicit ObstacleTracker(const TrackerOptions& options);

  /// Takes what one scan shows: the discs sighted, and all its beams for the places where a disc is
  /// missing. Returns, of each detection, whether it is (or may become) something that moves; what
  /// has come to stand is not.
  std::vector<bool> update(const std::vector<Detection>& detections, const std::vector<Beam>& beams,
                           double time_s);

  /// The known tracks, predicted to a time; not only movers.
  std::vector<TrackedObstacle> at(double time_s) const;

  void clear() { tracks_.clear(); }

 private:
  struct Track {
    std::uint32_t id;  ///< 0 until it is known
    ConstantVelocityFilter filter;
    double radius_m;
    double unsteady_m;  ///< by so much its radius differs from scan to scan, as with legs
    SeenPlace place;    ///< that it has not left ...
    double arrived_s;   ///< ... since then
    bool has_come;      ///< where it was seen last, the map was free
    int leg_pairs;      ///< detections that looked like two legs
    int detections = 1;
    int departures = 0;                 ///< places that it was seen to have left ...
    double left_s = 0.0;                ///< ... the last of them then
    double seen_s = 0.0;                ///< last ...
    Vector2 seen_at = Vector2::Zero();  ///< ... and where
    int missing = 0;                    ///< scans in a row that saw its place free
    bool hidden = false;                ///< its place was, in the last scan
    bool lost = false;
    bool is_seen = true;  ///< in the newest scan
  };

  std::vector<int> associate(const std::vector<Detection>& detections) const;
  void follow_turns(const std::vector<Detection>& detections, std::vector<int>& partners);
  void see(Track& track, const Detection& detection, const std::vector<Beam>& beams);
  void look_for_departure(Track& track, const Detection& detection, const Vector2& centre,
                          const std::vector<Beam>& beams) const;
  void resize(Track& track, const Detection& detection) const;
  void miss(Track& track, const std::vector<Beam>& beams, double time_s) const;
  void begin(const Detection& detection);
  void join();
  bool stands(const Track& track) const;
  bool is_mover(const Track& track) const;
  DiscFit fit(const Detection& detection, double radius_m, double unsteady_m) const;
  double clamped_radius(const Detection& detection) const;

  TrackerOptions options_;
  std::vector<Track> tracks_;
  std::uint32_t last_id_ = 0;
};

}  // namespace mocha
