#include "perception/tracking/scan_segments.h"

#include <gtest/gtest.h>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

TEST(ScanSegments, AreSurfacesApartFromEachOther) {
  const auto beams = scan_of(Room(), {{{2.0, 0.0}, 0.3}, {{2.0, 1.0}, 0.1}});
  const auto segments = scan_segments(beams);
  std::size_t hits = 0;
  int free = 0;
  for (const ScanSegment& segment : segments) {
    hits += segment.hits.size();
    if (!segment.stands_free) continue;
    ++free;
    const bool large = segment.middle(beams).y() < 0.5;
    EXPECT_NEAR(segment.width_m, large ? 0.59 : 0.2, 0.06);
  }
  EXPECT_EQ(free, 2) << "the walls stand free nowhere";
  std::size_t all = 0;
  for (const Beam& beam : beams) all += beam.kind == BeamEnd::kHit ? 1 : 0;
  EXPECT_EQ(hits, all) << "each hit is on one of them";
}

TEST(ScanSegments, AWallIsOneAlsoWhereItIsSeenAtASlantAndAcrossTheEndOfTheSweep) {
  const Room corridor{{-3.0, -1.0}, {3.0, 1.0}, {}};
  for (const Pose& pose : {Pose{{0.0, 0.0}, 0.0}, Pose{{0.0, 0.0}, 1.0}, Pose{{0.0, 0.0}, 3.0}}) {
    const auto beams = Watch(corridor, 1, Senses{0.01, 0.0}).scan(pose);
    std::size_t largest = 0;
    for (const ScanSegment& segment : scan_segments(beams))
      largest = std::max(largest, segment.hits.size());
    EXPECT_EQ(largest, beams.size()) << "all walls, at " << pose.yaw_rad;
  }
}

TEST(ScanSegments, OfNothingAndOfOneBeam) {
  EXPECT_TRUE(scan_segments({}).empty());
  const Beam beam{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, BeamEnd::kHit, 0.0};
  EXPECT_EQ(scan_segments({beam}).size(), 1u);
}

}  // namespace
}  // namespace mocha
