#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "perception/mapping/map_image.h"
#include "perception/mapping/occupancy_map.h"
#include "perception/mapping/octree_file.h"
#include "perception/room.h"
#include "perception/shipped_options.h"

namespace mocha {
namespace {

class MapFiles : public testing::Test {
 protected:
  MapFiles()
      : directory_(std::filesystem::temp_directory_path() /
                   ("mocha_maps_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(directory_);
    Room room;
    room.circles = {{{2.0, 0.5}, 0.4}, {{-2.0, -1.5}, 0.25}};
    for (int i = 0; i < 4; ++i) map_.insert_scan(beams_at(room, {}));
    map_.insert_points({{{0.0, 0.0, 0.5}, {1.0, 1.0, 0.7}, BeamEnd::kHit, 0.0}});
  }
  ~MapFiles() override { std::filesystem::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  std::string error_of_loading(OccupancyMap& map, const std::string& file) const {
    try {
      map.load(file);
    } catch (const MapError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path directory_;
  OccupancyMap map_{shipped_map_options()};
};

void expect_same(const OccupancyGrid& a, const OccupancyGrid& b) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  EXPECT_TRUE(a.origin.isApprox(b.origin, 1e-9));
  EXPECT_EQ(a.cells, b.cells);
}

TEST_F(MapFiles, RoundTripsInEveryFormat) {
  for (const char* name : {"room.bt", "room.ot", "room.yaml"}) {
    map_.save(path(name));
    OccupancyMap loaded(shipped_map_options());
    loaded.load(path(name));
    expect_same(loaded.slice(0.5), map_.slice(0.5));
  }
  EXPECT_TRUE(std::filesystem::exists(path("room.pgm")));
}

TEST_F(MapFiles, OctomapReadsWhatWeWrite) {
  const auto expected = map_.occupied_voxels();
  map_.save(path("room.bt"));
  map_.save(path("room.ot"));
  octomap::OcTree binary(path("room.bt"));
  const std::unique_ptr<octomap::AbstractOcTree> any(
      octomap::AbstractOcTree::read(path("room.ot")));
  const auto* full = dynamic_cast<octomap::OcTree*>(any.get());
  ASSERT_NE(full, nullptr);
  for (const octomap::OcTree* tree : {&std::as_const(binary), full}) {
    std::size_t occupied = 0;
    for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
      if (tree->isNodeOccupied(*leaf)) ++occupied;
    }
    EXPECT_EQ(occupied, expected.size());
    for (const Eigen::Vector3f& voxel : expected) {
      const octomap::OcTreeNode* node = tree->search(voxel.x(), voxel.y(), voxel.z());
      ASSERT_NE(node, nullptr);
      EXPECT_TRUE(tree->isNodeOccupied(node));
    }
    EXPECT_TRUE(tree->isNodeOccupied(tree->getRoot())) << "inner nodes are up to date";
  }
}

TEST_F(MapFiles, OctreesKeepHeights) {
  for (const char* name : {"room.bt", "room.ot"}) {
    map_.save(path(name));
    OccupancyMap loaded(shipped_map_options());
    loaded.load(path(name));
    const auto voxels = loaded.occupied_voxels();
    EXPECT_EQ(voxels.size(), map_.occupied_voxels().size());
    EXPECT_TRUE(std::any_of(voxels.begin(), voxels.end(), [](const Eigen::Vector3f& voxel) {
      return (voxel - Eigen::Vector3f(1.025F, 1.025F, 0.725F)).norm() < 0.08F;
    }));
  }
}

TEST_F(MapFiles, ALoadedMapIsAPriorThatScansCorrect) {
  for (const char* name : {"room.bt", "room.ot", "room.yaml"}) {
    map_.save(path(name));
    OccupancyMap loaded(shipped_map_options());
    loaded.load(path(name));
    Room changed;  // both columns are gone, and a new one stands there
    changed.circles = {{{-1.0, 1.5}, 0.3}};
    const auto beams = beams_at(changed, {});
    loaded.insert_scan(beams);
    const OccupancyGrid once = loaded.slice(0.0);
    const Vector2 face = (Vector2(2.0, 0.5) - 0.4 * Vector2(2.0, 0.5).normalized() - once.origin) /
                         once.resolution_m;
    EXPECT_EQ(once.at(static_cast<int>(face.x()), static_cast<int>(face.y())),
              OccupancyGrid::kOccupied)
        << name << ": one scan does not overrule it";
    for (int i = 0; i < 20; ++i) loaded.insert_scan(beams);
    const OccupancyGrid later = loaded.slice(0.0);
    EXPECT_EQ(later.at(static_cast<int>(face.x()), static_cast<int>(face.y())),
              OccupancyGrid::kFree);
  }
}

TEST_F(MapFiles, PrunedOctreesLoadAndCanBeChanged) {
  // A .bt file, written by hand, of one free cube of 0.4 m (8 voxels an edge) from the origin up.
  std::string bytes = "# Octomap OcTree binary file\nid OcTree\nsize 14\nres 0.05\ndata\n";
  for (int depth = 0; depth < 13; ++depth) {
    const int child = depth == 0 ? 7 : 0;
    const unsigned bits = (depth == 12 ? 1u : 3u) << (2 * child);
    bytes += static_cast<char>(bits & 0xff);
    bytes += static_cast<char>(bits >> 8);
  }
  std::ofstream(path("cube.bt"), std::ios::binary) << bytes;
  OccupancyMapOptions options = shipped_map_options();
  options.resolution_m = 0.05;
  OccupancyMap loaded(options);
  loaded.load(path("cube.bt"));
  OccupancyGrid grid = loaded.slice(0.0);
  ASSERT_EQ(grid.width, 8);
  ASSERT_EQ(grid.height, 8);
  for (int i = 0; i < 3; ++i) {
    loaded.insert_scan({{{0.01, 0.01, 0.2}, {0.22, 0.01, 0.2}, BeamEnd::kHit, 0.0}});
  }
  grid = loaded.slice(0.0);
  EXPECT_EQ(grid.at(4, 0), OccupancyGrid::kOccupied);
  EXPECT_EQ(grid.at(7, 7), OccupancyGrid::kFree);
  loaded.save(path("cube2.ot"));
  OccupancyMap again(options);
  again.load(path("cube2.ot"));
  expect_same(again.slice(0.0), grid);
}

TEST_F(MapFiles, WhatAnOctreeKnowsBeyondTheHeightBandIsSavedAgain) {
  octomap::OcTree tree(map_.options().resolution_m);
  tree.updateNode(octomap::point3d(1.01F, 1.01F, 3.01F), true);
  tree.updateNode(octomap::point3d(1.01F, 1.01F, 0.21F), true);
  tree.writeBinary(path("hall.bt"));
  OccupancyMap loaded(shipped_map_options());
  loaded.load(path("hall.bt"));
  EXPECT_EQ(loaded.occupied_voxels().size(), 1u);
  loaded.clear_disc({1.01, 1.01}, 0.1);
  loaded.insert_scan({{{0.01, 0.01, 0.2}, {2.01, 0.01, 0.2}, BeamEnd::kHit, 0.0}});
  loaded.save(path("again.bt"));
  octomap::OcTree again(path("again.bt"));
  const auto is_occupied = [&](float x, float y, float z) {
    const octomap::OcTreeNode* node = again.search(x, y, z);
    return node != nullptr && again.isNodeOccupied(node);
  };
  EXPECT_TRUE(is_occupied(1.01F, 1.01F, 3.01F));
  EXPECT_FALSE(is_occupied(1.01F, 1.01F, 0.21F));
  EXPECT_TRUE(is_occupied(2.01F, 0.01F, static_cast<float>(map_.options().scan_height_m)));
}

void expect_covers(const OccupancyGrid& fine, const OccupancyGrid& coarse) {
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const Vector2 at = (fine.cell_centre(x, y) - coarse.origin) / coarse.resolution_m;
      const int cx = static_cast<int>(std::floor(at.x()));
      const int cy = static_cast<int>(std::floor(at.y()));
      const int8_t expected = coarse.contains(cx, cy) ? coarse.at(cx, cy) : OccupancyGrid::kUnknown;
      ASSERT_EQ(fine.at(x, y), expected) << fine.cell_centre(x, y).transpose();
    }
  }
}

TEST_F(MapFiles, LargerCellsAreDividedAndScansCorrectThem) {
  OccupancyMapOptions coarse = shipped_map_options();
  coarse.resolution_m = 2.0 * map_.options().resolution_m;
  OccupancyMap saved(coarse);
  Room room;
  room.circles = {{{2.0, 0.5}, 0.4}};
  for (int i = 0; i < 4; ++i) saved.insert_scan(beams_at(room, {}));
  const double x = 1.0 + 0.5 * coarse.resolution_m;
  for (int i = 0; i < 10; ++i)
    saved.insert_scan({{{0.0, 0.01, 0.2}, {x, 0.01, 0.2}, BeamEnd::kHit, 0.0}});
  for (const char* name : {"room.bt", "room.ot", "room.yaml"}) {
    saved.save(path(name));
    OccupancyMap loaded(shipped_map_options());
    const std::string notes = loaded.load(path(name));
    EXPECT_NE(notes.find("cells of 0.05 m are resampled to 0.025 m"), std::string::npos) << notes;
    EXPECT_EQ(loaded.options().resolution_m, map_.options().resolution_m);
    expect_covers(loaded.slice(0.1), saved.slice(0.0));
    for (int i = 0; i < 40; ++i)
      loaded.insert_scan({{{0.0, 0.01, 0.2}, {x + 0.5, 0.01, 0.2}, BeamEnd::kIgnored, 0.0}});
    EXPECT_TRUE(loaded.is_surely_free({x, 0.01})) << name;
    const OccupancyGrid slice = loaded.slice(0.0);
    const Vector2 at = (Vector2(x, 0.01) - slice.origin) / slice.resolution_m;
    EXPECT_EQ(slice.at(static_cast<int>(at.x()), static_cast<int>(at.y())), OccupancyGrid::kFree)
        << name << ": nothing is left of it at other heights";
  }
}

TEST_F(MapFiles, CellsThatAreNoMultipleLoseNoObstacleAndInventNoFreeSpace) {
  OccupancyGrid odd;
  odd.resolution_m = 0.04;
  odd.width = odd.height = 40;
  odd.cells.assign(1600, OccupancyGrid::kUnknown);
  std::mt19937 random(7);
  for (int8_t& cell : odd.cells) {
    const int kind = static_cast<int>(random() % 3);
    cell = kind == 0   ? OccupancyGrid::kOccupied
           : kind == 1 ? OccupancyGrid::kFree
                       : OccupancyGrid::kUnknown;
  }
  save_map_image(odd, path("odd.yaml"));
  OccupancyMap loaded(shipped_map_options());
  loaded.load(path("odd.yaml"));
  const OccupancyGrid fine = loaded.slice(0.1);
  const double corner_m = 0.5 * fine.resolution_m - 1e-6;
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      bool any_occupied = false;
      bool all_free = true;
      for (const double dx : {-corner_m, corner_m}) {
        for (const double dy : {-corner_m, corner_m}) {
          const Vector2 at = (fine.cell_centre(x, y) + Vector2(dx, dy)) / odd.resolution_m;
          const int cx = static_cast<int>(std::floor(at.x()));
          const int cy = static_cast<int>(std::floor(at.y()));
          const int8_t cell = odd.contains(cx, cy) ? odd.at(cx, cy) : OccupancyGrid::kUnknown;
          any_occupied = any_occupied || cell == OccupancyGrid::kOccupied;
          all_free = all_free && cell == OccupancyGrid::kFree;
        }
      }
      ASSERT_EQ(fine.at(x, y), any_occupied ? OccupancyGrid::kOccupied
                               : all_free   ? OccupancyGrid::kFree
                                            : OccupancyGrid::kUnknown);
    }
  }
}

