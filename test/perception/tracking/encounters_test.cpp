#include <gtest/gtest.h>

#include <algorithm>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

/// Large discs (radius 0.5 m) that are near to each other, known before or not.
struct Encounter {
  Vector2 from[2];
  Vector2 velocity[2];
};

/// Scans of an encounter in which one of the discs is not tracked, of those after the first second.
int scans_untracked(const Encounter& encounter, double seconds) {
  Watch watch{{{-10.0, -10.0}, {10.0, 10.0}, {}}};
  watch.look_for(1.0);
  for (int i : {0, 1})
    watch.walkers.push_back(walker(0.5, encounter.from[i], encounter.velocity[i], watch.time_s));
  int untracked = 0;
  const double begun_s = watch.time_s;
  while (watch.time_s < begun_s + seconds) {
    watch.look();
    if (watch.time_s < begun_s + 0.55) continue;
    const auto tracks = watch.tracks();
    for (const Walker& disc : watch.walkers) {
      const Vector2 truth = disc.at(watch.time_s - 0.1);
      untracked += std::none_of(tracks.begin(), tracks.end(), [&](const TrackedObstacle& track) {
        return (track.position - truth).norm() < 0.35;
      });
    }
  }
  return untracked;
}

TEST(MovingObjectFilter, LargeThingsSideBySideAreTwo) {
  EXPECT_EQ(scans_untracked({{{4.0, -2.0}, {4.0, -0.8}}, {{0.0, 0.8}, {0.0, 0.8}}}, 3.0), 0);
}

TEST(MovingObjectFilter, WhatComesOutBesideAKnownThingIsSeen) {
  // The second comes from behind the first, which has just been seen for the first time.
  EXPECT_LE(scans_untracked({{{3.0, 0.0}, {4.1, 0.9}}, {{0.0, -0.4}, {0.0, 0.7}}}, 2.5), 2);
}

TEST(MovingObjectFilter, WhatIsSuddenlyBesideAKnownThingTakesNothingFromIt) {
  Watch watch{{{-10.0, -10.0}, {10.0, 10.0}, {}}};
  watch.look_for(1.0);
  const double begun_s = watch.time_s;
  const auto known = [=](double t) { return Vector2(3.0, -1.0 + 0.6 * (t - begun_s)); };
  const auto newcomer = [=](double t) {
    return t < begun_s + 1.0 ? Vector2(30.0, 30.0) : Vector2(known(t) + Vector2(0.3, 1.05));
  };
  watch.walkers = {{0.5, known}, {0.5, newcomer}};
  watch.look_for(1.0);
  ASSERT_EQ(watch.tracks().size(), 1u);
  const auto id = watch.tracks()[0].id;
  for (int scan = 0; scan < 10; ++scan) {
    watch.look();
    const double seen_s = watch.time_s - 0.1;
    const auto tracks = watch.tracks();
    ASSERT_FALSE(tracks.empty()) << scan;
    EXPECT_EQ(tracks[0].id, id);
    EXPECT_LT((tracks[0].position - known(seen_s)).norm(), 0.15) << scan;
    if (scan < 3) continue;
    ASSERT_EQ(tracks.size(), 2u) << scan;
    EXPECT_LT((tracks[1].position - newcomer(seen_s)).norm(), 0.25) << scan;
  }
}

/// Where it was seen first, somebody nearer goes past behind it: nothing shows that it left.
TEST(MovingObjectFilter, WhatMovesDoesNotStandAlsoWhereNobodySawItLeave) {
  Watch watch{{{-10.0, -10.0}, {10.0, 10.0}, {}}};
  watch.look_for(1.0);
  const double begun_s = watch.time_s;
  const Walker far = walker(0.3, {6.0, 0.0}, {0.0, 1.3}, begun_s);
  const Walker near = walker(0.5, {3.0, -0.7}, {0.0, 0.6}, begun_s);
  watch.walkers = {far, near};
  for (int scan = 0; scan < 22; ++scan) {
    watch.look();
    if (scan < 15) continue;
    const Vector2 place = far.at(watch.time_s - 0.1);
    const auto tracks = watch.tracks();
    const auto seen = std::find_if(tracks.begin(), tracks.end(), [&](const TrackedObstacle& track) {
      return (track.position - place).norm() < 0.2;
    });
    ASSERT_NE(seen, tracks.end()) << scan;
    EXPECT_FALSE(seen->stands) << scan;
    EXPECT_EQ(watch.occupied_within(place, 0.6), 0) << scan;
  }
}

}  // namespace
}  // namespace mocha
