// Certified parts of random drives.
#include <gtest/gtest.h>

#include <random>

#include "fleet/wire/wire_format.h"
#include "planning/maneuver_test.h"
#include "safety/certificate.h"
#include "trajectory/random_motion.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.7e9 + 0.5;
constexpr int kSeeds = 150;

/// Random drives at up to the limits, among obstacles, and what of them is promised.
class RandomParts : public ManeuverTest, public ::testing::WithParamInterface<const char*> {
 protected:
  RandomParts() : ManeuverTest(GetParam()) {}

  Motion committed(int seed) const {
    return within(random_drive(seed, 7, seed % 3 == 0 ? -1 : 1),
                  {robot_.limits.max_speed / 1.001, robot_.limits.max_acceleration / 1.001,
                   robot_.limits.max_yaw_rate / 1.001},
                  kStart_s);
  }
  LocalScene scene(int seed) const {
    OccupancyGrid grid = free_grid({-10.0, -10.0}, {10.0, 10.0});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 3; ++i) {
      const Vector2 centre = 5.0 * Vector2(unit(random), unit(random));
      if (centre.norm() > 1.0) fill_disc(grid, centre, 0.3, OccupancyGrid::kOccupied);
    }
    return scene_of(grid);
  }
  /// Braking in a window, of which the length and the place are random, from a random time on.
  struct Part {
    Motion committed;
    LocalScene scene;
    double now_s;
    double join_s;
    std::optional<CertifiedPart> part;
  };
  Part part(int seed, const Braking& braking, RequirementName required) const {
    Motion committed = this->committed(seed);
    LocalScene scene = this->scene(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double now_s = kStart_s + unit(random) * (committed.end_time() - kStart_s);
    const ManeuverStart start = start_of(committed, scene, now_s);
    const double join_s = start.settled_s;
    const double until_s = join_s + 4.0 * std::max(0.0, unit(random) - 0.3);
    const Maneuver brakes{join_s, rest_of(committed, join_s), join_s,  until_s, join_s, braking,
                          false,  Follows::kCommitted,        "brakes"};
    auto part = certified_part(start, brakes, required);
    return {std::move(committed), std::move(scene), now_s, join_s, std::move(part)};
  }

  void expect_braking_within(const Braking& braking, RequirementName required,
                             const MotionLimits& limits) const {
    int promised = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
      const Part found = part(seed, braking, required);
      if (!found.part) continue;
      ++promised;
      const Violation violation = check_limits(found.part->motion, limits, found.now_s);
      EXPECT_FALSE(violation) << seed << ": " << describe(violation);
    }
    EXPECT_GT(promised, kSeeds / 2);
  }
};

TEST_P(RandomParts, WhatIsCertifiedIsWhatIsHeard) {
  int promised = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto [committed, scene, now_s, join_s, part] =
        this->part(seed, robot_.braking(), RequirementName::kPromise);
    if (!part) continue;
    ++promised;
    const Motion& motion = part->motion;
    const Motion heard = quantised(motion);
    EXPECT_EQ(heard.start_time(), motion.start_time()) << seed;
    EXPECT_EQ(heard.end_time(), motion.end_time()) << seed;
    ASSERT_EQ(heard.phases().size(), motion.phases().size()) << seed;
    for (double t = motion.start_time(); t < motion.end_time(); t += 0.05)
      EXPECT_EQ(heard.position(t), motion.position(t)) << seed;
    const auto driven = splice(committed, now_s, motion.start_time(), motion);
    ASSERT_TRUE(driven) << seed << ": " << describe(driven.fault);
    const Violation violation =
        certify(driven.motion, robot_.footprint, scene,
                requirements_[RequirementName::kPromise].from(now_s).joining_at(join_s));
    EXPECT_FALSE(violation) << seed << ": " << describe(violation);
  }
  EXPECT_GT(promised, kSeeds / 2);
}

TEST_P(RandomParts, BrakingKeepsTheLimitsOfDriving) {
  expect_braking_within(robot_.braking(), RequirementName::kPromise, robot_.limits);
}

TEST_P(RandomParts, HardBrakingKeepsTheLimitsOfAnEmergency) {
  expect_braking_within(robot_.hard_braking(), RequirementName::kRenewal,
                        robot_.emergency_limits());
}

INSTANTIATE_TEST_SUITE_P(Robots, RandomParts, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
