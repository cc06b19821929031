#include "benchmarks/ompl_peers.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <chrono>
#include <vector>

#include "benchmarks/bitstar.h"

namespace mocha {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
using Clock = std::chrono::steady_clock;
using Reals = ob::RealVectorStateSpace::StateType;

constexpr double kPatience_s = 30.0;   // until a first solution
constexpr double kResolution_m = 0.1;  // of the checks for obstacles
constexpr double kMissed_m = 0.002;    // at most, by which a step of that length cuts a circle
constexpr double kRounding = 1e-6;     // share of the limits
constexpr double kMaxSpeed = (1.0 - kRounding) * Table2Robot::kMaxSpeed;
constexpr double kMaxAcceleration = (1.0 - kRounding) * Table2Robot::kMaxAcceleration;
constexpr double kStep_s = kResolution_m / Table2Robot::kMaxSpeed;
constexpr double kClipped = (1.0 + 1e-9) * kMaxSpeed;  // with rounding
constexpr double kHorizon_s = 1000.0;                  // that no drive takes

constexpr double kGoalRadius_m = 1.0;
constexpr double kVelocityWeight_s = 1.0;  // of a difference of velocities, in distances of SST

struct SstTuning {
  double goal_bias;
  double selection_radius_m;
  double pruning_radius_m;
  int fewest_steps;  // that a control lasts
  int most_steps;
};
// As found on these worlds: what solves soonest, and what gets fastest drives in its time without
// failing. Shorter controls give faster drives, but need longer for the first.
constexpr SstTuning kSoonest{0.3, 4.0, 2.0, 20, 60};
constexpr SstTuning kFastest{0.05, 5.0, 2.0, 5, 45};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

ob::PlannerTerminationCondition within(double budget_s) {
  return ob::timedPlannerTerminationCondition(budget_s);
}

Vector2 position(const ob::State* state) {
  const double* values = state->as<Reals>()->values;
  return {values[0], values[1]};
}

/// Position, velocity and time since the start. The time has no part in the distance.
class DriveSpace : public ob::RealVectorStateSpace {
 public:
  DriveSpace() : RealVectorStateSpace(5) {
    ob::RealVectorBounds bounds(5);
    for (int axis = 0; axis < 2; ++axis) {
      bounds.setLow(axis, -Table2World::kBorder_m);
      bounds.setHigh(axis, Table2World::kSide_m + Table2World::kBorder_m);
      bounds.setLow(2 + axis, -kMaxSpeed);
      bounds.setHigh(2 + axis, kMaxSpeed);
    }
    bounds.setLow(4, 0.0);
    bounds.setHigh(4, kHorizon_s);
    setBounds(bounds);
  }

  double distance(const ob::State* a, const ob::State* b) const override {
    const double* p = a->as<Reals>()->values;
    const double* q = b->as<Reals>()->values;
    const double apart = std::hypot(p[0] - q[0], p[1] - q[1]);
    const double faster = std::hypot(p[2] - q[2], p[3] - q[3]);
    return std::hypot(apart, kVelocityWeight_s * faster);
  }
};

/// Accelerations in the disc of the limit.
class AccelerationSampler : public oc::ControlSampler {
 public:
  using ControlSampler::ControlSampler;

