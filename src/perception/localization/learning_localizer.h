#pragma once

#include "perception/localization/map_changes.h"
#include "perception/localization/scan_localizer.h"

namespace mocha {

/// A ScanLocalizer whose map learns what has changed for good, by those scans of which the map
/// explains most.
class LearningLocalizer : public Localizer {
 public:
  /// Changes are learnt that have lasted for `lasting_s`, which is positive. Throws what
  /// ScanLocalizer::set_map() throws.
  LearningLocalizer(const ScanLocalizerOptions& options, const OccupancyGrid& map,
                    double lasting_s);

  const Localization& add(const ScanHits& scan, const Pose& odometry) override;
  void expect(const PoseEstimate& base) override { localizer_.expect(base); }
  /// Forgets where the robot is, not what the map has learnt.
  void forget() override;
  const Localization& localization() const override { return localizer_.localization(); }

  const OccupancyGrid& map() const { return changes_.map(); }
  /// How often the map has changed.
  int changed() const { return changed_; }

 private:
  const double good_quality_;
  ScanLocalizer localizer_;
  MapChanges changes_;
  int changed_ = 0;
};

}  // namespace mocha
