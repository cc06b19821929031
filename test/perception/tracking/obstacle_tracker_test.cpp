#include "perception/tracking/obstacle_tracker.h"

#include <gtest/gtest.h>

#include <random>

#include "perception/shipped_options.h"

namespace mocha {
namespace {

/// What a sensor at the origin sees of a disc.
Detection sighted(const Vector2& centre, double radius_m, double time_s) {
  const double distance_m = centre.norm();
  const double bearing_rad = std::atan2(centre.y(), centre.x());
  const double half_rad = std::asin(radius_m / distance_m);
  Detection detection{time_s, {0.0, 0.0}, bearing_rad - half_rad, bearing_rad + half_rad,
                      false,  false,      distance_m - radius_m,  radius_m,
                      {}};
  detection.has_come = true;
  for (int i = -5; i <= 5; ++i) {
    const double angle_rad = bearing_rad + M_PI + 0.2 * i;
    detection.hits.push_back(centre + radius_m * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return detection;
}

/// What that sensor measures of a disc, and nothing else for 20 m.
std::vector<Beam> beams_at(const Vector2& centre, double radius_m, double time_s) {
  std::vector<Beam> beams;
  for (int i = 0; i < 720; ++i) {
    const double angle_rad = i * M_PI / 360.0;
    const Vector2 ray(std::cos(angle_rad), std::sin(angle_rad));
    const double along_m = centre.dot(ray);
    const double half_m2 = radius_m * radius_m - (centre - along_m * ray).squaredNorm();
    const bool hit = along_m > 0.0 && half_m2 > 0.0;
    const Vector2 end = (hit ? along_m - std::sqrt(half_m2) : 20.0) * ray;
    beams.push_back(
        {Vector3::Zero(), {end.x(), end.y(), 0.0}, hit ? BeamEnd::kHit : BeamEnd::kMiss, time_s});
  }
  return beams;
}

TEST(ObstacleTracker, IsSureAfterTheThirdDetection) {
  ObstacleTracker tracker(shipped_sorter_options().tracker);
  for (int scan = 0; scan < 3; ++scan) {
    EXPECT_TRUE(tracker.at(0.1 * scan).empty());
    const auto moving =
        tracker.update({sighted({2.0, 0.1 * scan}, 0.2, 0.1 * scan)}, {}, 0.1 * scan);
    EXPECT_EQ(moving, std::vector<bool>{true});
  }
  const auto tracks = tracker.at(0.7);
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].time_s, 0.7);
  EXPECT_LT((tracks[0].position - Vector2(2.0, 0.7)).norm(), 0.1) << "predicted";
  EXPECT_LT((tracks[0].velocity - Vector2(0.0, 1.0)).norm(), 0.2);
  EXPECT_GT(tracks[0].covariance(0, 0), tracker.at(0.2)[0].covariance(0, 0));
}

TEST(ObstacleTracker, AThingThatTurnsRoundIsTheSameAndKnownToComeBackSoon) {
  constexpr double kTurns_s = 2.0;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  const TrackerOptions options = shipped_sorter_options().tracker;
  for (const double speed : {0.5, 0.8, 1.0, 1.3}) {
    for (int run = 0; run < 20; ++run) {
      ObstacleTracker tracker(options);
      for (double t = 0.0; t < kTurns_s + 0.35; t += 0.1) {
        const double along_m = speed * (t < kTurns_s ? t : 2.0 * kTurns_s - t);
        const Vector2 place(2.0 + along_m + noise(random), 1.0 + noise(random));
        tracker.update({sighted(place, 0.25, t)}, beams_at(place, 0.25, t), t);
      }
      const auto tracks = tracker.at(kTurns_s + 0.3);
      ASSERT_EQ(tracks.size(), 1u) << speed;
      EXPECT_EQ(tracks[0].id, 1u);
      EXPECT_LT((tracks[0].velocity - Vector2(-speed, 0.0)).norm(), 0.6) << speed;
    }
  }
}

/// Two legs beside each other.
Detection legs_at(const Vector2& centre, double time_s) {
  Detection detection = sighted(centre, 0.25, time_s);
  detection.hits.clear();
  for (const double aside_m : {-0.14, -0.12, -0.1, 0.1, 0.12, 0.14})
    detection.hits.push_back(centre + Vector2(-0.05, aside_m));
  detection.legs = 2;
  return detection;
}

TEST(ObstacleTracker, WhatHasComeAndDoesNotMoveSoonBelongsIntoTheMap) {
  ObstacleTracker tracker(shipped_sorter_options().tracker);
  for (int scan = 0; scan < 20; ++scan) {
    const double time_s = 0.1 * scan;
    const auto moving = tracker.update({sighted({2.0, 0.0}, 0.2, time_s)}, {}, time_s);
    EXPECT_EQ(moving, std::vector<bool>{scan < 9}) << "0.6 m at 0.7 m/s";
    for (const TrackedObstacle& thing : tracker.at(time_s)) EXPECT_FALSE(thing.is_mover) << time_s;
  }
}

TEST(ObstacleTracker, WhatMovesIsAMoverUntilItHasStoodForAWhileAndIsFollowedOn) {
  ObstacleTracker tracker(shipped_sorter_options().tracker);
  for (int scan = 0; scan < 70; ++scan) {
    const double time_s = 0.1 * scan;
    const Vector2 place(4.0 - std::min(2.0, time_s), 0.0);  // comes nearer, and stands
    const auto moving = tracker.update({sighted(place, 0.2, time_s)}, {}, time_s);
    const auto tracks = tracker.at(time_s);
    if (scan < 5) continue;
    ASSERT_EQ(tracks.size(), 1u);
    EXPECT_EQ(tracks[0].id, 1u);
    if (scan > 45 && scan < 51) continue;  // 3 s after the last place that it left
    EXPECT_EQ(tracks[0].is_mover, scan < 48) << time_s;
    EXPECT_EQ(moving[0], tracks[0].is_mover) << time_s;
  }
}

TEST(ObstacleTracker, WhatLooksLikeTwoLegsIsAPersonAlsoWhereItStands) {
  ObstacleTracker tracker(shipped_sorter_options().tracker);
  for (int scan = 0; scan < 50; ++scan) {
    const double time_s = 0.1 * scan;
    Detection person = legs_at({2.0, 0.5}, time_s);
    person.has_come = false;  // it was there from the beginning
    Detection post = sighted({2.0, -1.5}, 0.1, time_s);
    post.has_come = false;
    post.legs = 1;
    EXPECT_EQ(tracker.update({person, post}, {}, time_s), std::vector<bool>(2, false));
    if (scan < 3) continue;
    for (const TrackedObstacle& thing : tracker.at(time_s)) {
      EXPECT_EQ(thing.is_mover, thing.position.y() > 0.0);
      EXPECT_TRUE(thing.is_mapped);
    }
    EXPECT_EQ(tracker.at(time_s).size(), 2u);
  }
}

TEST(ObstacleTracker, OfDiscsThatCannotBeApartTheOlderStays) {
  ObstacleTracker tracker(shipped_sorter_options().tracker);
  for (int scan = 0; scan < 20; ++scan) {
    const double time_s = 0.1 * scan;
    std::vector<Detection> legs = {sighted({2.0, 0.0}, 0.2, time_s)};
    if (scan > 2) legs.push_back(sighted({2.0, std::max(0.05, 1.0 - 0.08 * scan)}, 0.2, time_s));
    tracker.update(legs, {}, time_s);
    if (scan == 8) {
      EXPECT_EQ(tracker.at(time_s).size(), 2u);
    }
  }
  ASSERT_EQ(tracker.at(2.0).size(), 1u);
  EXPECT_EQ(tracker.at(2.0)[0].id, 1u);
}

TEST(ObstacleTracker, ForgetsWhatItDoesNotSee) {
  ObstacleTracker tracker(shipped_sorter_options().tracker);
  for (int scan = 0; scan < 5; ++scan)
    tracker.update({sighted({2.0, 0.0}, 0.2, 0.1 * scan)}, {}, 0.1 * scan);
  tracker.update({}, {}, 1.0);
  EXPECT_EQ(tracker.at(1.0).size(), 1u);
  tracker.update({}, {}, 1.2);
  EXPECT_TRUE(tracker.at(1.2).empty());
}

TEST(ObstacleTracker, RefusesBadParameters) {
  TrackerOptions options = shipped_sorter_options().tracker;
  options.measurement_noise_m = 0.0;
  EXPECT_THROW(ObstacleTracker{options}, std::invalid_argument);
  options = shipped_sorter_options().tracker;
  options.max_radius_m = 0.1;
  EXPECT_THROW(ObstacleTracker{options}, std::invalid_argument);
}

}  // namespace
}  // namespace mocha