  void sample(oc::Control* control) override {
    double* a = control->as<oc::RealVectorControlSpace::ControlType>()->values;
    const double angle = rng_.uniformReal(-M_PI, M_PI);
    const double norm = kMaxAcceleration * std::sqrt(rng_.uniform01());
    a[0] = norm * std::cos(angle);
    a[1] = norm * std::sin(angle);
  }
};

Vector2 velocity(const ob::State* state) {
  const double* values = state->as<Reals>()->values;
  return {values[2], values[3]};
}

/// One step of constant acceleration. To clip the speed takes no more of it, as the velocities
/// within the limit are a convex set.
void propagate(const ob::State* from, const oc::Control* control, double dt, Overspeed overspeed,
               ob::State* to) {
  const double* x = from->as<Reals>()->values;
  const double* a = control->as<oc::RealVectorControlSpace::ControlType>()->values;
  const Vector2 v = velocity(from);
  Vector2 next = v + dt * Vector2(a[0], a[1]);
  if (overspeed == Overspeed::kClipped && next.norm() > kMaxSpeed) next *= kMaxSpeed / next.norm();
  double* y = to->as<Reals>()->values;
  y[0] = x[0] + 0.5 * dt * (v.x() + next.x());
  y[1] = x[1] + 0.5 * dt * (v.y() + next.y());
  y[2] = next.x();
  y[3] = next.y();
  y[4] = x[4] + dt;
}

/// The cost of SST: how long the drive takes.
class DriveTime : public ob::OptimizationObjective {
 public:
  using OptimizationObjective::OptimizationObjective;
  ob::Cost stateCost(const ob::State*) const override { return ob::Cost(0.0); }
  ob::Cost motionCost(const ob::State* a, const ob::State* b) const override {
    return ob::Cost(b->as<Reals>()->values[4] - a->as<Reals>()->values[4]);
  }
};

/// Around the target, at any speed.
class TargetDisc : public ob::GoalSampleableRegion {
 public:
  TargetDisc(const ob::SpaceInformationPtr& space, const Vector2& target)
      : GoalSampleableRegion(space), target_(target), sampler_(space->allocStateSampler()) {
    setThreshold(kGoalRadius_m);
  }
  double distanceGoal(const ob::State* state) const override {
    return (position(state) - target_).norm();
  }
  void sampleGoal(ob::State* state) const override {
    sampler_->sampleUniform(state);
    std::copy(target_.data(), target_.data() + 2, state->as<Reals>()->values);
  }
  unsigned int maxSampleCount() const override { return std::numeric_limits<unsigned int>::max(); }

 private:
  const Vector2 target_;
  const ob::StateSamplerPtr sampler_;
};

ob::StateValidityCheckerFn is_clear(const PrimitiveField<2>& field) {
  return [&field](const ob::State* state) {
    const Vector2 p = position(state);
    return field.clear({p, p}, Table2Robot::kRadius_m + kMissed_m);
  };
}

oc::SpaceInformationPtr drive_information(const PrimitiveField<2>& field, Overspeed overspeed) {
  const auto states = std::make_shared<DriveSpace>();
  const auto controls = std::make_shared<oc::RealVectorControlSpace>(states, 2);
  ob::RealVectorBounds bounds(2);
  bounds.setLow(-kMaxAcceleration);
  bounds.setHigh(kMaxAcceleration);
  controls->setBounds(bounds);
  controls->setControlSamplerAllocator(
      [](const oc::ControlSpace* space) { return std::make_shared<AccelerationSampler>(space); });
  const auto information = std::make_shared<oc::SpaceInformation>(states, controls);
  information->setStatePropagator(
      [overspeed](const ob::State* from, const oc::Control* control, double dt, ob::State* to) {
        propagate(from, control, dt, overspeed, to);
      });
  information->setPropagationStepSize(kStep_s);
  information->setStateValidityChecker(
      [valid = is_clear(field), space = states.get()](const ob::State* state) {
        return space->satisfiesBounds(state) && velocity(state).norm() <= kClipped && valid(state);
      });
  return information;
}

PlanarPath::Piece accelerated(const Vector2& p, const Vector2& v, const Vector2& a, double dt) {
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  piece.leftCols<3>() << p, dt * v, 0.5 * dt * dt * a;
  return piece;
}

PlanarPath curve_of(oc::PathControl path) {
  path.interpolate();  // one state a step
  std::vector<PlanarPath::Piece> pieces;
  for (std::size_t i = 0; i + 1 < path.getStateCount(); ++i) {
    const ob::State* from = path.getState(i);
    const Vector2 gain = velocity(path.getState(i + 1)) - velocity(from);
    pieces.push_back(accelerated(position(from), velocity(from), gain / kStep_s, kStep_s));
  }
  return {pieces, std::vector<double>(pieces.size(), kStep_s)};
}

/// Speed after `along_m` of a way of `length_m`, from rest to rest.
double trapezoid(double along_m, double length_m) {
  const double from_end_m = std::max(0.0, std::min(along_m, length_m - along_m));
  return std::min(kMaxSpeed, std::sqrt(2.0 * kMaxAcceleration * from_end_m));
}

/// A path driven from rest to rest: accelerate, go on at the highest speed, brake. Requires a path
/// that is long enough for that.
PlanarPath driven(const std::vector<Vector2>& path) {
  constexpr double kShortest_m = 1e-6;
  constexpr double kRamp_m = 0.5 * kMaxSpeed * kMaxSpeed / kMaxAcceleration;
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  std::vector<PlanarPath::Piece> pieces;
  std::vector<double> durations_s;
  double along_m = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Vector2 from = path[i];
    const Vector2 to = path[i + 1];
    const double corner_m = along_m + (to - from).norm();
    const Vector2 direction = (to - from).normalized();
    for (const double change_m : {kRamp_m, length_m - kRamp_m, corner_m}) {
      const double step_m = std::min(change_m, corner_m) - along_m;
      if (step_m < kShortest_m) continue;
      const double v = trapezoid(along_m, length_m);
      const double next = trapezoid(along_m + step_m, length_m);
      const double dt = 2.0 * step_m / (v + next);
      pieces.push_back(accelerated(from, v * direction, (next - v) / dt * direction, dt));
      durations_s.push_back(dt);
      from += step_m * direction;
      along_m += step_m;
    }
  }
  return {pieces, durations_s};
}

}  // namespace

