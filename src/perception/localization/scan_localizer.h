#pragma once

#include <optional>
#include <vector>

#include "config/parameter_table.h"
#include "perception/localization/branch_and_bound_matcher.h"
#include "perception/localization/likelihood_field.h"
#include "perception/localization/localizer.h"
#include "perception/localization/scan_fit.h"
#include "perception/localization/scan_matcher.h"
#include "world/robot_model.h"

namespace mocha {

struct ScanLocalizerOptions {
  ScanMatcherOptions matcher;
  double wall_depth_m;             ///< middle of a mapped wall behind its surface
  std::size_t hits;                ///< of a scan, at most
  double tolerance_m;              ///< a hit that near to a wall of the map is explained by it
  int least_hits;                  ///< explained or not; fewer say nothing about the place
  double sure_quality;             ///< a place that only the scans speak for is believed from here
  double good_quality;             ///< an expected one from here; below, others are looked for
  double poor_quality;             ///< given up below
  double rivalry;                  ///< only places so much worse than the best are no rivals to it
  double trial_s;                  ///< for so long a place is tried before it is believed
  double search_interval_s;        ///< between wide searches
  int search_budget;               ///< see BranchAndBoundMatcher
  double max_sigma_m;              ///< a robot whose place is less sure is lost
  double max_speed;                ///< [m/s] no robot is faster
  double odometry_noise_distance;  ///< [m/sqrt(m)]
  double odometry_noise_yaw;       ///< [rad/sqrt(rad)]

  /// From the parameters of the same names, without units; the odometry's noise is the model's.
  static ScanLocalizerOptions from(const ParameterTable& values, const RobotModel& model);
};

/// Where a robot is in a map, from its scans and its odometry.
///
/// Keeps the places where it may be. Each follows the odometry, is fitted to every scan and judged
/// by how much of the scan the map explains there, smoothed over the trial's time. Places that
/// explain little, or clearly less than the best, are dropped; where none is left, all of the map
/// is searched. Believed is only the one place that has no rival, so that of a building's many
/// equal rooms none is guessed; driving on tells them apart.
class ScanLocalizer : public Localizer {
 public:
  explicit ScanLocalizer(const ScanLocalizerOptions& options) : options_(options) {}

  /// Replaces the map; the places stay. Throws std::invalid_argument for one that
  /// is empty or of no place, see LikelihoodField.
  void set_map(const OccupancyGrid& map);

  /// Takes a hint where the robot is at the next scan, more or less: what was believed is
  /// forgotten, and places within three standard deviations of it come first. Only where none of
  /// them explains the scan, others count as well. Throws std::invalid_argument for an estimate
  /// with a fault.
  void expect(const PoseEstimate& base) override;

  /// Takes the next scan, and the pose of base_link in the odometry frame at its time. Nothing is
  /// known before there is a map. A jump of the odometry that no robot can drive is taken for an
  /// odometry that has begun anew: the places stay where they are. Throws std::invalid_argument,
  /// and changes nothing, for times that do not increase and for places that no lidar and no
  /// odometry measures; what() does not depend on their numbers.
  const Localization& add(const ScanHits& scan, const Pose& odometry) override;

  /// Forgets everything but the map.
  void forget() override;

  const Localization& localization() const override { return localization_; }

 private:
  struct Place {
    PoseEstimate base;
    double quality;
    double needed_quality;  ///< to be believed
    double proved_s;        ///< when it has been tried for long enough
    bool believed;
  };

  void predict(const Pose& odometry, double dt_s);
  void fit(const ScanHits& scan, double dt_s);
  void drop_hopeless(double time_s);
  bool is_hopeless(const Place& place, double time_s) const;
  bool wants_search(double time_s) const;
  void search(const ScanHits& scan);
  void add_place(const ScanHits& scan, const PoseEstimate& guess, double needed_quality);
  void decide(double time_s, const Pose& odometry);

  ScanLocalizerOptions options_;
  std::optional<LikelihoodField> walls_;
  std::optional<BranchAndBoundMatcher> search_;
  std::vector<Place> places_;  // the most likely one first
  std::optional<PoseEstimate> expected_;
  std::optional<Pose> odometry_;
  std::optional<double> time_s_;      // of the newest scan
  std::optional<double> searched_s_;  // when the map was last searched
  bool searched_in_vain_ = false;
  Localization localization_;
};

}  // namespace mocha
