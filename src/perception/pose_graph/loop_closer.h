#pragma once

#include <optional>
#include <vector>

#include "perception/pose_graph/keyframe.h"
#include "perception/pose_graph/loop_matcher.h"
#include "perception/pose_graph/pose_graph.h"

namespace mocha {

struct LoopCloserOptions {
  double radius_m;  ///< loops are looked for so far around, and as far as uncertainty reaches
  double quality;   ///< share of a scan that a place must explain to be believed

  /// The same where several keyframes find the same place.
  double quality_of_several() const { return quality - 0.15; }
};

/// A keyframe that was found among others that it was not surely near before.
struct LoopClosure {
  int keyframe;
  Alignment place;
};

/// Finds where a drive comes back to a place that it, or another, has seen. A place that is far
/// from where the keyframe is expected is believed if the next keyframes find it as well.
class LoopCloser {
 public:
  explicit LoopCloser(const LoopCloserOptions& options) : options_(options) {}

  /// Looks from the next keyframe of a drive. Returns the loops that are believed by now.
  std::vector<LoopClosure> look(const PoseGraph& graph, const std::vector<ScanKeyframe>& keyframes,
                                int keyframe);

  /// What was found, but not yet confirmed: there are no more keyframes to confirm it.
  std::vector<LoopClosure> take_unconfirmed();

  int tried() const { return tried_; }

 private:
  struct Candidate {
    int keyframe;
    double sigma_m;
    double sigma_rad;
  };
  struct Unconfirmed {
    LoopClosure loop;
    Pose correction;  ///< takes the drive's end to where it was found, map frame
    bool is_good;     ///< would be believed where it is expected
  };

  std::optional<Candidate> candidate(const PoseGraph& graph, int keyframe) const;
  std::vector<LoopClosure> judge(const std::vector<LoopMatch>& matches, const PoseGraph& graph,
                                 int keyframe);
  bool is_confirmed_by(const LoopClosure& loop, const PoseGraph& graph) const;

  LoopCloserOptions options_;
  std::optional<Vector2> looked_at_;  // where a search began last
  std::optional<Unconfirmed> unconfirmed_;
  int tried_ = 0;
};

}  // namespace mocha
