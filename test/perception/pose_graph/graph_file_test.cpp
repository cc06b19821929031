#include "perception/pose_graph/graph_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace mocha {
namespace {

class GraphFileTest : public testing::Test {
 protected:
  GraphFileTest()
      : path_((std::filesystem::temp_directory_path() / "mocha_graph_file_test.g2o").string()) {}
  ~GraphFileTest() override { std::filesystem::remove(path_); }

  std::string error_of(const std::string& text) {
    std::ofstream(path_) << text;
    try {
      load_driven_map(path_);
    } catch (const MapError& error) {
      return error.what();
    }
    return "none";
  }

  std::string path_;
};

const std::string kVertex = "VERTEX_SE2 0 1 2 0.5\nKEYFRAME 3 0 0 0 0.1 0 2 1 0 1 0.5 1 7 0\n";
const std::string kSecond = "VERTEX_SE2 1 2 2 0.5\nKEYFRAME 4 1 0 0 0.1 0 0 0\n";

TEST_F(GraphFileTest, KeepsAMap) {
  DrivenMap map;
  map.graph.add_keyframe({{1.0, -2.0}, 0.5});
  map.graph.add_keyframe({{1.123456789, 12.0}, -3.0});
  map.keyframes.resize(2);
  map.keyframes[0].scan.time_s = 1700000000.123;
  map.keyframes[0].scan.sensor = {0.1, 0.0};
  map.keyframes[0].scan.hits = {{1.2345, -0.5}, {3.0, 4.0}};
  map.keyframes[0].scan.misses = {{8.0, 0.5}};
  map.keyframes[1].scan.time_s = 1700000001.0;
  map.keyframes[1].odometry = {{7.0, 8.0}, 0.25};
  Eigen::Matrix3d information;
  information << 4.0, 1.0, 0.5, 1.0, 5.0, 0.25, 0.5, 0.25, 6.0;
  map.graph.add({0, 1, {{0.1, 14.0}, -3.0}, information, true});
  map.graph.add({1, 0, {{-0.1, 14.0}, 3.0}, information, false});
  save_driven_map(map, path_);
  const DrivenMap read = load_driven_map(path_);
  ASSERT_EQ(read.graph.size(), 2);
  EXPECT_NEAR(read.graph.poses()[1].position.x(), 1.123456789, 1e-9);
  EXPECT_EQ(read.graph.poses()[1].yaw_rad, -3.0);
  EXPECT_NEAR(read.keyframes[0].scan.time_s, 1700000000.123, 1e-2);
  EXPECT_EQ(read.keyframes[0].scan.sensor, Vector2(0.1, 0.0));
  ASSERT_EQ(read.keyframes[0].scan.hits.size(), 2u);
  EXPECT_LT((read.keyframes[0].scan.hits[0] - Vector2(1.2345, -0.5)).norm(), 1e-3);
  EXPECT_EQ(read.keyframes[0].scan.misses, map.keyframes[0].scan.misses);
  EXPECT_EQ(read.keyframes[1].odometry.position, Vector2(7.0, 8.0));
  ASSERT_EQ(read.graph.constraints().size(), 2u);
  EXPECT_EQ(read.graph.constraints()[0].information, information);
  EXPECT_TRUE(read.graph.constraints()[0].may_be_wrong);
  EXPECT_FALSE(read.graph.constraints()[1].may_be_wrong);
}

TEST_F(GraphFileTest, SaysWhichLineIsWrong) {
  EXPECT_EQ(error_of("# nothing\n\n" + kVertex + kSecond), "none");
  const auto says = [&](const std::string& text, const std::string& words) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(words), std::string::npos) << error;
    EXPECT_NE(error.find(path_), std::string::npos) << error;
  };
  says("nonsense\n", "line 1 begins with neither");
  says("VERTEX_SE2 1 0 0 0\n", "line 1 has not the next number");
  says("VERTEX_SE2 0 0 0\n", "line 1 has something else");
  says("VERTEX_SE2 0 0 nan 0\n", "line 1 has something else");
  says("VERTEX_SE2 0 0 1e9 0\n", "line 1 has a place that is too far away");
  says("VERTEX_SE2 0 0 0 0\n", "a vertex has no keyframe");
  says(kSecond, "line 1 has not the next number");
  says("KEYFRAME 3 0 0 0 0.1 0 0 0\n", "line 1 does not follow its vertex");
  says(kVertex + "KEYFRAME 3 0 0 0 0.1 0 0 0\n", "line 3 does not follow its vertex");
  says("VERTEX_SE2 0 0 0 0\nKEYFRAME 3 0 0 0 0.1 0 1e9\n", "line 2 has an impossible number");
  says("VERTEX_SE2 0 0 0 0\nKEYFRAME 3 0 0 0 0.1 0 1 5000 0 0\n", "more than 1 km");
  says("VERTEX_SE2 0 0 0 0\nKEYFRAME 3 0 0 0 0.1 0 1 1 0 0 7\n", "line 2 has more");
  says(kVertex + kSecond + "EDGE_SE2 0 2 1 0 0 1 0 0 1 0 1\n", "line 5 names a vertex");
  says(kVertex + kSecond + "EDGE_SE2 1 1 1 0 0 1 0 0 1 0 1\n", "line 5 connects");
  says(kVertex + kSecond + "EDGE_SE2 0 1 1 0 0 1 2 0 1 0 1\n", "not positive definite");
  says(kVertex + kSecond + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1 MAYBE\n", "line 5 has more");
}

TEST_F(GraphFileTest, RefusesAFileThatIsNotThere) {
  EXPECT_THROW(load_driven_map(path_ + ".none"), MapError);
  EXPECT_THROW(save_driven_map({}, "/nowhere/at/all.g2o"), MapError);
}

}  // namespace
}  // namespace mocha