TEST_F(MapFiles, ObstaclesAtEachHeightStayThere) {
  octomap::OcTree tree(0.05);
  for (const float z : {0.075F, 0.525F, 0.975F})
    tree.updateNode(octomap::point3d(1.01F, 1.01F, z), true);
  tree.writeBinary(path("heights.bt"));
  OccupancyMap loaded(shipped_map_options());
  loaded.load(path("heights.bt"));
  EXPECT_EQ(loaded.occupied_voxels().size(), 24u);
  for (const Eigen::Vector3f& voxel : loaded.occupied_voxels()) {
    EXPECT_NEAR(voxel.x(), 1.025F, 0.0126F);
    EXPECT_NEAR(std::remainder(voxel.z() - 0.075F, 0.45F), 0.0F, 0.0126F);
  }
}

TEST_F(MapFiles, AnOriginBetweenCellsIsMovedAndSaidToBe) {
  OccupancyGrid grid = map_.slice(0.0);
  const Vector2 shift(0.006, -0.008);
  grid.origin += shift;
  save_map_image(grid, path("room.yaml"));
  OccupancyMap loaded(shipped_map_options());
  const std::string notes = loaded.load(path("room.yaml"));
  EXPECT_EQ(notes, "; its origin is no multiple of its cells, and moved by 0.01 m");
  expect_same(loaded.slice(0.0), map_.slice(0.0));
  map_.save(path("room.yaml"));
  EXPECT_EQ(loaded.load(path("room.yaml")), "");
}

