#include "perception/mapping/saved_map.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "perception/mapping/map_image.h"
#include "perception/room.h"
#include "perception/shipped_options.h"

namespace mocha {
namespace {

class SavedMapTest : public testing::Test {
 protected:
  SavedMapTest() {
    std::string pattern = testing::TempDir() + "saved_map_XXXXXX";
    directory_ = mkdtemp(pattern.data());
  }
  ~SavedMapTest() override { std::filesystem::remove_all(directory_); }

  std::string path(const std::string& name) const { return directory_ + "/" + name; }

  std::string directory_;
};

int occupied(const OccupancyGrid& grid) {
  return static_cast<int>(
      std::count(grid.cells.begin(), grid.cells.end(), OccupancyGrid::kOccupied));
}

TEST_F(SavedMapTest, AnySizeOfCellsAndAnyFormatGiveTheSameSlice) {
  for (const double resolution_m : {0.025, 0.1}) {
    OccupancyMapOptions options = shipped_map_options();
    options.resolution_m = resolution_m;
    OccupancyMap map(options);
    const Pose middle{{0.0, 0.0}, 0.0};
    const PlanarScan scan = sweep(Room{}, [&](double) { return middle; });
    for (int i = 0; i < 5; ++i)
      map.insert_scan(to_beams(scan, {sensor_pose(middle), sensor_pose(middle)}, {30.0, 10.0}));
    const OccupancyGrid slice = map.slice(0.0);
    ASSERT_GT(occupied(slice), 100);
    for (const char* name : {"room.bt", "room.ot", "room.yaml"}) {
      map.save(path(name));
      const OccupancyGrid loaded = load_saved_slice(path(name), 0.05, 1.0);
      EXPECT_NEAR(loaded.resolution_m, resolution_m, 1e-9) << name;
      EXPECT_EQ(occupied(loaded), occupied(slice)) << name;
      const Vector2 wall(5.01 + 1e-3, 0.3);
      const Vector2 at = (wall - loaded.origin) / loaded.resolution_m;
      EXPECT_EQ(loaded.at(static_cast<int>(at.x()), static_cast<int>(at.y())),
                OccupancyGrid::kOccupied)
          << name;
    }
  }
}

TEST_F(SavedMapTest, RefusesWhatIsNoMap) {
  EXPECT_THROW(load_saved_slice(path("missing.bt"), 0.05, 1.0), MapError);
  write_file(path("broken.bt"), "no octree");
  EXPECT_THROW(load_saved_slice(path("broken.bt"), 0.05, 1.0), MapError);
  write_file(path("map.png"), "x");
  EXPECT_THROW(load_saved_slice(path("map.png"), 0.05, 1.0), MapError);
}

}  // namespace
}  // namespace mocha
