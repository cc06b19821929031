#include "perception/pose_graph/map_merging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "perception/pose_graph/mapping_scene.h"

namespace mocha {
namespace {

using Fault = MapMatch::Fault;

constexpr std::size_t kHits = 180;

class MapMergingTest : public testing::Test {
 protected:
  MapMergingTest()
      : options_(shipped_mapper_options(load_robot_model("config", "waveshare_rover"))) {}

  static MappingDrive office(const Pose& start, const std::vector<Vector2>& way, int seed) {
    MappingDrive drive = mapping_drive("config/worlds/office.yaml", start, way, seed);
    for (ScanHits& scan : drive.scans) scan.time_s += 1000.0 * seed;
    return drive;
  }

  DrivenMap mapped(const MappingDrive& drive) const {
    GraphMapper mapper(options_);
    for (std::size_t i = 0; i < drive.scans.size(); ++i)
      mapper.add(drive.scans[i], drive.odometry[i]);
    mapper.finish();
    return {mapper.graph(), mapper.keyframes()};
  }

  MergedMaps merge(const DrivenMap& map, const DrivenMap& other) const {
    return merged(map, other, options_.loops, kHits);
  }

  GraphMapperOptions options_;
};

TEST_F(MapMergingTest, MakesOneMapOfTwoThatShareACorridor) {
  const MappingDrive one = office({{2.0, 10.0}, -1.57}, {{2.0, 6.0}, {13.0, 6.0}}, 1);
  const MappingDrive two =
      office({{18.0, 2.0}, 1.57}, {{18.0, 6.0}, {8.0, 6.0}, {6.0, 6.1}, {6.0, 8.0}}, 2);
  const DrivenMap first = mapped(one);
  const MergedMaps both = merge(first, mapped(two));
  ASSERT_EQ(both.fault, Fault::kNone);
  EXPECT_EQ(both.map.graph.size(), static_cast<int>(both.map.keyframes.size()));
  EXPECT_GT(both.map.graph.size(), first.graph.size() + 10);
  EXPECT_EQ(distance_m(both.map.graph.poses()[0], first.graph.poses()[0]), 0.0);
  const std::vector<double> errors_m =
      keyframe_errors_m(both.map.graph, both.map.keyframes, {one, two});
  EXPECT_LT(quantile(errors_m, 0.5), 0.02);
  EXPECT_LT(quantile(errors_m, 1.0), 0.05);
}

/// Whatever bends either of the maps, or both, ends where they were merged.
TEST_F(MapMergingTest, ConnectsAllPlacesThatBothHaveSeen) {
  const MappingDrive one = office({{2.0, 10.0}, -1.57}, {{2.0, 6.0}, {18.0, 6.0}}, 3);
  const MappingDrive two = office({{18.0, 6.0}, 3.14}, {{2.0, 6.0}, {2.0, 10.0}}, 4);
  const DrivenMap first = mapped(one);
  const MergedMaps both = merge(first, mapped(two));
  ASSERT_EQ(both.fault, Fault::kNone);
  std::vector<bool> is_linked(both.map.keyframes.size(), false);
  for (const Constraint& constraint : both.map.graph.constraints()) {
    if (constraint.from < first.graph.size() && constraint.to >= first.graph.size())
      is_linked[constraint.to] = true;
  }
  const auto linked = std::count(is_linked.begin(), is_linked.end(), true);
  EXPECT_GT(linked, 0.9 * (both.map.graph.size() - first.graph.size()));
}

/// A bare hall looks the same from either end.
TEST_F(MapMergingTest, MergesNoMapsThatMayLieInTwoWays) {
  const std::string hall = ::testing::TempDir() + "map_merging_test_hall.yaml";
  std::ofstream(hall) << R"(bounds: {min: [-6.2, -3.2], max: [6.2, 3.2]}
polygons:
  - [[-6.2, 3.0], [6.2, 3.0], [6.2, 3.2], [-6.2, 3.2]]
  - [[-6.2, -3.2], [6.2, -3.2], [6.2, -3.0], [-6.2, -3.0]]
  - [[-6.2, -3.0], [-6.0, -3.0], [-6.0, 3.0], [-6.2, 3.0]]
  - [[6.0, -3.0], [6.2, -3.0], [6.2, 3.0], [6.0, 3.0]]
)";
  const DrivenMap one = mapped(mapping_drive(hall, {{-4.0, 1.0}, 0.0}, {{4.0, 1.5}}, 7));
  const DrivenMap two = mapped(mapping_drive(hall, {{4.0, -1.5}, 3.0}, {{-3.0, -1.0}}, 8));
  EXPECT_EQ(merge(one, two).fault, Fault::kAmbiguous);
  EXPECT_TRUE(merge(one, two).map.keyframes.empty());
}

TEST_F(MapMergingTest, MergesNoMapsOfPlacesThatAreNotTheSame) {
  const DrivenMap office_map = mapped(office({{2.0, 10.0}, -1.57}, {{2.0, 6.0}, {10.0, 6.0}}, 5));
  const DrivenMap flat =
      mapped(mapping_drive("config/worlds/flat.yaml", {{0.0, 0.0}, 0.0},
                           {{2.0, 1.05}, {4.0, 1.2}, {4.85, 3.2}, {6.2, 3.3}}, 6));
  EXPECT_EQ(merge(office_map, flat).fault, Fault::kNothingInCommon);
  EXPECT_EQ(merge(flat, office_map).fault, Fault::kNothingInCommon);
  EXPECT_EQ(merge({}, flat).fault, Fault::kNothingInCommon);
  EXPECT_EQ(merge(flat, {}).fault, Fault::kNothingInCommon);
}

}  // namespace
}  // namespace mocha