// 2 x 2 pixels: red, white; grey (205), transparent black.
const char kPng[] =
    "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00"
    "\x00\x02\x00\x00\x00\x02\x08\x06\x00\x00\x00\x72\xb6\x0d\x24\x00\x00\x00"
    "\x17\x49\x44\x41\x54\x78\x9c\x63\xf8\xcf\xc0\xf0\x1f\x04\x18\xce\x9e\x3d"
    "\x0b\x64\x33\x30\x00\x00\x62\x91\x09\x61\x44\x99\x81\x8f\x00\x00\x00\x00"
    "\x49\x45\x4e\x44\xae\x42\x60\x82";

TEST_F(MapFiles, ReadsPngImages) {
  write_file(path("map.png"), std::string(kPng, sizeof(kPng) - 1));
  write_file(path("map.yaml"),
             "image: map.png\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\n"
             "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const OccupancyGrid grid = load_map_image(path("map.yaml"));
  ASSERT_EQ(grid.width, 2);
  ASSERT_EQ(grid.height, 2);
  EXPECT_EQ(grid.at(0, 1), OccupancyGrid::kOccupied) << "red";
  EXPECT_EQ(grid.at(1, 1), OccupancyGrid::kFree) << "white";
  EXPECT_EQ(grid.at(0, 0), OccupancyGrid::kUnknown) << "grey";
  EXPECT_EQ(grid.at(1, 0), OccupancyGrid::kUnknown) << "transparent";
  for (std::size_t size = 1; size < sizeof(kPng) - 13; ++size) {
    write_file(path("map.png"), std::string(kPng, size));
    EXPECT_THROW(load_map_image(path("map.yaml")), MapError) << size;
  }
}

TEST_F(MapFiles, ALoadedMapKeepsItsOwnCells) {
  OccupancyMapOptions others = shipped_map_options();
  others.resolution_m = 2.0 * map_.options().resolution_m;
  for (const char* name : {"room.bt", "room.ot", "room.yaml"}) {
    map_.save(path(name));
    OccupancyMap loaded(others);
    loaded.load(path(name));
    EXPECT_NEAR(loaded.options().resolution_m, map_.options().resolution_m, 1e-9) << name;
    expect_same(loaded.slice(0.0), map_.slice(0.0));
    const double x = 1.0 + 0.5 * map_.options().resolution_m;
    for (int i = 0; i < 10; ++i)
      loaded.insert_scan({{{0.0, 0.01, 0.2}, {x, 0.01, 0.2}, BeamEnd::kHit, 0.0}});
    EXPECT_TRUE(loaded.is_occupied_within({x, 0.01}, 0.02, true)) << name;
  }
}

TEST_F(MapFiles, CellsOfAnOddSizeAreRefusedAndChangeNothing) {
  const OccupancyGrid before = map_.slice(0.5);
  write_file(path("coarse.bt"), octree_header(true, 0, 3.0));
  const std::string error = error_of_loading(map_, path("coarse.bt"));
  EXPECT_NE(error.find(path("coarse.bt")), std::string::npos) << error;
  EXPECT_NE(error.find("resolution is 3.0"), std::string::npos) << error;
  expect_same(map_.slice(0.5), before);
}

TEST_F(MapFiles, TruncatedFilesAreRefusedAndChangeNothing) {
  const OccupancyGrid before = map_.slice(0.5);
  for (const char* name : {"room.bt", "room.ot", "room.pgm", "room.yaml"}) {
    map_.save(path("room.yaml"));
    map_.save(path("room.bt"));
    map_.save(path("room.ot"));
    const std::string bytes = read_file(path(name));
    const std::string loaded = std::string(name) == "room.pgm" ? "room.yaml" : name;
    std::mt19937 random(5);
    for (int i = 0; i < 60; ++i) {
      std::size_t size = std::uniform_int_distribution<std::size_t>(0, bytes.size() - 2)(random);
      if (std::string(name) == "room.yaml") size /= 2;  // what is cut off is then a needed key
      write_file(path(name), bytes.substr(0, size));
      const std::string error = error_of_loading(map_, path(loaded));
      EXPECT_NE(error.find(directory_.string()), std::string::npos) << name << " cut to " << size;
      expect_same(map_.slice(0.5), before);
    }
  }
}

TEST_F(MapFiles, GarbageNeverCrashes) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> byte(0, 255);
  for (const char* name : {"room.bt", "room.ot", "room.pgm", "room.yaml"}) {
    map_.save(path("room.yaml"));
    map_.save(path("room.bt"));
    map_.save(path("room.ot"));
    const std::string bytes = read_file(path(name));
    const std::size_t header =
        bytes.find("data\n") == std::string::npos ? 0 : bytes.find("data\n") + 5;
    const std::string loaded = std::string(name) == "room.pgm" ? "room.yaml" : name;
    for (int i = 0; i < 300; ++i) {
      std::string garbage = bytes;
      if (i % 3 == 0) {  // a few bytes changed
        for (int k = 0; k < 5; ++k)
          garbage[random() % garbage.size()] = static_cast<char>(byte(random));
      } else {  // nothing but noise, after the header or altogether
        garbage.resize((i % 3 == 1 ? header : 0) + random() % 3000);
        for (std::size_t k = i % 3 == 1 ? header : 0; k < garbage.size(); ++k) {
          garbage[k] = static_cast<char>(byte(random));
        }
      }
      write_file(path(name), garbage);
      OccupancyMap map(shipped_map_options());
      error_of_loading(map, path(loaded));  // refused or, where the change does no harm, read
      map.insert_scan({{{0.0, 0.0, 0.2}, {1.0, 0.0, 0.2}, BeamEnd::kHit, 0.0}});
    }
  }
}

