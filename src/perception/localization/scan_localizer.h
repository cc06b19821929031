#pragma once

#include <optional>
#include <vector>

#include "perception/localization/branch_and_bound_matcher.h"
#include "perception/localization/likelihood_field.h"
#include "perception/localization/localizer.h"
#include "perception/localization/place_hypotheses.h"
#include "perception/localization/scan_fit.h"
#include "perception/localization/scan_localizer_options.h"

namespace mocha {

/// Where a robot is in a map, from its scans and its odometry.
///
/// Keeps the places where it may be. Each follows the odometry, is fitted to every scan of which
/// the map says anything there, and judged by how much of it the map explains, smoothed over the
/// trial's time. Places that explain little, or clearly less than the best, are dropped, and those
/// that the odometry alone has led too far. Where none is left, the robot is looked for around
/// where the odometry has led it since it was last known; where the map says otherwise, in all of
/// the map. Believed is only a place that has no rival and was found twice, so that of a building's
/// many equal rooms none is guessed; driving on tells them apart.
class ScanLocalizer : public Localizer {
 public:
  explicit ScanLocalizer(const ScanLocalizerOptions& options);

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
  struct FittedPlace {
    PoseEstimate base;
    ScanFit fit;
  };

  void predict(const Pose& odometry, double dt_s);
  const BranchAndBoundMatcher& searcher();
  FittedPlace fitted(const ScanHits& scan, const PoseEstimate& guess) const;
  std::vector<FittedPlace> look_around(const ScanHits& scan, const PoseEstimate& base);
  FittedPlace follow(const ScanHits& scan, const PoseEstimate& base);
  void fit(const ScanHits& scan, double dt_s);
  void sift(double time_s);
  bool is_unsure(const PoseEstimate& base) const;
  const PlaceHypothesis& best() const { return places_.all()[0]; }  // not without any
  bool wants_search(double time_s) const;
  void search(const ScanHits& scan);
  bool is_refuted(const ScanHits& scan);
  bool search_around(const ScanHits& scan, const PoseEstimate& base, bool is_sure);
  void search_everywhere(const ScanHits& scan);
  void add(double time_s, const FittedPlace& place, bool confirmed);
  void decide(double time_s, const Pose& odometry);

  ScanLocalizerOptions options_;
  std::optional<LikelihoodField> walls_;
  std::optional<BranchAndBoundMatcher> search_;
  PlaceHypotheses places_;
  std::optional<PoseEstimate> expected_;  // by a hint
  std::optional<PoseEstimate> reckoned_;  // by the odometry, since the place was last known
  int refutations_;                       // of that, by scans, since then
  double around_s_;                       // when the robot may be looked for around there again
  double search_s_;                       // when it may be looked for everywhere again
  double search_interval_s_;              // grows while searches are in vain
  std::optional<Pose> odometry_;
  std::optional<double> time_s_;  // of the newest scan
  bool searched_in_vain_ = false;
  Localization localization_;
};

}  // namespace mocha
