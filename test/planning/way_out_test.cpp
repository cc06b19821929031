#include "planning/way_out.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kPerson_m = 0.25;

class WayOutTest : public ::testing::Test {
 protected:
  PromiseScene with(const Vector2& place, const Vector2& velocity) const {
    PromiseScene scene{field_, unseen_};
    scene.moving = {std::make_shared<PredictedDisc>("person", kNow_s, here() + place, velocity,
                                                    kPerson_m, 0.0)};
    scene.predicted_until_s = kNow_s + 5.0;
    return scene;
  }
  Vector2 here() const { return ahead_.position(kNow_s); }

  /// Between the bodies, while somebody walks on for ten seconds.
  double least_gap_m(const Motion& motion, const PromiseScene& scene) const {
    double least_m = std::numeric_limits<double>::infinity();
    const double own_m = robot_.footprint.circumscribed_radius_m();
    for (double t = kNow_s; t < kNow_s + 10.0; t += 0.01) {
      const auto disc = scene.moving[0]->at(t);
      least_m =
          std::min(least_m, (motion.position(t) - disc.centre).norm() - disc.radius_m - own_m);
    }
    return least_m;
  }
  Motion done(const WayOut::Choice& choice) const {
    if (choice.motion.empty()) return ahead_;
    return continued(ahead_, kNow_s, choice.motion.start_time(), choice.motion);
  }

  const RobotModel robot_ = rover();
  const WayOut way_out_{robot_};
  const OccupancyGrid open_ = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const std::shared_ptr<const DistanceField> field_ = occupied_field(open_);
  const std::shared_ptr<const DistanceField> unseen_ = unseen_field(open_);
  const Motion ahead_ = straight_drive(kNow_s - 3.0, {-2.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  const WayOut::Times times_{kNow_s, kNow_s + 0.1, kNow_s + 0.3};
};

TEST_F(WayOutTest, DodgesWhoComesTooFastToBrakeFor) {
  for (const double side : {-1.0, 1.0}) {
    const PromiseScene scene = with({1.9, 0.35 * side}, {-1.0, 0.0});
    ASSERT_FALSE(way_out_.proved(ahead_, times_, scene, true));
    const auto choice = way_out_.least_bad(ahead_, times_, scene, true);
    EXPECT_EQ(choice.what.find("dodges"), 0u) << choice.what;
    EXPECT_TRUE(choice.emergency);
    EXPECT_GT(least_gap_m(done(choice), scene), 0.0);
    EXPECT_LT(side * choice.motion.end_pose().position.y(), -0.1);
  }
}

/// Who comes so fast that the bodies may touch, whatever is done, is at least not waited for.
TEST_F(WayOutTest, RatherGrazesThanIsRunOver) {
  for (const double ahead_m : {1.4, 1.5, 1.6}) {
    const PromiseScene scene = with({ahead_m, 0.3}, {-1.0, 0.0});
    const auto choice = way_out_.least_bad(ahead_, times_, scene, true);
    EXPECT_EQ(choice.what.find("brakes"), std::string::npos) << ahead_m;
    EXPECT_GT(least_gap_m(done(choice), scene), -0.15) << ahead_m;
  }
}

/// Where a whole row of people may be in ten seconds is no reason to be run over now.
TEST_F(WayOutTest, DodgesWhateverOthersMayDoMuchLater) {
  PromiseScene scene = with({1.9, 0.35}, {-1.0, 0.0});
  for (double x = -4.0; x < 8.0; x += 0.6) {
    scene.moving.push_back(std::make_shared<PredictedDisc>(
        "walker", kNow_s, here() + Vector2(x, 10.0), Vector2(0.0, -1.0), kPerson_m, 0.0));
  }
  const auto choice = way_out_.least_bad(ahead_, times_, scene, true);
  EXPECT_EQ(choice.what.find("dodges"), 0u) << choice.what;
  EXPECT_GT(least_gap_m(done(choice), scene), 0.0);
}

TEST_F(WayOutTest, DoesNotDodgeBesideATeamMate) {
  PromiseScene scene = with({1.9, 0.35}, {-1.0, 0.0});
  const auto stands =
      std::make_shared<const Motion>(standing(kNow_s - 9.0, here() + Vector2(0.0, 4.0), 0.0));
  scene.others = {std::make_shared<PeerObstacle>("ugv2", stands, 0.3)};
  const auto choice = way_out_.least_bad(ahead_, times_, scene, true);
  EXPECT_EQ(choice.what.find("dodges"), std::string::npos);
  EXPECT_FALSE(choice.emergency && choice.what.find("brakes") != 0u) << choice.what;
}

TEST_F(WayOutTest, DoesNotDodgeIntoAWall) {
  OccupancyGrid walled = open_;
  fill_box(walled, {-8.0, 0.5}, {12.0, 8.0});
  fill_box(walled, {-8.0, -8.0}, {12.0, -0.5});
  PromiseScene scene = with({1.9, 0.0}, {-1.0, 0.0});
  scene.obstacles = occupied_field(walled);
  scene.unseen = unseen_field(walled);
  const auto choice = way_out_.least_bad(ahead_, times_, scene, true);
  const Motion driven = done(choice);
  for (double t = kNow_s; t < driven.end_time(); t += 0.02) {
    EXPECT_GE(scene.obstacles->distance_bound(driven.position(t)),
              robot_.footprint.circumscribed_radius_m());
  }
}

/// Straight back he would follow, and sooner or later be there.
TEST_F(WayOutTest, StepsOutOfTheWayNotAlongIt) {
  const Motion stands = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  PromiseScene scene{field_, unseen_};
  scene.moving = {std::make_shared<PredictedDisc>("person", kNow_s, Vector2(1.6, 0.05),
                                                  Vector2(-0.4, 0.0), kPerson_m, 0.0)};
  scene.predicted_until_s = kNow_s + 5.0;
  for (const auto& choice : {way_out_.aside(stands, times_, scene).value(),
                             way_out_.least_bad(stands, times_, scene, true)}) {
    const Motion onward = continued(stands, kNow_s, choice.motion.start_time(), choice.motion);
    EXPECT_GT(least_gap_m(onward, scene), 0.0) << choice.what;
  }
}

TEST_F(WayOutTest, BrakesWhereWhatIsInTheWayDoesNotMove) {
  const auto choice = way_out_.least_bad(ahead_, times_, with({0.8, 0.0}, {0.0, 0.0}), false);
  EXPECT_EQ(choice.what, "brakes at once all the same");
  EXPECT_TRUE(choice.emergency);
}

}  // namespace
}  // namespace mocha
