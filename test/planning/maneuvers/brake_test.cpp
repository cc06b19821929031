#include "planning/maneuvers/brake.h"

#include <gtest/gtest.h>

#include "planning/maneuver_test.h"
#include "trajectory/random_motion.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class BrakeTest : public ManeuverTest {
 protected:
  LocalScene with_peer_at(const Vector2& place) const {
    LocalScene scene = scene_of(open_);
    scene.peers = {peer(standing(kNow_s - 9.0, place, 0.0))};
    return scene;
  }
  Motion part(const ManeuverStart& start, const Maneuver& maneuver) const {
    const auto part = certified_part(start, maneuver, RequirementName::kNone);
    EXPECT_TRUE(part);
    return part->motion;
  }

  const OccupancyGrid open_ = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const Motion ahead_ = straight_drive(kNow_s - 3.0, {-2.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
};

TEST_F(BrakeTest, SoonIsAtOnceWhereNoPeerIsNear) {
  const LocalScene alone = with_peer_at({9.0, 6.0});
  const LocalScene beside = with_peer_at(ahead_.position(kNow_s) + Vector2(0.0, 3.0));
  const ManeuverStart start = start_of(ahead_, alone, kNow_s);
  const Maneuver at_once = brake_soon(start).at(0);
  EXPECT_TRUE(at_once.at_once);
  EXPECT_EQ(at_once.brake_from_s, start.emergency_s);
  EXPECT_EQ(at_once.brake_until_s, start.emergency_s);
  const Maneuver settled = brake_soon(start_of(ahead_, beside, kNow_s)).at(0);
  EXPECT_FALSE(settled.at_once);
  EXPECT_EQ(settled.brake_from_s, start.settled_s);
  EXPECT_EQ(settled.brake_until_s, start.settled_s);
  EXPECT_EQ(settled.join_s, start.settled_s);
}

TEST_F(BrakeTest, InTimeIsWithinWhatIsCommitted) {
  const LocalScene scene = scene_of(open_);
  const ManeuverStart start = start_of(ahead_, scene, kNow_s);
  const Maneuver settled = brake_in_time(start).at(0);
  EXPECT_FALSE(settled.at_once);
  EXPECT_EQ(settled.brake_from_s, start.settled_s);
  EXPECT_EQ(settled.brake_until_s, ahead_.end_time());
  const Maneuver at_once = brake_in_time_at_once(start).at(0);
  EXPECT_TRUE(at_once.at_once);
  EXPECT_EQ(at_once.brake_from_s, start.emergency_s);
  EXPECT_EQ(at_once.brake_until_s, start.settled_s) << "later, it can be settled";
}

TEST_F(BrakeTest, HardStopsInLessWay) {
  const LocalScene scene = scene_of(open_);
  const ManeuverStart start = start_of(ahead_, scene, kNow_s);
  const Motion soon = part(start, brake_soon(start).at(0));
  const Motion hard = part(start, brake_hard(start).at(0));
  const double speed = ahead_.at(start.emergency_s).speed;
  const double jerk_m = 0.15 * speed;  // until it brakes with all of its deceleration
  EXPECT_NEAR(soon.length_m(), speed * speed / (2.0 * robot_.braking().deceleration()), jerk_m);
  EXPECT_NEAR(hard.length_m(), speed * speed / (2.0 * robot_.hard_braking().deceleration()),
              jerk_m);
  EXPECT_LT(hard.length_m(), 0.7 * soon.length_m());
  for (const Motion* stop : {&soon, &hard}) EXPECT_EQ(stop->start_time(), start.emergency_s);
}

TEST_F(BrakeTest, EachBrakesAlongWhatIsCommitted) {
  const LocalScene scene = scene_of(open_);
  for (int seed = 0; seed < 10; ++seed) {
    const Motion winding =
        within(random_drive(seed, 8, seed % 2 == 0 ? 1 : -1), {0.9, 0.6, 1.2}, kNow_s - 2.0);
    const ManeuverStart start = start_of(winding, scene, kNow_s);
    for (const auto& make : {brake_soon, brake_in_time, brake_in_time_at_once, brake_hard}) {
      const Maneuvers maneuvers = make(start);
      ASSERT_EQ(maneuvers.size(), 1u);
      EXPECT_EQ(maneuvers[0].follows, Follows::kCommitted);
      EXPECT_EQ(maneuvers[0].join_s, maneuvers[0].at_once ? start.emergency_s : start.settled_s);
      const Motion stop = part(start, maneuvers[0]);
      const Vector2 rest = stop.end_pose().position;
      double off_m = 1e9;
      for (double t = kNow_s; t < winding.end_time(); t += 0.005)
        off_m = std::min(off_m, (winding.position(t) - rest).norm());
      EXPECT_LT(off_m, 0.01) << seed;
    }
  }
}

}  // namespace
}  // namespace mocha
