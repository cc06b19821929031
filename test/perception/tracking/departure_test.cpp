#include "perception/tracking/departure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "perception/room.h"

namespace mocha {
namespace {

/// Beams from the origin, half a degree apart, that end where `range_m` says.
template <class Range>
std::vector<Beam> beams_to(const Range& range_m) {
  std::vector<Beam> beams;
  for (int i = -90; i <= 90; ++i) {
    const double angle_rad = i * M_PI / 360.0;
    const double length_m = range_m(angle_rad);
    beams.push_back({Vector3::Zero(),
                     {length_m * std::cos(angle_rad), length_m * std::sin(angle_rad), 0.0},
                     BeamEnd::kHit,
                     0.0});
  }
  return beams;
}

/// The hits nearer than `nearer_than_m`, as one thing.
Detection detected(const std::vector<Beam>& beams, double nearer_than_m) {
  Detection detection{};
  detection.right_rad = INFINITY;
  detection.left_rad = -INFINITY;
  for (const Beam& beam : beams) {
    if (beam.end.norm() > nearer_than_m) continue;
    const double bearing_rad = std::atan2(beam.end.y(), beam.end.x());
    detection.right_rad = std::min(detection.right_rad, bearing_rad);
    detection.left_rad = std::max(detection.left_rad, bearing_rad);
    detection.hits.push_back(beam.end.head<2>());
  }
  return detection;
}

/// A disc before a wall 5 m away.
std::vector<Beam> disc_at(const Vector2& centre, double radius_m) {
  return beams_to([&](double angle_rad) {
    const Vector2 ray(std::cos(angle_rad), std::sin(angle_rad));
    const double along_m = centre.dot(ray);
    const double half_m2 = radius_m * radius_m - (centre - along_m * ray).squaredNorm();
    return half_m2 < 0.0 ? 5.0 : along_m - std::sqrt(half_m2);
  });
}

Departure departure_of_disc(const Vector2& from, const Vector2& to, double radius_m = 0.2) {
  const Detection before = detected(disc_at(from, radius_m), 4.9);
  const std::vector<Beam> beams = disc_at(to, radius_m);
  return departure({from, before.hits}, detected(beams, 4.9), to, beams);
}

TEST(Departure, WhatGoesAnyWay) {
  const Vector2 here(3.0, 0.0);
  EXPECT_EQ(departure_of_disc(here, here), Departure::kNone);
  EXPECT_EQ(departure_of_disc(here, {3.05, 0.1}), Departure::kNone) << "an error of the pose";
  EXPECT_EQ(departure_of_disc(here, {3.0, 0.6}), Departure::kLeft);
  EXPECT_EQ(departure_of_disc(here, {3.0, -0.6}), Departure::kLeft);
  EXPECT_EQ(departure_of_disc(here, {2.6, 0.0}), Departure::kLeft)
      << "its place is hidden by itself";
  EXPECT_EQ(departure_of_disc(here, {3.4, 0.0}), Departure::kLeft) << "its place is passed";
}

TEST(Departure, IsUntoldWhereNothingShowsThePlace) {
  const Vector2 from(3.0, 0.0);
  const Vector2 to(3.0, 1.0);
  const Detection before = detected(disc_at(from, 0.2), 4.9);
  std::vector<Beam> beams = disc_at(to, 0.2);
  const Detection now = detected(beams, 4.9);
  EXPECT_EQ(departure({from, before.hits}, now, to, beams), Departure::kLeft);
  const std::vector<Beam> other = disc_at({1.5, 0.0}, 0.3);  // has come between
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (other[i].end.norm() < beams[i].end.norm()) beams[i] = other[i];
  }
  EXPECT_EQ(departure({from, before.hits}, now, to, beams), Departure::kUntold);
  std::vector<Beam> edge = beams;  // beside which a part of the place is seen
  const std::vector<Beam> wall = beams_to([](double) { return 5.0; });
  std::copy_n(wall.begin(), wall.size() / 2 - 2, edge.begin());
  EXPECT_EQ(departure({from, before.hits}, now, to, edge), Departure::kUntold);
  beams.erase(std::remove_if(beams.begin(), beams.end(),
                             [](const Beam& beam) { return beam.end.norm() < 2.0; }),
              beams.end());
  EXPECT_EQ(departure({from, before.hits}, now, to, beams), Departure::kUntold) << "unseen";
}

TEST(Departure, NotOfAPieceOfAWallOfWhichAnotherPartIsSeen) {
  // Beside the robot, seen at a slant; a piece of it before, and one farther on now.
  const auto wall = beams_to(
      [](double angle_rad) { return std::min(8.0, 1.0 / std::max(1e-6, std::sin(angle_rad))); });
  const auto piece = [&](double from_m, double to_m) {
    Detection detection = detected(wall, 7.9);
    std::vector<Vector2> hits;
    for (const Vector2& hit : detection.hits) {
      if (hit.x() > from_m && hit.x() < to_m) hits.push_back(hit);
    }
    detection.hits = hits;
    return detection;
  };
  const Detection before = piece(1.0, 1.8);
  const Detection now = piece(2.2, 3.2);
  ASSERT_GT(before.hits.size(), 3u);
  ASSERT_GT(now.hits.size(), 3u);
  EXPECT_EQ(departure({{1.4, 1.0}, before.hits}, now, {2.7, 1.0}, wall), Departure::kNone);
}

}  // namespace
}  // namespace mocha