Table2Plan plan_with_sst(const Table2World& world, const Vector2& target,
                         std::optional<double> budget_s, Overspeed overspeed) {
  const auto begin = Clock::now();
  const PrimitiveField<2> field = obstacle_field(world);
  const SstTuning& tuning = budget_s ? kFastest : kSoonest;
  const auto information = drive_information(field, overspeed);
  information->setMinMaxControlDuration(tuning.fewest_steps, tuning.most_steps);
  information->setup();
  const auto problem = std::make_shared<ob::ProblemDefinition>(information);
  ob::ScopedState<ob::RealVectorStateSpace> start(information);
  for (int i = 0; i < 5; ++i) start[i] = i < 2 ? world.start[i] : 0.0;
  problem->addStartState(start);
  problem->setGoal(std::make_shared<TargetDisc>(information, target));
  const auto objective = std::make_shared<DriveTime>(information);
  if (!budget_s) objective->setCostThreshold(objective->infiniteCost());
  problem->setOptimizationObjective(objective);
  oc::SST planner(information);
  planner.setGoalBias(tuning.goal_bias);
  planner.setSelectionRadius(tuning.selection_radius_m);
  planner.setPruningRadius(tuning.pruning_radius_m);
  planner.setProblemDefinition(problem);
  Table2Plan plan;
  const ob::PlannerStatus status = planner.solve(within(budget_s.value_or(kPatience_s)));
  plan.t_plan_s = seconds_since(begin);
  if (status == ob::PlannerStatus::EXACT_SOLUTION) {
    plan.curve = curve_of(*problem->getSolutionPath()->as<oc::PathControl>());
    plan.classes = 1;
  }
  return plan;
}

Table2Plan plan_with_bitstar(const Table2World& world, const Vector2& target,
                             std::optional<double> budget_s) {
  const auto begin = Clock::now();
  const PrimitiveField<2> field = obstacle_field(world);
  const Vector2 border = Vector2::Constant(Table2World::kBorder_m);
  const Eigen::AlignedBox2d bounds(-border, Vector2::Constant(Table2World::kSide_m) + border);
  const std::vector<Vector2> path = path_by_bitstar(
      {field, Table2Robot::kRadius_m + kMissed_m, bounds, world.start, target, kResolution_m},
      budget_s, kPatience_s);
  Table2Plan plan;
  plan.t_plan_s = seconds_since(begin);
  if (!path.empty()) {
    plan.curve = driven(path);
    plan.classes = 1;
  }
  return plan;
}

}  // namespace mocha
