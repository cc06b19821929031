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
  for (int i = -5; i <= 5; ++i) {
    const double angle_rad = bearing_rad + M_PI + 0.2 * i;
    detection.hits.push_back(centre + radius_m * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return detection;
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
        tracker.update({sighted(place, 0.25, t)}, {}, t);
      }
      const auto tracks = tracker.at(kTurns_s + 0.3);
      ASSERT_EQ(tracks.size(), 1u) << speed;
      EXPECT_EQ(tracks[0].id, 1u);
      EXPECT_LT((tracks[0].velocity - Vector2(-speed, 0.0)).norm(), 0.6) << speed;
    }
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
