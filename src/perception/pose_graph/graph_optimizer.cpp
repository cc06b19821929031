#include "perception/pose_graph/graph_optimizer.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>
#include <vector>

namespace mocha {
namespace {

constexpr int kMostSteps = 50;
constexpr double kLossScale = 3.0;  // [standard deviations]

/// The relative pose of two keyframes less what the constraint says, in standard deviations.
class ConstraintCost : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit ConstraintCost(const Constraint& constraint)
      : relative_(constraint.relative), root_(constraint.information.llt().matrixU()) {}

  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> from(poses[0]);
    const Eigen::Map<const Eigen::Vector3d> to(poses[1]);
    const double cosine = std::cos(from.z());
    const double sine = std::sin(from.z());
    Eigen::Matrix3d to_frame;
    to_frame << cosine, sine, 0.0, -sine, cosine, 0.0, 0.0, 0.0, 1.0;
    const Eigen::Vector3d seen = to_frame * (to - from);
    const Eigen::Vector3d error(seen.x() - relative_.position.x(),
                                seen.y() - relative_.position.y(),
                                wrap_angle(seen.z() - relative_.yaw_rad));
    Eigen::Map<Eigen::Vector3d>{residuals} = root_ * error;
    if (jacobians == nullptr) return true;
    using Jacobian = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
    if (jacobians[0] != nullptr) {
      Eigen::Matrix3d by_from = -to_frame;
      by_from.topRightCorner<2, 1>() = Vector2(seen.y(), -seen.x());
      Jacobian{jacobians[0]} = root_ * by_from;
    }
    if (jacobians[1] != nullptr) Jacobian{jacobians[1]} = root_ * to_frame;
    return true;
  }

 private:
  Pose relative_;
  Eigen::Matrix3d root_;
};

}  // namespace

void optimize(PoseGraph& graph) {
  if (graph.constraints().empty()) return;
  std::vector<Eigen::Vector3d> values;
  values.reserve(graph.poses().size());
  for (const Pose& pose : graph.poses())
    values.emplace_back(pose.position.x(), pose.position.y(), pose.yaw_rad);
  ceres::Problem problem;
  for (Eigen::Vector3d& value : values) problem.AddParameterBlock(value.data(), 3);
  problem.SetParameterBlockConstant(values.front().data());
  for (const Constraint& constraint : graph.constraints()) {
    problem.AddResidualBlock(new ConstraintCost(constraint),
                             constraint.may_be_wrong ? new ceres::CauchyLoss(kLossScale) : nullptr,
                             values[constraint.from].data(), values[constraint.to].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMostSteps;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return;
  std::vector<Pose> poses;
  poses.reserve(values.size());
  for (const Eigen::Vector3d& value : values)
    poses.push_back({value.head<2>(), wrap_angle(value.z())});
  graph.set_poses(std::move(poses));
}

}  // namespace mocha
