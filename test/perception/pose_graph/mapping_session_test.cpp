#include "perception/pose_graph/mapping_session.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "perception/pose_graph/mapping_scene.h"

namespace mocha {
namespace {

using State = Localization::State;

class MappingSessionTest : public testing::Test {
 protected:
  static MappingSession session(DrivenMap map = {}) {
    const RobotModel model = load_robot_model("config", "waveshare_rover");
    auto values = ParameterTable::from_schema("config/scan_localizer.yaml");
    values.assign(YAML::Load("{mapping: true}"), "the test");
    return {shipped_mapper_options(model), ScanLocalizerOptions::from(values, model),
            std::move(map)};
  }

  static MappingDrive flat(const std::vector<Vector2>& way, const Pose& start, int seed) {
    return mapping_drive("config/worlds/flat.yaml", start, way, seed);
  }
};

TEST_F(MappingSessionTest, KnowsItsPlaceFromTheFirstScanOn) {
  MappingSession mapping = session();
  const MappingDrive drive = flat({{2.0, 1.05}, {4.0, 1.2}, {4.85, 3.2}}, {{0.0, 0.0}, 0.0}, 1);
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    const Localization& now = mapping.add(drive.scans[i], drive.odometry[i]);
    ASSERT_EQ(now.state, State::kLocalized);
    EXPECT_EQ(now.time_s, drive.scans[i].time_s);
    const Pose again = composed(now.odom_in_map, drive.odometry[i]);
    EXPECT_LT(distance_m(again, now.base.pose), 1e-9);
    EXPECT_LT(std::sqrt(now.base.covariance.topLeftCorner<2, 2>().trace()), 0.05);
  }
  EXPECT_LT(distance_m(mapping.localization().base.pose,
                       relative(drive.truth.front(), drive.truth.back())),
            0.1);
}

TEST_F(MappingSessionTest, GoesOnInAMapOfAnEarlierDrive) {
  MappingSession first = session();
  const MappingDrive one =
      flat({{2.0, 1.05}, {4.0, 1.2}, {4.85, 3.2}, {4.0, 1.1}, {0.3, 1.5}}, {{0.0, 0.0}, 0.0}, 2);
  for (std::size_t i = 0; i < one.scans.size(); ++i) first.add(one.scans[i], one.odometry[i]);
  const int keyframes = first.mapper().graph().size();

  MappingSession second = session({first.mapper().graph(), first.mapper().keyframes()});
  const MappingDrive two = flat({{2.4, 1.2}, {2.4, 4.2}, {0.3, 4.2}}, {{4.0, 1.2}, 3.0}, 3);
  EXPECT_TRUE(second.is_looking());
  std::size_t found = 0;
  for (std::size_t i = 0; i < two.scans.size(); ++i) {
    const Localization& now = second.add(two.scans[i], two.odometry[i]);
    if (now.state == State::kLocalized && found == 0) found = i;
    if (found > 0) {
      ASSERT_EQ(now.state, State::kLocalized);
    }
  }
  EXPECT_GT(found, 0u);
  EXPECT_FALSE(second.is_looking());
  EXPECT_GT(second.mapper().graph().size(), keyframes + 3);
  EXPECT_LT(
      distance_m(second.localization().base.pose, relative(one.truth.front(), two.truth.back())),
      0.1);
  second.forget();
  EXPECT_TRUE(second.is_looking());
  EXPECT_EQ(second.mapper().graph().size(), keyframes);
}

TEST_F(MappingSessionTest, IsHelpedToFindItsPlace) {
  MappingSession first = session();
  const MappingDrive one = flat({{2.0, 1.05}, {4.0, 1.2}}, {{0.0, 0.0}, 0.0}, 4);
  for (std::size_t i = 0; i < one.scans.size(); ++i) first.add(one.scans[i], one.odometry[i]);
  MappingSession second = session({first.mapper().graph(), first.mapper().keyframes()});
  const Pose start = relative(one.truth.front(), one.truth[20]);
  second.expect({{start.position + Vector2(0.2, 0.1), start.yaw_rad + 0.1},
                 Eigen::Vector3d(0.1, 0.1, 0.05).asDiagonal()});
  for (std::size_t i = 20; i < one.scans.size(); ++i) second.add(one.scans[i], one.odometry[i]);
  EXPECT_FALSE(second.is_looking());
  EXPECT_LT(
      distance_m(second.localization().base.pose, relative(one.truth.front(), one.truth.back())),
      0.1);
}

TEST_F(MappingSessionTest, GoesOnWhereItIsWhenAnotherMapIsMergedIn) {
  MappingSession first = session();
  const MappingDrive one =
      flat({{2.0, 1.05}, {4.0, 1.2}, {4.85, 3.2}, {6.2, 3.3}}, {{0.0, 0.0}, 0.0}, 7);
  for (std::size_t i = 0; i < one.scans.size(); ++i) first.add(one.scans[i], one.odometry[i]);
  MappingSession second = session();
  const MappingDrive two =
      flat({{2.4, 1.2}, {2.4, 4.2}, {0.3, 4.2}, {2.4, 4.2}, {2.4, 1.2}}, {{4.0, 1.2}, 3.0}, 8);
  const std::size_t half = two.scans.size() / 2;
  for (std::size_t i = 0; i < half; ++i) second.add(two.scans[i], two.odometry[i]);
  const int keyframes = second.mapper().graph().size();

  ASSERT_EQ(second.merge({first.mapper().graph(), first.mapper().keyframes()}),
            MapMatch::Fault::kNone);
  EXPECT_EQ(second.mapper().graph().size(), keyframes + first.mapper().graph().size());
  EXPECT_FALSE(second.is_looking());
  for (std::size_t i = half; i < two.scans.size(); ++i) {
    const Localization& now = second.add(two.scans[i], two.odometry[i]);
    ASSERT_EQ(now.state, State::kLocalized);
    EXPECT_LT(distance_m(now.base.pose, relative(two.truth.front(), two.truth[i])), 0.1);
  }
  EXPECT_GT(second.mapper().graph().size(), keyframes + first.mapper().graph().size() + 3);

  const MappingDrive elsewhere =
      mapping_drive("config/worlds/office.yaml", {{14.0, 2.0}, 0.0}, {{14.0, 3.5}}, 9);
  MappingSession third = session();
  for (std::size_t i = 0; i < elsewhere.scans.size(); ++i)
    third.add(elsewhere.scans[i], elsewhere.odometry[i]);
  const int all = second.mapper().graph().size();
  EXPECT_EQ(second.merge({third.mapper().graph(), third.mapper().keyframes()}),
            MapMatch::Fault::kNothingInCommon);
  EXPECT_EQ(second.mapper().graph().size(), all);
}

TEST_F(MappingSessionTest, SaysNothingOfAPlaceThatIsNotInTheMap) {
  MappingSession first = session();
  const MappingDrive one = flat({{1.0, 0.5}}, {{0.0, 0.0}, 0.0}, 5);
  for (std::size_t i = 0; i < one.scans.size(); ++i) first.add(one.scans[i], one.odometry[i]);
  MappingSession second = session({first.mapper().graph(), first.mapper().keyframes()});
  const MappingDrive other =
      mapping_drive("config/worlds/office.yaml", {{14.0, 2.0}, 0.0}, {{14.0, 3.5}}, 6);
  for (std::size_t i = 0; i < other.scans.size(); ++i)
    EXPECT_NE(second.add(other.scans[i], other.odometry[i]).state, State::kLocalized);
  EXPECT_TRUE(second.is_looking());
}

}  // namespace
}  // namespace mocha
