#pragma once

#include <memory>
#include <optional>

#include "perception/localization/scan_localizer.h"
#include "perception/pose_graph/graph_mapper.h"
#include "perception/pose_graph/map_merging.h"

namespace mocha {

/// Where a robot is in the map that it makes. A new map begins where the robot stands; in one of
/// earlier drives it first looks for its place.
class MappingSession : public Localizer {
 public:
  MappingSession(const GraphMapperOptions& mapping, const ScanLocalizerOptions& localization,
                 DrivenMap map = {});

  const Localization& add(const ScanHits& scan, const Pose& odometry) override;

  /// Helps to find the place in a map of earlier drives; else of no effect.
  void expect(const PoseEstimate& base) override;

  /// Makes the map anew, from the one that it began with.
  void forget() override;

  /// Makes one map of this one and another, if it is known how they lie; the robot stays where it
  /// is. Not while is_looking(). Takes seconds where the maps are large.
  MapMatch::Fault merge(const DrivenMap& other);

  /// No scans come any more, see GraphMapper::finish().
  void finish();

  const Localization& localization() const override { return localization_; }

  const GraphMapper& mapper() const { return *mapper_; }
  /// Whether the robot's place in a map of earlier drives is not known yet.
  bool is_looking() const { return finder_.has_value(); }

 private:
  GraphMapperOptions mapping_;
  ScanLocalizerOptions localizing_;
  DrivenMap before_;
  std::unique_ptr<GraphMapper> mapper_;
  std::optional<ScanLocalizer> finder_;
  Localization localization_;
};

}  // namespace mocha
