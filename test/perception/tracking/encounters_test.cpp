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

}  // namespace
}  // namespace mocha
