#include "perception/monitoring/wide_hits.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

int hits(const std::vector<Beam>& beams) {
  return static_cast<int>(std::count_if(
      beams.begin(), beams.end(), [](const Beam& beam) { return beam.kind == BeamEnd::kHit; }));
}

TEST(WithWideHitsOnly, KeepsWallsAndDropsPeople) {
  Watch watch(Room{});
  const int walls = hits(with_wide_hits_only(watch.scan({})));
  EXPECT_GT(walls, 600);
  watch.walkers = {walker(0.25, {1.5, 0.0}, {0.0, 0.0}), walker(0.5, {-1.0, 1.0}, {0.0, 0.0})};
  for (const Beam& beam : with_wide_hits_only(watch.scan({}))) {
    if (beam.kind != BeamEnd::kHit) continue;
    const Vector2 end = beam.end.head<2>();
    EXPECT_GT((end - Vector2(1.5, 0.0)).norm(), 0.4);
    EXPECT_GT((end - Vector2(-1.0, 1.0)).norm(), 0.65);
  }
}

TEST(WithWideHitsOnly, OfPeopleInTheOpenNothingIsLeft) {
  Watch watch({{-90.0, -90.0}, {90.0, 90.0}, {}});
  watch.walkers = {walker(0.5, {2.0, 0.0}, {0.0, 0.0}), walker(0.5, {2.0, 2.0}, {0.0, 0.0}),
                   walker(0.5, {-3.0, 1.0}, {0.0, 0.0})};
  const auto scan = watch.scan({});
  EXPECT_GT(hits(scan), 50);
  EXPECT_EQ(hits(with_wide_hits_only(scan)), 0);
  EXPECT_TRUE(with_wide_hits_only({}).empty());
}

}  // namespace
}  // namespace mocha