TEST_F(MapFiles, ReasonsAreInWords) {
  EXPECT_NE(error_of_loading(map_, path("none.bt")).find("No such file"), std::string::npos);
  for (const char* name : {"nothing.bt", "nothing.ot", "nothing.yaml"}) {
    write_file(path(name), "");
    EXPECT_EQ(error_of_loading(map_, path(name)), path(name) + ": is empty");
  }
  EXPECT_NE(error_of_loading(map_, path("map.png")).find(".bt, .ot or .yaml"), std::string::npos);
  EXPECT_THROW(map_.save(path("map.txt")), MapError);
  EXPECT_THROW(map_.save("/nonexistent/folder/map.bt"), MapError);
  EXPECT_THROW(OccupancyMap(shipped_map_options()).save(path("empty.yaml")), MapError);
  OccupancyMap(shipped_map_options()).save(path("empty.ot"));
  EXPECT_EQ(error_of_loading(map_, path("empty.ot")), "");
}

TEST_F(MapFiles, ReadsMapServersConventions) {
  std::ofstream(path("small.pgm"), std::ios::binary) << "P5\n# made elsewhere\n3 2\n100\n"
                                                     << std::string("\x64\x00\x50\x50\x64\x00", 6);
  std::ofstream(path("small.yaml"))
      << "image: small.pgm\nresolution: 0.05\norigin: [1.0, -2.0, 0.0]\n"
         "negate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const OccupancyGrid grid = load_map_image(path("small.yaml"));
  EXPECT_EQ(grid.origin, Vector2(1.0, -2.0));
  EXPECT_EQ(grid.at(0, 1), OccupancyGrid::kOccupied);  // the first pixel is the upper left one
  EXPECT_EQ(grid.at(1, 1), OccupancyGrid::kFree);
  EXPECT_EQ(grid.at(2, 0), OccupancyGrid::kFree);
  map_.load(path("small.yaml"));
  EXPECT_NEAR(map_.slice(0.0).width * map_.options().resolution_m, 3 * 0.05, 1e-9);
}

}  // namespace
}  // namespace mocha
