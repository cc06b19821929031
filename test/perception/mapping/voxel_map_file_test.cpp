#include "perception/mapping/voxel_map_file.h"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <fstream>
#include <sstream>
#include <string>

#include "perception/mapping/map_error.h"

namespace mocha {
namespace {

using Eigen::Vector3d;

constexpr double kResolution_m = 0.2;

class VoxelMapFileTest : public testing::Test {
 protected:
  void mark(const Vector3d& place, bool occupied) {
    tree_.updateNode(octomap::point3d(static_cast<float>(place.x()), static_cast<float>(place.y()),
                                      static_cast<float>(place.z())),
                     occupied);
  }

  std::string write(const std::string& ending) {
    const std::string path = testing::TempDir() + "voxel_map_file_test" + ending;
    if (ending == ".bt") {
      tree_.prune();
      tree_.writeBinary(path);
    } else {
      tree_.write(path);
    }
    return path;
  }

  octomap::OcTree tree_{kResolution_m};
};

TEST_F(VoxelMapFileTest, HoldsWhatTheFileDoes) {
  for (double x = -1.5; x < 1.5; x += 0.2) mark({x, 0.5, 0.3}, false);
  mark({1.5, 0.5, 0.3}, true);
  mark({1.5, 0.9, 0.7}, true);
  for (const char* ending : {".bt", ".ot"}) {
    const VoxelGrid grid = load_voxel_map(write(ending), {});
    EXPECT_DOUBLE_EQ(grid.resolution_m, kResolution_m);
    EXPECT_EQ(grid.size, Eigen::Vector3i(16, 3, 3));
    EXPECT_LT((grid.origin - Vector3d(-1.6, 0.4, 0.2)).norm(), 1e-9);
    EXPECT_EQ(grid.at(0, 0, 0), VoxelGrid::kFree);
    EXPECT_EQ(grid.at(15, 0, 0), VoxelGrid::kOccupied);
    EXPECT_EQ(grid.at(15, 2, 2), VoxelGrid::kOccupied);
    EXPECT_EQ(grid.at(3, 2, 2), VoxelGrid::kUnknown);
  }
}

TEST_F(VoxelMapFileTest, WholeLeavesCount) {
  for (double x = 0.1; x < 3.2; x += 0.2) {
    for (double y = 0.1; y < 3.2; y += 0.2) {
      for (double z = 0.1; z < 3.2; z += 0.2) mark({x, y, z}, true);
    }
  }
  mark({-0.1, 0.1, 0.1}, false);
  const VoxelGrid grid = load_voxel_map(write(".bt"), {});
  EXPECT_EQ(grid.size, Eigen::Vector3i(17, 16, 16));
  EXPECT_EQ(std::count(grid.cells.begin(), grid.cells.end(), VoxelGrid::kOccupied), 16 * 16 * 16);
}

TEST_F(VoxelMapFileTest, WhereNothingIsFreeAllElseIs) {
  mark({0.1, 0.1, 0.1}, true);
  mark({2.1, 0.1, 0.1}, true);
  const VoxelGrid grid = load_voxel_map(write(".bt"), {});
  EXPECT_EQ(std::count(grid.cells.begin(), grid.cells.end(), VoxelGrid::kFree), 9);
  EXPECT_EQ(std::count(grid.cells.begin(), grid.cells.end(), VoxelGrid::kUnknown), 0);
}

TEST_F(VoxelMapFileTest, ReachesAsFarAsIsAskedFor) {
  mark({0.1, 0.1, 0.1}, true);
  mark({0.3, 0.1, 0.1}, false);
  const std::string path = write(".bt");
  MapExtent more;
  more.at_least.extend(Vector3d(-1.0, 0.0, 0.05));
  const VoxelGrid grown = load_voxel_map(path, more);
  EXPECT_EQ(grown.size, Eigen::Vector3i(7, 1, 1));
  EXPECT_EQ(grown.at(0, 0, 0), VoxelGrid::kUnknown);
  EXPECT_EQ(grown.at(5, 0, 0), VoxelGrid::kOccupied);
  MapExtent box;
  box.exactly = {Vector3d(0.21, 0.0, 0.0), Vector3d(1.0, 0.4, 0.2)};
  const VoxelGrid cut = load_voxel_map(path, box);
  EXPECT_EQ(cut.size, Eigen::Vector3i(4, 2, 1));
  EXPECT_EQ(cut.at(0, 0, 0), VoxelGrid::kFree);
  EXPECT_EQ(std::count(cut.cells.begin(), cut.cells.end(), VoxelGrid::kOccupied), 0);
}

TEST_F(VoxelMapFileTest, RefusesWhatIsNoMap) {
  EXPECT_THROW(load_voxel_map("/nowhere/map.bt", {}), MapError);
  EXPECT_THROW(load_voxel_map("config/robot.yaml", {}), MapError);
  EXPECT_THROW(load_voxel_map(write(".bt"), {}), MapError);  // empty
  mark({0.1, 0.1, 0.1}, true);
  const std::string path = write(".bt");
  MapExtent far;
  far.at_least.extend(Vector3d(1e4, 1e4, 1e4));
  EXPECT_THROW(load_voxel_map(path, far), MapError);
  far.at_least.extend(Vector3d(1e300, 0.0, 0.0));
  EXPECT_THROW(load_voxel_map(path, far), MapError);
  std::ofstream(path, std::ios::app) << "more";
  EXPECT_THROW(load_voxel_map(path, {}), MapError);
}

TEST_F(VoxelMapFileTest, RefusesResolutionsThatNoMapHas) {
  mark({0.1, 0.1, 0.1}, true);
  const std::string path = write(".bt");
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string line = "res 0.2\n";
  const auto at = bytes.str().find(line);
  ASSERT_NE(at, std::string::npos);
  const auto error_with = [&](const std::string& resolution) -> std::string {
    std::ofstream(path, std::ios::binary)
        << bytes.str().replace(at, line.size(), "res " + resolution + "\n");
    try {
      load_voxel_map(path, {});
      return "";
    } catch (const MapError& error) {
      return error.what();
    }
  };
  for (const char* allowed : {"0.001", "0.2", "1e3"}) EXPECT_EQ(error_with(allowed), "");
  for (const char* refused : {"0.0009", "1001", "1e38", "1e400", "-1e400", "1e-400", "0", "-0.2",
                              "nan", "inf", "fine", ""}) {
    EXPECT_EQ(error_with(refused),
              path + ": resolution '" + refused + "': expected a value from 0.001 to 1000 (m)");
  }
}

}  // namespace
}  // namespace mocha
