#include "perception/pose_graph/graph_mapper.h"

#include <gtest/gtest.h>

#include <limits>

#include "perception/pose_graph/mapping_scene.h"

namespace mocha {
namespace {

class GraphMapperTest : public testing::Test {
 protected:
  GraphMapperTest()
      : model_(load_robot_model("config", "waveshare_rover")),
        mapper_(shipped_mapper_options(model_)) {}

  void drive(const MappingDrive& drive) {
    for (std::size_t i = 0; i < drive.scans.size(); ++i)
      pose_ = mapper_.add(drive.scans[i], drive.odometry[i]).pose;
    mapper_.finish();
  }

  RobotModel model_;
  GraphMapper mapper_;
  Pose pose_;
};

TEST_F(GraphMapperTest, MapsAnOfficeInWhichItComesBackAnotherWay) {
  const MappingDrive office =
      mapping_drive("config/worlds/office.yaml", {{1.0, 11.0}, 0.0}, office_loop(), 3);
  // What the odometry believes.
  EXPECT_GT(quantile(absolute_errors_m(office.odometry, office.truth), 0.5), 0.3);
  drive(office);
  const std::vector<double> errors_m =
      keyframe_errors_m(mapper_.graph(), mapper_.keyframes(), {office});
  EXPECT_LT(quantile(errors_m, 0.5), 0.02);
  EXPECT_LT(quantile(errors_m, 1.0), 0.04);
}

TEST_F(GraphMapperTest, MapsTheFlat) {
  const MappingDrive flat = mapping_drive("config/worlds/flat.yaml", {{0.0, 0.0}, 0.0},
                                          {{2.0, 1.05},
                                           {4.0, 1.2},
                                           {4.85, 3.2},
                                           {6.2, 3.3},
                                           {4.85, 2.8},
                                           {4.0, 1.1},
                                           {2.2, 1.0},
                                           {0.2, 1.5},
                                           {0.3, 4.2},
                                           {2.4, 4.2},
                                           {2.4, 1.2},
                                           {0.0, 0.0}},
                                          5);
  drive(flat);
  EXPECT_LT(quantile(keyframe_errors_m(mapper_.graph(), mapper_.keyframes(), {flat}), 1.0), 0.03);
}

TEST_F(GraphMapperTest, GoesOnWhereItIsWhenTheOdometryBeginsAnew) {
  MappingDrive office =
      mapping_drive("config/worlds/office.yaml", {{1.0, 11.0}, 0.0}, office_loop(), 4);
  const std::size_t half = office.scans.size() / 2;
  const Pose before = office.odometry[half];
  for (std::size_t i = half; i < office.scans.size(); ++i)
    office.odometry[i] = composed({{50.0, 80.0}, 2.0}, relative(before, office.odometry[i]));
  drive(office);
  EXPECT_LT(quantile(keyframe_errors_m(mapper_.graph(), mapper_.keyframes(), {office}), 1.0), 0.04);
}

/// Two rooms that look the same, of which the second is entered after a long way, are not taken for
/// each other.
TEST_F(GraphMapperTest, DoesNotTakeOneRoomForAnother) {
  const MappingDrive office = mapping_drive(
      "config/worlds/office.yaml", {{6.0, 2.0}, 1.57},
      {{6.0, 6.0}, {14.0, 6.0}, {14.0, 2.0}, {13.0, 3.0}, {14.0, 6.0}, {18.0, 6.0}, {18.0, 2.0}},
      6);
  drive(office);
  EXPECT_LT(quantile(keyframe_errors_m(mapper_.graph(), mapper_.keyframes(), {office}), 1.0), 0.04);
}

TEST_F(GraphMapperTest, JoinsASecondDriveToTheFirst) {
  const std::vector<Vector2> way = office_loop();
  const MappingDrive first = mapping_drive("config/worlds/office.yaml", {{1.0, 11.0}, 0.0}, way, 7);
  MappingDrive second = mapping_drive("config/worlds/office.yaml", {{10.0, 6.0}, 3.14},
                                      {{6.0, 6.0}, {6.0, 9.0}, {6.0, 6.0}, {14.0, 6.0}}, 8);
  for (ScanHits& scan : second.scans) scan.time_s += 1000.0;
  drive(first);
  const int keyframes = mapper_.graph().size();
  const Pose start = relative(first.truth.front(), second.truth.front());
  mapper_.begin({{start.position + Vector2(0.2, -0.1), start.yaw_rad + 0.1},
                 Eigen::Vector3d(0.1, 0.1, 0.03).asDiagonal()});
  drive(second);
  ASSERT_GT(mapper_.graph().size(), keyframes + 5);
  EXPECT_TRUE(mapper_.graph().uncertainties(0, 1.0)[keyframes].is_known);
  EXPECT_LT(quantile(keyframe_errors_m(mapper_.graph(), mapper_.keyframes(), {first, second}), 1.0),
            0.04);
}

TEST_F(GraphMapperTest, BelievesTheOdometryWhereNothingIsSeen) {
  ScanHits blind;
  for (int i = 0; i < 10; ++i) {
    blind.time_s = i + 1.0;
    pose_ = mapper_.add(blind, {{0.3 * i, 0.0}, 0.0}).pose;
  }
  EXPECT_LT(distance_m(pose_, {{2.7, 0.0}, 0.0}), 1e-6);
  EXPECT_EQ(mapper_.explained(), 0.0);
}

TEST_F(GraphMapperTest, RefusesWhatNoLidarMeasures) {
  ScanHits scan;
  scan.time_s = 1.0;
  scan.hits = {{1.0, 0.0}, {1.0, 0.1}};
  mapper_.add(scan, {});
  EXPECT_THROW(mapper_.add(scan, {}), std::invalid_argument);  // not newer
  scan.time_s = 2.0;
  scan.hits[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(mapper_.add(scan, {}), std::invalid_argument);
  scan.hits[0].x() = 1.0;
  EXPECT_THROW(mapper_.add(scan, {{1e9, 0.0}, 0.0}), std::invalid_argument);
  EXPECT_EQ(mapper_.graph().size(), 1);
}

}  // namespace
}  // namespace mocha
