#include "perception/sensor/planar_scan.h"

#include <gtest/gtest.h>

#include "perception/room.h"

namespace mocha {
namespace {

PlanarScan four_beams() {
  PlanarScan scan;
  scan.angle_min_rad = 0.0;
  scan.angle_increment_rad = M_PI / 2.0;
  scan.angle_max_rad = 1.5 * M_PI;
  scan.range_min_m = 0.1;
  scan.range_max_m = 8.0;
  scan.ranges_m = {1.0F, 2.0F, 3.0F, 4.0F};
  return scan;
}

const SweepPoses kStill{sensor_pose({{1.0, 2.0}, M_PI / 2.0}),
                        sensor_pose({{1.0, 2.0}, M_PI / 2.0})};

TEST(PlanarScan, EndsAreInTheMapFrame) {
  const auto beams = to_beams(four_beams(), kStill, {30.0, 10.0});
  ASSERT_EQ(beams.size(), 4u);
  EXPECT_TRUE(beams[0].end.isApprox(Vector3(1.0, 3.0, 0.2), 1e-6));
  EXPECT_TRUE(beams[1].end.isApprox(Vector3(-1.0, 2.0, 0.2), 1e-6));
  EXPECT_TRUE(beams[3].origin.isApprox(Vector3(1.0, 2.0, 0.2), 1e-6));
}

TEST(PlanarScan, RangesWithoutReturnClearAndInvalidOnesAreLeftOut) {
  PlanarScan scan = four_beams();
  scan.ranges_m = {std::numeric_limits<float>::infinity(), std::nanf(""), 0.05F, 9.0F};
  const auto beams = to_beams(scan, kStill, {30.0, 5.0});
  ASSERT_EQ(beams.size(), 2u);
  for (const Beam& beam : beams) {
    EXPECT_EQ(beam.kind, BeamEnd::kMiss);
    EXPECT_NEAR((beam.end - beam.origin).norm(), 5.0, 1e-6);
  }
}

TEST(PlanarScan, ALostBeamDoesNotClearThroughTheWall) {
  PlanarScan scan = four_beams();
  scan.angle_increment_rad = 0.01;
  scan.angle_max_rad = 0.05;
  const float lost = std::numeric_limits<float>::infinity();
  scan.ranges_m = {2.0F, lost, 2.2F, lost, lost, lost};
  const auto beams = to_beams(scan, kStill, {30.0, 5.0});
  EXPECT_NEAR((beams[1].end - beams[1].origin).norm(), 2.0, 1e-6);
  EXPECT_NEAR((beams[4].end - beams[4].origin).norm(), 2.2, 1e-6);
  EXPECT_NEAR((beams[5].end - beams[5].origin).norm(), 5.0, 1e-6) << "nothing is there";
}

TEST(PlanarScan, ReachLimitsHitsAndClearing) {
  const auto beams = to_beams(four_beams(), kStill, {2.5, 3.5});
  EXPECT_EQ(beams[1].kind, BeamEnd::kHit);
  EXPECT_EQ(beams[2].kind, BeamEnd::kMiss);
  EXPECT_NEAR((beams[2].end - beams[2].origin).norm(), 3.0, 1e-6) << "not beyond what was measured";
  EXPECT_NEAR((beams[3].end - beams[3].origin).norm(), 3.5, 1e-6);
}

TEST(PlanarScan, FaultsAreNamed) {
  EXPECT_EQ(fault_of(four_beams()), "");
  const auto fault = [](auto change) {
    PlanarScan scan = four_beams();
    change(scan);
    return fault_of(scan);
  };
  EXPECT_NE(fault([](PlanarScan& s) { s.ranges_m.clear(); }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.angle_increment_rad = std::nan(""); }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.angle_increment_rad = 0.0; }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.angle_min_rad = INFINITY; }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.range_max_m = s.range_min_m; }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.range_max_m = std::nan(""); }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.range_min_m = -1.0; }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.ranges_m.resize(40, 1.0F); }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.time_increment_s = -0.001; }), "");
  EXPECT_NE(fault([](PlanarScan& s) { s.time_increment_s = 1.0; }), "");
}

TEST(PlanarScan, DeskewingPutsEveryBeamOnTheWall) {
  const Room room;
  const auto pose_at = [](double share) {
    return Pose{{-1.0 + 0.2 * share, 0.1 * share}, 3.0 + 0.4 * share};
  };
  const PlanarScan scan = sweep(room, pose_at, 20.0, 720, 0.1);
  const auto farthest_off_wall = [&](const SweepPoses& poses) {
    double farthest = 0.0;
    for (const Beam& beam : to_beams(scan, poses, {30.0, 10.0})) {
      const Vector2 end = beam.end.head<2>();
      const double off =
          std::min((end - room.low).cwiseAbs().minCoeff(), (end - room.high).cwiseAbs().minCoeff());
      farthest = std::max(farthest, off);
    }
    return farthest;
  };
  const Eigen::Isometry3d first = sensor_pose(pose_at(0.0));
  const Eigen::Isometry3d last = sensor_pose(pose_at(1.0));
  EXPECT_LT(farthest_off_wall({first, last}), 1e-5);
  EXPECT_GT(farthest_off_wall({first, first}), 0.5);
}

TEST(PlanarScan, BeamsCarryTheirTimes) {
  PlanarScan scan = four_beams();
  scan.start_time_s = 100.0;
  scan.time_increment_s = 0.02;
  const auto beams = to_beams(scan, kStill, {30.0, 10.0});
  EXPECT_DOUBLE_EQ(beams[0].time_s, 100.0);
  EXPECT_DOUBLE_EQ(beams[3].time_s, scan.end_time_s());
}

}  // namespace
}  // namespace mocha
