// What is asked of the motions that become proposals, in steps in random worlds.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "planning/closed_loop.h"
#include "safety/certificate.h"
#include "trajectory/random_motion.h"
#include "trajectory/rover_braking.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

/// Rows that say what is done in any case.
const std::set<Row> kNotCertified = {Row::kStand, Row::kStopHere, Row::kStopBlind,
                                     Row::kEmergencyStop, Row::kLastResort};
const std::set<Row> kEmergencies = {Row::kBrakeHard, Row::kEmergencyDetour, Row::kMostRoom};

/// A robot on its way, and what then comes into it.
class RandomSteps {
 public:
  RandomSteps(const RobotModel& robot, int seed)
      : robot_(robot),
        random_(seed),
        replanner_(robot, default_replanner_options(robot), default_local_options()) {
    plan_ = within(random_drive(seed, 8, seed % 4 == 0 ? -1 : 1),
                   {0.95 * robot.limits.max_speed, 0.95 * robot.limits.max_acceleration,
                    0.95 * robot.limits.max_yaw_rate},
                   kNow_s);
    now_s_ = kNow_s - 0.5;
    scene_ = scene_of(grid_);
    bind(1, standing(kNow_s - 5.0, plan_.position(kNow_s), plan_.at(kNow_s).pose.yaw_rad));
    replanner_.set_plan(plan_);
  }

  /// Drives on until there is danger, and some steps more.
  template <typename Check>
  void run(const Check& check) {
    const double danger_s = kNow_s + (0.2 + 0.5 * unit()) * (plan_.end_time() - kNow_s);
    constexpr double kStep_s = 0.2;
    for (; now_s_ < danger_s; now_s_ += kStep_s) step(check);
    endanger();
    for (int i = 0; i < 6; ++i, now_s_ += kStep_s) step(check);
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Vector2 direction() {
    const double angle = 2.0 * M_PI * unit();
    return {std::cos(angle), std::sin(angle)};
  }

  template <typename Check>
  void step(const Check& check) {
    const MotionState here = committed_.at(now_s_);
    const auto output =
        replanner_.step(now_s_, {now_s_, here.pose, {here.speed, here.yaw_rate}}, scene_);
    if (!output.proposal) return;
    check(output.row, *output.proposal);
    const Motion& motion = output.proposal->motion;
    const auto onward = splice(committed_, now_s_, motion.start_time(), motion);
    ASSERT_TRUE(onward) << to_text(output.row) << ": " << describe(onward.fault);
    bind(output.proposal->sequence, onward.motion);
  }

  void bind(std::uint32_t sequence, const Motion& motion) {
    committed_ = motion;
    replanner_.set_committed(sequence, motion);
  }

  /// People that come nearer, a pillar, and a peer in some of the worlds.
  void endanger() {
    const MotionState here = committed_.at(now_s_);
    const double body_m = robot_.footprint.circumscribed_radius_m();
    const auto around = [&](double nearest_m, double farthest_m) -> Vector2 {
      return here.pose.position + here.velocity +
             (body_m + nearest_m + (farthest_m - nearest_m) * unit()) * direction();
    };
    if (unit() < 0.5) fill_disc(grid_, around(0.4, 2.5), 0.2, OccupancyGrid::kOccupied);
    const bool with_peer = unit() < 0.3;
    scene_ = scene_of(grid_);
    for (int people = static_cast<int>(3.0 * unit()); people >= 0; --people) {
      const Vector2 place = around(0.5, 3.0);
      const Vector2 towards = (here.pose.position + here.velocity - place).normalized();
      const Vector2 velocity = 1.2 * unit() * (towards + 0.4 * direction());
      const auto disc = [&](double radius_m) {
        return std::make_shared<PredictedDisc>("person", now_s_, place, velocity, radius_m, 0.0);
      };
      scene_.confident.push_back(disc(0.35));
      scene_.likely.push_back(disc(0.25));
    }
    if (with_peer) {
      const auto stands =
          std::make_shared<const Motion>(standing(now_s_ - 9.0, around(1.0, 4.0), 0.0));
      scene_.peers = {std::make_shared<PeerObstacle>("ugv2", stands, 0.3, test::kRoverBraking)};
    }
    scene_.predicted_until_s = now_s_ + 5.0;
  }

  const RobotModel& robot_;
  std::mt19937 random_;
  LocalReplanner replanner_;
  OccupancyGrid grid_ = free_grid({-14.0, -14.0}, {14.0, 14.0}, 0.1);
  LocalScene scene_;
  Motion plan_;
  Motion committed_;
  double now_s_;
};

class ProposalLimitsTest : public ::testing::TestWithParam<const char*> {};

TEST_P(ProposalLimitsTest, AreKeptByEachRowThatIsCertified) {
  const RobotModel robot = load_robot_model("config", GetParam());
  std::map<Row, int> seen;
  for (int seed = 0; seed < 130; ++seed) {
    RandomSteps(robot, seed).run([&](Row row, const ProposedMotion& proposal) {
      ++seen[row];
      if (kNotCertified.count(row) > 0) return;
      const MotionLimits limits =
          kEmergencies.count(row) > 0 ? robot.emergency_limits() : robot.limits;
      const Violation violation =
          check_limits(proposal.motion, limits, proposal.motion.start_time());
      EXPECT_FALSE(violation) << seed << ", " << to_text(row) << ": " << describe(violation);
    });
  }
  for (const auto& [row, count] : seen)
    RecordProperty(std::to_string(static_cast<int>(row)), count);
  // Those that random worlds come to.
  for (const Row row : {Row::kFollow, Row::kDetour, Row::kWeave, Row::kBrakeSoon, Row::kMostRoom})
    EXPECT_GT(seen[row], 0) << to_text(row);
  int emergencies = 0;
  for (const Row row : kEmergencies) emergencies += seen[row];
  EXPECT_GT(emergencies, 15);
}

INSTANTIATE_TEST_SUITE_P(Robots, ProposalLimitsTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
