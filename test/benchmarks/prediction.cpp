// How well what moves is predicted, in a world with movers: a robot patrols between its start and
// its goal, and each prediction is held against where the mover then really is. Prints JSON: of
// each prediction that was matched, its age and speed, and for each time ahead how far off it was
// and how far off plain constant velocity was. Arguments: a world file, a seed, how long [s].

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "benchmarks/lidar_perception.h"
#include "benchmarks/world_program.h"
#include "simulation/mover_path.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

using Json = nlohmann::json;

constexpr double kBegin_s = 1.7e9;
constexpr double kTick_s = 0.02;
constexpr double kSameMover_m = 0.75;
constexpr double kAhead_s[] = {0.5, 1.0, 2.0};
constexpr double kConfidences[] = {0.5, 0.8, 0.9, 0.95};
constexpr double kBaseline_s = 0.4;  // between the two places of plain constant velocity

/// Drives to and fro between the robot's start and its goal, and turns in place there.
class Patrol {
 public:
  explicit Patrol(const WorldRobot& robot)
      : limits_(robot.model.limits), ends_{robot.goal->position, robot.start.position} {}

  Twist command(const Pose& pose) {
    constexpr double kNear_m = 0.5;
    constexpr double kGain = 2.0;     // of the heading [1/s]
    constexpr double kAim_rad = 0.5;  // farther off, it turns in place
    constexpr double kShare = 0.6;    // of its limits
    if ((ends_[next_] - pose.position).norm() < kNear_m) next_ = 1 - next_;
    const Vector2 way = ends_[next_] - pose.position;
    const double off_rad = wrap_angle(std::atan2(way.y(), way.x()) - pose.yaw_rad);
    const double fastest = kShare * limits_.max_yaw_rate;
    return {std::abs(off_rad) < kAim_rad ? kShare * limits_.max_speed : 0.0,
            std::clamp(kGain * off_rad, -fastest, fastest)};
  }

 private:
  MotionLimits limits_;
  Vector2 ends_[2];
  int next_ = 0;
};

/// The mover that a track follows: the nearest one.
const Mover* mover_of(const World& world, const Vector2& place, double elapsed_s) {
  const Mover* best = nullptr;
  double best_m = kSameMover_m;
  for (const Mover& mover : world.moving) {
    const auto state = mover_state(mover, elapsed_s);
    if (!state) continue;
    const double distance_m = (state->centre - place).norm();
    if (distance_m < best_m) {
      best = &mover;
      best_m = distance_m;
    }
  }
  return best;
}

/// Of one prediction and one time ahead: how far off it is, and plain constant velocity [m]; in
/// predicted deviations how far off then and at most until then; and how many of them should hold
/// the mover, with each confidence, then and until then. Nothing where the mover is gone by then.
Json ahead_of(const PredictedThing& thing, const PredictionSpread& spread, const Mover& mover,
              const std::optional<Vector2>& plain, double elapsed_s, double ahead_s) {
  constexpr double kStep_s = 0.1;
  const auto then = mover_state(mover, elapsed_s + ahead_s);
  if (!then) return nullptr;
  const auto off = [&](double t) {
    const Vector2 place = thing.place + t * thing.velocity;
    return (mover_state(mover, elapsed_s + t)->centre - place).norm() / thing.deviation.after(t);
  };
  double farthest = off(ahead_s);
  for (double t = 0.0; t < ahead_s; t += kStep_s) farthest = std::max(farthest, off(t));
  Json at = Json::array();
  Json throughout = Json::array();
  for (const double confidence : kConfidences) {
    at.push_back(rounded(spread.deviations_at(ahead_s, confidence)));
    throughout.push_back(rounded(spread.deviations_throughout(ahead_s, confidence)));
  }
  const Json of_plain =
      plain ? Json(rounded((thing.place + ahead_s * *plain - then->centre).norm())) : Json();
  return {rounded(off(ahead_s) * thing.deviation.after(ahead_s)),
          of_plain,
          rounded(off(ahead_s)),
          rounded(farthest),
          at,
          throughout};
}

class Measurement {
 public:
  explicit Measurement(const World& world) : world_(world) {}

  void take(const Predictions& predictions) {
    const double elapsed_s = predictions.time_s - kBegin_s;
    for (const PredictedThing& thing : predictions.things) {
      const Mover* mover = mover_of(world_, thing.place, elapsed_s);
      if (mover == nullptr) {
        ++unmatched_;
        continue;
      }
      const auto plain = plain_velocity(thing, predictions.time_s);
      Json row = Json::array();
      for (const double ahead_s : kAhead_s)
        row.push_back(ahead_of(thing, predictions.spread, *mover, plain, elapsed_s, ahead_s));
      rows_.push_back(row);
    }
    for (const PredictedThing& thing : predictions.things)
      past_[thing.id].push_back({predictions.time_s, thing.place});
  }

  Json result() const { return {{"rows", rows_}, {"unmatched", unmatched_}}; }

 private:
  std::optional<Vector2> plain_velocity(const PredictedThing& thing, double time_s) const {
    const auto places = past_.find(thing.id);
    if (places == past_.end()) return std::nullopt;
    for (auto it = places->second.rbegin(); it != places->second.rend(); ++it) {
      const double since_s = time_s - it->first;
      if (since_s >= kBaseline_s - kTick_s) return (thing.place - it->second) / since_s;
    }
    return std::nullopt;
  }

  const World& world_;
  std::map<std::uint32_t, std::vector<std::pair<double, Vector2>>> past_;
  Json rows_ = Json::array();
  int unmatched_ = 0;
};

Json measure(World world, std::uint64_t seed, double longest_s) {
  LidarPerception perception(world.robots.at(0).model);
  LidarModel& lidar = world.robots[0].model.lidar;  // further scans would be dropped
  lidar.rate_hz = std::min(lidar.rate_hz, perception.integration_rate_hz());
  WorldSimulator simulator(world, kBegin_s, seed);
  Patrol patrol(world.robots[0]);
  Measurement measurement(world);
  for (int tick = 1; tick * kTick_s < longest_s; ++tick) {
    const SimulatedRobot& robot = simulator.robots()[0];
    simulator.command(0, patrol.command(robot.vehicle.pose()));
    for (const auto& [number, scan] : simulator.step_to(kBegin_s + tick * kTick_s).scans) {
      const PlanarScan planar = planar_scan(scan, robot);
      perception.take(planar, robot.past.at(planar.start_time_s),
                      robot.past.at(planar.end_time_s()));
      measurement.take(perception.predictions());
    }
  }
  return measurement.result();
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { return mocha::run_on_world(argc, argv, mocha::measure); }
