#include "perception/tracking/legs.h"

#include <gtest/gtest.h>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

std::vector<LegHits> legs_in(const std::vector<Beam>& beams) {
  return find_legs(beams, scan_segments(beams));
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
