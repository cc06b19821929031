#include "perception/tracking/detector.h"

#include <gtest/gtest.h>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

using Circle = Room::Circle;

const Circle kPerson{{2.0, 0.0}, 0.25};
const Circle kOther{{2.0, 0.8}, 0.25};

Detector detector() {
  const MovingObjectFilterOptions shipped = shipped_sorter_options();
  return Detector({shipped.cluster_gap_m, shipped.cluster_points, shipped.cluster_extent_m,
                   shipped.map_tolerance_m});
}

BeamIndices hits_on(const std::vector<Beam>& beams, const std::vector<Circle>& things) {
  BeamIndices hits;
  for (int i = 0; i < static_cast<int>(beams.size()); ++i) {
    const auto is_on = [&](const Circle& thing) {
      return (beams[i].end.head<2>() - thing.centre).norm() < thing.radius_m + 0.05;
    };
    if (std::any_of(things.begin(), things.end(), is_on)) hits.push_back(i);
  }
  return hits;
}

/// What is known of a thing that stands there.
TrackedObstacle standing(const Circle& thing) {
  TrackedObstacle known{};
  known.id = 1;
  known.position = thing.centre;
  known.radius_m = thing.radius_m;
  known.stands = true;
  return known;
}

TEST(Detector, WhatHasComeIsAThingAndWhatStandsUnknownIsNot) {
  const auto beams = scan_of(Room(), {kPerson, kOther});
  const auto things = detector().detect(beams, hits_on(beams, {kPerson}), {});
  ASSERT_EQ(things.size(), 1u);
  EXPECT_EQ(things[0].hits, hits_on(beams, {kPerson}));
  EXPECT_TRUE(things[0].detection.has_come);
  EXPECT_FALSE(things[0].detection.is_continued);
  EXPECT_TRUE(detector().detect(beams, {}, {}).empty());
}

TEST(Detector, WhatStandsAndIsKnownIsFoundAgainThoughItHasNotCome) {
  const auto beams = scan_of(Room(), {kPerson, kOther});
  const auto things = detector().detect(beams, {}, {standing(kOther)});
  ASSERT_EQ(things.size(), 1u);
  EXPECT_FALSE(things[0].detection.has_come);
  EXPECT_LT((things[0].detection.centre(kOther.radius_m) - kOther.centre).norm(), 0.05);
}

TEST(Detector, APersonWhoStandsAndSetsOffWithOneLegIsOneThing) {
  const Circle kStays{{2.0, 0.0}, 0.06};
  const Circle kSetsOff{{2.0, 0.5}, 0.06};  // farther than legs stand apart
  const auto beams = scan_of(Room(), {kStays, kSetsOff});
  TrackedObstacle person = standing({{2.0, 0.2}, 0.3});
  const BeamIndices came = hits_on(beams, {kSetsOff});
  EXPECT_EQ(detector().detect(beams, came, {person}).size(), 2u) << "beside what is no person";
  person.is_mover = true;
  const auto things = detector().detect(beams, came, {person});
  ASSERT_EQ(things.size(), 1u);
  EXPECT_EQ(things[0].hits, hits_on(beams, {kStays, kSetsOff}));
}

TEST(Detector, PartsOfALargeSurfaceAreNoThings) {
  // A row of pillars without gaps, 2 m wide.
  std::vector<Circle> row;
  for (double y = -1.0; y <= 1.0; y += 0.1) row.push_back({{2.5, y}, 0.1});
  const auto beams = scan_of(Room(), row);
  const BeamIndices all = hits_on(beams, row);
  const BeamIndices some(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 3));
  EXPECT_TRUE(detector().detect(beams, some, {}).empty());
}

TEST(Detector, PeopleSideBySideThatHaveComeAreThings) {
  std::vector<Circle> row;
  for (double y = -0.9; y < 1.0; y += 0.6) row.push_back({{2.5, y}, 0.25});
  const auto beams = scan_of(Room(), row);
  EXPECT_EQ(detector().detect(beams, hits_on(beams, row), {}).size(), row.size());
}

TEST(Detector, ToldIsWhatGoesOnAsSomethingThatHasNotCome) {
  const Circle kCabinet{{2.0, 0.0}, 0.5};
  const auto beams = scan_of(Room(), {kCabinet});
  const BeamIndices all = hits_on(beams, {kCabinet});
  const BeamIndices half(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
  const auto things = detector().detect(beams, half, {});
  ASSERT_EQ(things.size(), 1u);
  EXPECT_TRUE(things[0].detection.is_continued);
}

TEST(Detector, LegsAreFoundWhereverTheyStand) {
  const std::vector<Circle> legs = {{{2.0, 0.0}, 0.06}, {{2.0, 0.3}, 0.06}};
  const auto beams = scan_of(Room(), legs);
  const auto things = detector().detect(beams, {}, {});
  ASSERT_EQ(things.size(), 1u);
  EXPECT_EQ(things[0].detection.legs, 2);
  EXPECT_FALSE(things[0].detection.has_come);
  for (const auto& thing : detector().detect(beams, hits_on(beams, legs), {}))
    EXPECT_EQ(thing.detection.legs, 2) << "also where they have come";
}

}  // namespace
}  // namespace mocha
