#pragma once

#include <mocha_ugv/PoseGraph.h>
#include <ros/node_handle.h>

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "perception/mapping/occupancy_map.h"
#include "perception/sensor/scan_hits.h"

namespace mocha {

/// Maps made anew from the keyframes of scan_localizer: whenever these have moved, and when there
/// are some that this node has not seen. The work is done on a thread of its own.
class DrivenMapSource {
 public:
  /// Keyframes must be in `frame`. `ended` is called from the node's callback queue whenever the
  /// work has ended: with the map, or with null where none could be made.
  DrivenMapSource(ros::NodeHandle& node, std::string frame, const OccupancyMapOptions& options,
                  std::function<void(OccupancyMap*)> ended);
  /// Waits for what is under way.
  ~DrivenMapSource();

  bool is_busy() const { return work_.valid(); }
  /// How often a map was made.
  int made() const { return made_; }
  /// Why the newest message, or its scans, could not be used; empty where they could.
  const std::string& fault() const { return fault_; }

 private:
  using Scans = std::vector<ScanHits>;
  struct Made {
    Scans scans;
    std::unique_ptr<OccupancyMap> map;  // null: see fault
    std::string fault;
  };

  void on_graph(const mocha_ugv::PoseGraph& message);
  void add_seen();
  bool is_due() const;
  void begin_another_map();
  void begin();
  void finish();
  static Made make(const std::string& service, const OccupancyMapOptions& options, Scans scans,
                   const std::vector<Pose>& poses);

  const std::string frame_;
  const std::string service_;
  const OccupancyMapOptions options_;
  const std::function<void(OccupancyMap*)> ended_;
  std::vector<Pose> poses_;   // newest
  std::vector<Pose> mapped_;  // as the keyframes are in the map
  Scans scans_;               // of the first keyframes
  std::vector<Pose> under_way_;
  std::future<Made> work_;
  int made_ = 0;
  std::string fault_;
  ros::Subscriber graphs_;
};

}  // namespace mocha
