#include "perception/tracking/legs.h"

#include <gtest/gtest.h>

#include <numeric>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

std::vector<Beam> scan_of(Room room, const std::vector<Room::Circle>& things) {
  room.circles.insert(room.circles.end(), things.begin(), things.end());
  return Watch(room).scan({});
}

std::vector<LegHits> legs_in(const std::vector<Beam>& beams) {
  return find_legs(beams, scan_segments(beams));
}

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

TEST(FindLegs, TwoNarrowThingsAsFarApartAsLegsArePairedAndOthersAreAlone) {
  const auto legs =
      legs_in(scan_of(Room(), {{{2.0, 0.0}, 0.06}, {{2.1, 0.3}, 0.06}, {{2.0, -1.5}, 0.06}}));
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_EQ(legs[0].legs + legs[1].legs, 3);
}

TEST(FindLegs, NotWhatIsWideOrStandsAtAWall) {
  EXPECT_TRUE(legs_in(scan_of(Room(), {{{2.0, 0.0}, 0.25}})).empty());
  const Room room;
  EXPECT_TRUE(legs_in(scan_of(room, {{{room.high.x() - 0.05, 0.0}, 0.08}})).empty());
}

TEST(FindLegs, TheClosestArePaired) {
  // Two people side by side.
  const auto legs = legs_in(scan_of(
      Room(),
      {{{2.0, -0.55}, 0.06}, {{2.0, -0.3}, 0.06}, {{2.0, 0.15}, 0.06}, {{2.0, 0.4}, 0.06}}));
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_EQ(legs[0].legs, 2);
  EXPECT_EQ(legs[1].legs, 2);
}

}  // namespace
}  // namespace mocha
