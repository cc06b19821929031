#include "perception/pose_graph/pose_graph.h"

#include <Eigen/LU>
#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "trajectory/frame_change.h"

namespace mocha {

int PoseGraph::add_keyframe(const Pose& pose) {
  poses_.push_back(pose);
  of_keyframe_.emplace_back();
  return size() - 1;
}

void PoseGraph::add(const Constraint& constraint) {
  const int index = static_cast<int>(constraints_.size());
  constraints_.push_back(constraint);
  of_keyframe_[constraint.from].push_back(index);
  of_keyframe_[constraint.to].push_back(index);
  const Eigen::Matrix3d covariance = constraint.information.inverse();
  added_.push_back({true, covariance.topLeftCorner<2, 2>().trace(), covariance(2, 2)});
}

void PoseGraph::append(const PoseGraph& other, const Pose& frame) {
  const int first = size();
  for (const Pose& pose : other.poses()) add_keyframe(composed(frame, pose));
  for (Constraint constraint : other.constraints()) {
    constraint.from += first;
    constraint.to += first;
    add(constraint);
  }
}

std::vector<PoseGraph::Uncertainty> PoseGraph::uncertainties(int keyframe, double sigma_m) const {
  std::vector<Uncertainty> result(poses_.size());
  using Entry = std::tuple<double, double, int>;  // variances of position and yaw, keyframe
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.push({0.0, 0.0, keyframe});
  while (!open.empty()) {
    const auto [position, yaw, at] = open.top();
    open.pop();
    if (result[at].is_known) continue;
    result[at] = {true, position, yaw};
    for (const int index : of_keyframe_[at]) {
      const Constraint& constraint = constraints_[index];
      const int next = constraint.from == at ? constraint.to : constraint.from;
      // A heading that is not exact moves what lies ahead.
      const double next_position = position + added_[index].position_variance_m2 +
                                   yaw * constraint.relative.position.squaredNorm();
      if (!result[next].is_known && next_position <= sigma_m * sigma_m)
        open.push({next_position, yaw + added_[index].yaw_variance_rad2, next});
    }
  }
  return result;
}

std::vector<int> PoseGraph::surely_near(int keyframe, double sigma_m, double distance_m) const {
  const std::vector<Uncertainty> known = uncertainties(keyframe, sigma_m);
  std::vector<std::pair<double, int>> near;
  for (int i = 0; i < size(); ++i) {
    const double far_m = (poses_[i].position - poses_[keyframe].position).norm();
    if (known[i].is_known && far_m <= distance_m) near.emplace_back(far_m, i);
  }
  std::sort(near.begin(), near.end());
  std::vector<int> result;
  for (const auto& [far_m, i] : near) result.push_back(i);
  return result;
}

}  // namespace mocha
