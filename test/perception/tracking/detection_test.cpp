#include "perception/tracking/detection.h"

#include <gtest/gtest.h>

#include "perception/room.h"

namespace mocha {
namespace {

/// The beams of a scan that end on a circle.
BeamIndices hits_on(const std::vector<Beam>& beams, const Room::Circle& circle) {
  BeamIndices hits;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double off_m = (beams[i].end.head<2>() - circle.centre).norm() - circle.radius_m;
    if (std::abs(off_m) < 1e-4) hits.push_back(static_cast<int>(i));
  }
  return hits;
}

TEST(Detection, FindsDiscsAllAround) {
  for (double distance_m : {0.6, 1.5, 2.9}) {
    for (double bearing_rad = -3.1; bearing_rad < 3.2; bearing_rad += 0.3) {
      const Vector2 robot(0.3, -0.2);
      Room room;
      room.low = {-9.0, -9.0};
      room.high = {9.0, 9.0};
      room.circles = {
          {robot + distance_m * Vector2(std::cos(bearing_rad), std::sin(bearing_rad)), 0.25}};
      const auto beams = beams_at(room, {robot, 0.4});
      const Detection detection = sight_disc(beams, hits_on(beams, room.circles[0]));
      EXPECT_FALSE(detection.is_hidden()) << bearing_rad;
      EXPECT_NEAR(detection.radius_m, 0.25, 0.03);
      EXPECT_LT((detection.centre(0.25) - room.circles[0].centre).norm(),
                0.01 * (1.0 + distance_m));
    }
  }
}

TEST(Detection, OfAHalfHiddenDiscTheFreeEdgeTells) {
  Room room;
  room.circles = {{{3.0, 0.0}, 0.3}, {{1.5, -0.22}, 0.22}};
  const auto beams = beams_at(room, {});
  const Detection detection = sight_disc(beams, hits_on(beams, room.circles[0]));
  EXPECT_TRUE(detection.right_hidden);
  EXPECT_FALSE(detection.left_hidden);
  EXPECT_LT(detection.radius_m, 0.2);
  EXPECT_LT((detection.centre(0.3) - room.circles[0].centre).norm(), 0.05);
}

TEST(Detection, ADiscMayGoOnOutsideOfTheScan) {
  Room room;
  room.circles = {{{0.0, 2.0}, 0.3}};
  auto beams = beams_at(room, {});
  beams.resize(541);  // up to 90 degrees: the middle of the disc
  const Detection detection = sight_disc(beams, hits_on(beams, room.circles[0]));
  EXPECT_TRUE(detection.left_hidden);
  EXPECT_FALSE(detection.right_hidden);
}

TEST(Detection, SaysWhatBecameOfAPlace) {
  Room room;
  room.circles = {{{2.0, 0.0}, 0.3}};
  const auto beams = beams_at(room, {});
  EXPECT_EQ(view_of(beams, {2.0, 0.0}, 0.3), View::kTaken);
  EXPECT_EQ(view_of(beams, {3.5, 0.0}, 0.3), View::kHidden);
  EXPECT_EQ(view_of(beams, {1.0, 0.0}, 0.3), View::kFree);
  EXPECT_EQ(view_of(beams, {2.0, -1.5}, 0.3), View::kFree);
  EXPECT_EQ(view_of({}, {2.0, 0.0}, 0.3), View::kUnseen);
}

TEST(HitClusters, LinkWhatIsNear) {
  std::vector<Beam> beams;
  for (double x : {0.0, 0.3, 0.6, 1.2, 1.5})
    beams.push_back({{0, 0, 0}, {x, 1.0, 0}, BeamEnd::kHit, 0});
  const auto clusters = cluster_hits(beams, {0, 1, 2, 3, 4}, 0.35);
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_EQ(clusters[0], (BeamIndices{0, 1, 2}));
  EXPECT_EQ(clusters[1], (BeamIndices{3, 4}));
  EXPECT_NEAR(extent_m(beams, clusters[0]), 0.6, 1e-12);
  const auto parts = part_cluster(beams, {0, 1, 2, 3, 4}, {{0.2, 1.0}, {1.3, 1.0}});
  EXPECT_EQ(parts[0], (BeamIndices{0, 1, 2}));
  EXPECT_EQ(parts[1], (BeamIndices{3, 4}));
}

}  // namespace
}  // namespace mocha
