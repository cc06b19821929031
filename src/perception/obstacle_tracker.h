#pragma once

#include <cstdint>
#include <vector>

#include "perception/constant_velocity_filter.h"
#include "perception/disc_sighting.h"

namespace mocha {

struct TrackerOptions {
  double min_radius_m = 0.15;  ///< of the discs
  double max_radius_m = 0.6;
  double measurement_noise_m = 0.06;  ///< standard deviation of a sighted centre along each axis
  double acceleration_psd = 0.6;      ///< of what the things do, per axis [m^2/s^3]
  int birth_sightings = 3;            ///< that make a track known
  double lost_time_s = 0.7;           ///< a track ends after so long without sighting
  double hidden_time_s = 1.5;         ///< the same while something nearer hides its place
  double standing_speed_mps = 0.1;    ///< slower, for standing_time_s, is standing
  double standing_time_s = 3.0;
};

/// A moving thing, at one time, map frame.
struct TrackedObstacle {
  std::uint32_t id;  ///< stable while it is tracked
  double time_s;
  Vector2 position;  ///< [m]
  Vector2 velocity;  ///< [m/s]
  double radius_m;
  Eigen::Matrix4d covariance;  ///< of (x, y, vx, vy)
  bool standing;               ///< it has stood for so long that it belongs into the map
};

/// Follows discs from scan to scan: a Kalman filter each, the best fitting pairs of track and
/// sighting first. Scans may come from several sensors and somewhat out of order.
class ObstacleTracker {
 public:
  /// Throws std::invalid_argument, naming the value and its range.
  explicit ObstacleTracker(const TrackerOptions& options);

  /// Takes what one scan shows: the discs sighted, and all its beams for the places where a disc is
  /// missing. Returns, of each sighting, whether it is (or may become) something that moves; what
  /// has come to stand is not.
  std::vector<bool> update(const std::vector<DiscSighting>& sightings,
                           const std::vector<Beam>& beams, double time_s);

  /// The known tracks, predicted to a time.
  std::vector<TrackedObstacle> at(double time_s) const;

  void clear() { tracks_.clear(); }

 private:
  struct Track {
    std::uint32_t id;  ///< 0 until it is known
    ConstantVelocityFilter filter;
    double radius_m;
    int sightings = 1;
    double seen_s;        ///< last ...
    Vector2 seen_at;      ///< ... and where
    int missing = 0;      ///< scans in a row that saw its place free
    bool hidden = false;  ///< its place was, in the last scan
    Vector2 anchor;       ///< it has been near here ...
    double anchored_s;    ///< ... since then
    bool standing = false;
    bool lost = false;
  };

  std::vector<int> associate(const std::vector<DiscSighting>& sightings) const;
  void follow_turns(const std::vector<DiscSighting>& sightings, std::vector<int>& partners);
  void see(Track& track, const DiscSighting& sighting);
  void miss(Track& track, const std::vector<Beam>& beams, double time_s) const;
  void begin(const DiscSighting& sighting);
  void join();
  Vector2 centre_of(const DiscSighting& sighting, double radius_m) const;
  double noise_of(const DiscSighting& sighting, double radius_m) const;
  double clamped_radius(const DiscSighting& sighting) const;

  TrackerOptions options_;
  std::vector<Track> tracks_;
  std::uint32_t last_id_ = 0;
};

}  // namespace mocha
