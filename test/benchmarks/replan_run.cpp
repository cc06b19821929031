#include "benchmarks/replan_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "planning/closed_loop.h"
#include "world/moving/prediction.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

constexpr double kSample_s = 0.02;
constexpr double kFarthest_m = 20.0;  // of clearances

/// What a tracker says of the movers after a second.
void predict_movers(const ReplanScene& scene, const RobotModel& robot, double t, ClosedLoop& loop,
                    double now_s) {
  constexpr double kPlace_m = 0.03;  // standard deviations
  constexpr double kVelocity = 0.05;
  static const auto kValues = ParameterTable::from_schema("config/local_replanner.yaml");
  const RiskOptions options = RiskOptions::from(kValues, robot);
  Predictions predictions{now_s};
  for (const SceneMover& mover : scene.movers) {
    const MoverTruth now = truth(mover, t);
    const auto id = static_cast<std::uint32_t>(predictions.things.size() + 1);
    predictions.things.push_back(
        {id, now.centre, now.velocity, mover.radius_m, {kPlace_m, kVelocity}});
  }
  const double confidence = confidence_of_each(predictions, loop.state().pose.position, options);
  loop.moving = confident_discs(predictions, confidence, options);
  loop.expected = likely_discs(predictions);
}

/// Adds up what the stages of local planning take.
class StageClock {
 public:
  void operator()(LocalStage stage) {
    const auto now = std::chrono::steady_clock::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    auto& [last, since] =
        threads_.try_emplace(std::this_thread::get_id(), stage, now).first->second;
    spent_s_[static_cast<int>(last)] += std::chrono::duration<double>(now - since).count();
    last = stage;
    since = now;
    used_ = true;
  }
  double spent_s(LocalStage stage) const { return spent_s_[static_cast<int>(stage)]; }
  /// Whether it was told of anything since this was asked last.
  bool was_used() { return std::exchange(used_, false); }

 private:
  std::mutex mutex_;
  std::map<std::thread::id, std::pair<LocalStage, std::chrono::steady_clock::time_point>> threads_;
  std::array<double, 3> spent_s_ = {};
  bool used_ = false;
};

/// What the last step planned locally.
Replan replan_of(const ClosedLoop& loop, double t) {
  const auto& local = loop.output.local;
  if (!local) return {t, loop.replanner_took_s, false, Vector2::Zero(), 0.0, {}, false, {}};
  Replan replan{
      t, loop.replanner_took_s, false, local->rejoin_point.place(), local->rejoins_s, {}, false,
      {}};
  replan.taken = loop.output.swerves;
  replan.other_class = replan.taken && local->switches_class;
  if (replan.taken) replan.motion = local->motion;
  for (const PlanCandidate& candidate : local->candidates) replan.paths.push_back(candidate.path);
  return replan;
}

/// Straight along x, at the origin at `begin_s` with the given speed, for a while.
Motion under_way(double begin_s, double speed) {
  constexpr double kAcceleration = 0.5;
  const Motion drive = straight_drive(begin_s, Vector2::Zero(), 0.0, 4.0, speed, kAcceleration);
  const double ramp_s = speed / kAcceleration;
  const double behind_m = drive.at(begin_s + ramp_s).pose.position.x();
  return straight_drive(begin_s - ramp_s, {-behind_m, 0.0}, 0.0, 4.0, speed, kAcceleration);
}

class Run {
 public:
  Run(const ReplanScene& scene, const RobotModel& robot)
      : scene_(scene),
        robot_(robot),
        walls_(scene.obstacles, 1.0),
        loop_(robot, scene.grid(), Vector2::Zero(), scene.goal, std::ref(clock_)),
        begin_s_(loop_.now_s) {
    if (scene.start_speed > 0.0) loop_.begin_with(under_way(begin_s_, scene.start_speed));
  }

  ReplanRun until(double longest_s) {
    while (elapsed_s() < longest_s && !run_.reached && !run_.contact) {
      const double next_s = elapsed_s() + ClosedLoop::kStep_s;
      predict_movers(scene_, robot_, next_s, loop_, begin_s_ + next_s);
      loop_.step();
      if (clock_.was_used()) add(replan_of(loop_, elapsed_s()));
      watch();
      const Vector2 to_goal = loop_.state().pose.position - scene_.goal;
      run_.reached = to_goal.norm() < 0.15 && loop_.state().twist.speed < 0.01;
    }
    run_.time_s = elapsed_s();
    run_.front_end_s = clock_.spent_s(LocalStage::kFrontEnd);
    run_.optimisation_s = clock_.spent_s(LocalStage::kOptimisation);
    return std::move(run_);
  }

 private:
  double elapsed_s() const { return loop_.now_s - begin_s_; }

  void add(Replan replan) {
    constexpr double kEncounter_s = 2.0;
    const bool same = replan.t < taken_s_ + kEncounter_s;
    run_.switches += same && replan.other_class;
    if (replan.taken) taken_s_ = replan.t;
    run_.replans.push_back(std::move(replan));
  }

  /// What happens until the next step. What is promised until then is driven.
  void watch() {
    const Motion& motion = loop_.committed();
    if (motion.empty()) return;
    for (double late_s = 0.0; late_s < ClosedLoop::kStep_s - 1e-6; late_s += kSample_s) {
      const double t = elapsed_s() + late_s;
      const MotionState state = motion.at(begin_s_ + t);
      const Vector2& place = state.pose.position;
      const double radius_m = ReplanScene::kRobotRadius_m;
      double to_movers_m = kFarthest_m;
      for (const SceneMover& mover : scene_.movers) {
        const double apart_m = (truth(mover, t).centre - place).norm();
        to_movers_m = std::min(to_movers_m, apart_m - mover.radius_m - radius_m);
      }
      const double to_walls_m = std::min(kFarthest_m, walls_.distance_bound(place) - radius_m);
      run_.samples.push_back({t, state.pose, state.speed, to_walls_m, to_movers_m});
      run_.min_clearance_m = std::min({run_.min_clearance_m, to_walls_m, to_movers_m});
      run_.contact = run_.contact || std::min(to_walls_m, to_movers_m) < 0.0;
    }
  }

  const ReplanScene& scene_;
  const RobotModel robot_;
  const PrimitiveField<2> walls_;
  StageClock clock_;
  ClosedLoop loop_;
  const double begin_s_;
  double taken_s_ = -std::numeric_limits<double>::infinity();  // the last local plan
  ReplanRun run_;
};

}  // namespace

ReplanRun run_closed_loop(const ReplanScene& scene, double longest_s) {
  return Run(scene, rover()).until(longest_s);
}

bool would_meet(const ReplanRun& undisturbed, const ReplanScene& scene) {
  for (const RunSample& sample : undisturbed.samples) {
    for (const SceneMover& mover : scene.movers) {
      const double apart_m = (truth(mover, sample.t).centre - sample.pose.position).norm();
      if (apart_m < mover.radius_m + ReplanScene::kRobotRadius_m) return true;
    }
  }
  return false;
}

}  // namespace mocha
