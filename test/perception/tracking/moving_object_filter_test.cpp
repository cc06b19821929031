#include "perception/tracking/moving_object_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

/// Normalised estimation error squared: about 4 on average for an honest covariance, less for a
/// cautious one.
double nees(const TrackedObstacle& track, const Vector2& position, const Vector2& velocity) {
  Eigen::Vector4d error;
  error << track.position - position, track.velocity - velocity;
  return error.dot(track.covariance.ldlt().solve(error));
}

TEST(MovingObjectFilter, FollowsAPersonWalkingPastAndMapsNothingOfIt) {
  double sum = 0.0;
  int tracked = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    Watch watch(Room(), seed);
    watch.look_for(1.0);
    const Vector2 velocity(-1.0, 0.01 * seed);
    watch.walkers = {walker(0.25, {4.0, 0.8}, velocity, watch.time_s)};
    const double begun_s = watch.time_s;
    for (int scan = 0; scan < 60; ++scan) {
      watch.look();
      const double time_s = begun_s + 0.1 * scan;
      const Vector2 truth = watch.walkers[0].at(time_s);
      EXPECT_EQ(watch.occupied_within(truth, 0.3), 0);
      const auto tracks = watch.tracks();
      if (scan < 2) continue;
      ASSERT_EQ(tracks.size(), 1u) << "seed " << seed << ", scan " << scan;
      EXPECT_EQ(tracks[0].id, 1u);
      sum += nees(tracks[0], truth, velocity);
      ++tracked;
      if (scan < 10) continue;
      EXPECT_LT((tracks[0].position - truth).norm(), 0.1);
      EXPECT_LT((tracks[0].velocity - velocity).norm(), 0.15);
      EXPECT_NEAR(tracks[0].radius_m, 0.25, 0.03);
    }
  }
  EXPECT_LT(sum / tracked, 4.0) << "the covariance is not to promise too much";
  EXPECT_GT(sum / tracked, 0.05) << "and not to be of no use";
}

TEST(MovingObjectFilter, VelocityIsSteadyPastTheRobot) {
  for (double aside_m : {0.45, 0.7, 1.2}) {
    for (double speed : {0.5, 1.0, 1.6}) {
      Watch watch{Room()};
      watch.look_for(1.0);
      const Vector2 velocity(-speed, 0.0);
      watch.walkers = {walker(0.25, {3.5, -aside_m}, velocity, watch.time_s)};
      const double begun_s = watch.time_s;
      while (watch.time_s < begun_s + 6.0 / speed) {
        watch.look();
        if (watch.time_s < begun_s + 1.05) continue;
        ASSERT_EQ(watch.tracks().size(), 1u) << aside_m << " m, " << speed << " m/s";
        EXPECT_LT((watch.tracks()[0].velocity - velocity).norm(), 0.2)
            << aside_m << " m, " << speed << " m/s, after " << watch.time_s - begun_s << " s";
      }
    }
  }
}

TEST(MovingObjectFilter, AWallAtAGrazingAngleDoesNotMove) {
  // Of a wall beside the lidar, few beams hit the far part. As the lidar turns, others hit it where
  // only beams along it have passed.
  for (const int beams : {360, 450, 600}) {
    Senses senses;
    senses.beams = beams;
    for (const double turn_rad : {0.003, 0.01}) {
      for (int seed = 1; seed <= 5; ++seed) {
        Watch watch({{-6.0, -0.1875}, {6.0, 6.0}, {}}, seed, senses);
        watch.look_for(3.0);
        for (int scan = 0; scan < 30; ++scan) {
          watch.look({{-0.003 * scan, 0.0}, -turn_rad * scan});
          EXPECT_EQ(watch.tracks().size(), 0u) << beams << " beams, " << turn_rad << ", " << scan;
        }
      }
    }
  }
}

TEST(MovingObjectFilter, APersonThereFromTheStartIsTrackedOnceItWalksAndLeavesNoTrace) {
  for (double speed : {0.3, 0.6, 1.2}) {
    Watch watch{Room()};
    watch.walkers = {walker(0.25, {2.0, -2.0}, {0.0, speed}, watch.time_s)};
    const double begun_s = watch.time_s;
    watch.look_for(1.0 / speed + 0.5);
    ASSERT_EQ(watch.tracks().size(), 1u) << speed;
    EXPECT_NEAR(watch.tracks()[0].velocity.y(), speed, 0.2) << speed;
    watch.look_for(1.0);
    EXPECT_EQ(watch.occupied_within({2.0, -2.0}, 0.35), 0) << speed;
    watch.look_for(begun_s + 3.0 / speed - watch.time_s);
    for (double y = -2.0; y < watch.walkers[0].at(watch.time_s).y(); y += 0.1)
      EXPECT_EQ(watch.occupied_within({2.0, y}, 0.35), 0) << speed << " m/s: " << y;
  }
}

TEST(MovingObjectFilter, AStandingPersonBecomesMapAndLeavesNoGhost) {
  Watch watch{Room()};
  watch.look_for(1.0);
  const double stop_s = watch.time_s + 2.0;
  const Vector2 place(2.0, 0.5);
  watch.walkers = {walker(0.25, {2.0, -1.5}, {0.0, 1.0}, watch.time_s, stop_s)};
  watch.look_for(4.0);  // two of them standing
  ASSERT_EQ(watch.tracks().size(), 1u);
  EXPECT_LT(watch.tracks()[0].velocity.norm(), 0.1);
  EXPECT_EQ(watch.occupied_within(place, 0.35), 0);
  watch.look_for(2.0);
  EXPECT_EQ(watch.tracks().size(), 0u);
  EXPECT_GT(watch.occupied_within(place, 0.35), 5);
  watch.look_for(3.0);
  EXPECT_EQ(watch.tracks().size(), 0u);

  for (const Vector2& velocity :
       {Vector2(0.0, 1.0), Vector2(-1.0, 0.0), Vector2(1.0, 0.2), Vector2(0.0, 0.5)}) {
    SCOPED_TRACE(velocity.transpose());
    const double speed = velocity.norm();
    watch.walkers = {walker(0.25, place, velocity, watch.time_s, watch.time_s + 1.5 / speed)};
    watch.look_for(1.5 / speed);
    ASSERT_EQ(watch.tracks().size(), 1u);
    EXPECT_LT((watch.tracks()[0].velocity - velocity).norm(), 0.2);
    watch.look_for(1.0);
    EXPECT_EQ(watch.occupied_within(place, 0.35), 0);
    watch.walkers = {walker(0.25, place, {0.0, 0.0})};
    watch.look_for(6.0);
  }
}

TEST(MovingObjectFilter, PeoplePassingEachOtherKeepTheirNumbersAndVelocities) {
  struct Meeting {
    Vector2 from[2];
    Vector2 velocity[2];
  };
  const Meeting meetings[] = {
      {{{2.0, -2.5}, {2.7, 2.0}}, {{0.0, 1.0}, {0.0, -1.0}}},   // in opposite directions
      {{{1.5, -2.5}, {3.5, -2.5}}, {{0.5, 1.0}, {-0.5, 1.0}}},  // their paths cross
      {{{1.5, -2.0}, {2.6, -2.5}}, {{0.0, 1.0}, {0.0, 1.3}}}};  // one overtakes behind the other
  for (const Meeting& meeting : meetings) {
    SCOPED_TRACE(meeting.from[1].transpose());
    Watch watch{Room()};
    watch.look_for(1.0);
    for (int i : {0, 1})
      watch.walkers.push_back(
          walker(0.22, meeting.from[i], meeting.velocity[i], watch.time_s - 0.4 * i));
    for (int scan = 0; scan < 35; ++scan) {
      watch.look();
      if (scan < 5) continue;
      const auto tracks = watch.tracks();
      ASSERT_EQ(tracks.size(), 2u) << scan;
      for (const TrackedObstacle& track : tracks) {
        ASSERT_LE(track.id, 2u);
        const int near =
            (track.position - watch.walkers[0].at(watch.time_s - 0.1)).norm() < 0.2 ? 0 : 1;
        EXPECT_LT((track.position - watch.walkers[near].at(watch.time_s - 0.1)).norm(), 0.2)
            << scan;
        EXPECT_LT((track.velocity - meeting.velocity[near]).norm(), 0.3) << scan;
      }
    }
  }
}

TEST(MovingObjectFilter, TwoPeopleWalkingAbreastAreCovered) {
  Watch watch{Room()};
  watch.look_for(1.0);
  for (double x : {2.0, 2.6})
    watch.walkers.push_back(walker(0.22, {x, -2.0}, {0.0, 0.9}, watch.time_s));
  int late = 0;
  for (int scan = 0; scan < 40; ++scan) {
    watch.look();
    if (scan < 5) continue;
    ASSERT_GE(watch.tracks().size(), 1u);
    for (const TrackedObstacle& track : watch.tracks())
      EXPECT_LT((track.velocity - Vector2(0.0, 0.9)).norm(), 0.6) << scan;
    double farthest_m = 0.0;
    for (const Beam& beam : watch.newest) {
      if (beam.kind != BeamEnd::kIgnored) continue;
      double outside_m = INFINITY;
      for (const TrackedObstacle& track : watch.tracks())
        outside_m =
            std::min(outside_m, (beam.end.head<2>() - track.position).norm() - track.radius_m);
      farthest_m = std::max(farthest_m, outside_m);
    }
    EXPECT_LT(farthest_m, 0.3) << scan;
    late += farthest_m > 0.15;
  }
  EXPECT_LE(late, 1) << "the scan in which the one comes out from behind the other";
}

/// Two legs, each still while the other swings: half a metre to a step, a second for two.
TEST(MovingObjectFilter, LegsAreOnePerson) {
  for (const Vector2& direction : {Vector2(0.0, 1.0), Vector2(-1.0, 0.0)}) {
    Watch watch{Room()};
    watch.look_for(1.0);
    const double begun_s = watch.time_s;
    const Vector2 from = direction.x() == 0.0 ? Vector2(1.8, -2.5) : Vector2(4.5, -1.0);
    for (int leg : {0, 1}) {
      watch.walkers.push_back(
          {0.07, [=](double t) {
             const double phase = t - begun_s + 0.5 * leg;
             const double step =
                 std::floor(phase) + std::min(1.0, 2.0 * (phase - std::floor(phase)));
             const Vector2 aside(-direction.y(), direction.x());
             return Vector2(from + (step - 0.5 * leg) * direction + (leg - 0.5) * 0.2 * aside);
           }});
    }
    std::set<std::uint32_t> ids;
    for (int scan = 0; scan < 40; ++scan) {
      watch.look();
      const double time_s = watch.time_s - 0.1;
      const Vector2 truth = 0.5 * (watch.walkers[0].at(time_s) + watch.walkers[1].at(time_s));
      if (scan < 20) continue;
      ASSERT_EQ(watch.tracks().size(), 1u) << scan;
      const TrackedObstacle track = watch.tracks()[0];
      ids.insert(track.id);
      EXPECT_LT((track.position - truth).norm(), 0.3) << scan;
      EXPECT_LT((track.velocity - direction).norm(), 0.5) << scan;
    }
    EXPECT_EQ(ids.size(), 1u);
  }
}

TEST(MovingObjectFilter, APersonGoingBehindSomethingIsExpectedOnTheOtherSide) {
  Room room;
  room.circles = {{{1.5, 0.0}, 0.3}};
  Watch watch{room};
  watch.look_for(1.0);
  watch.walkers = {walker(0.25, {3.0, -2.0}, {0.0, 1.2}, watch.time_s)};
  const double begun_s = watch.time_s;
  int hidden = 0;
  for (int scan = 0; scan < 35; ++scan) {
    watch.look();
    if (scan < 5) continue;
    if (watch.filter.moving_hits() == 0) ++hidden;
    ASSERT_EQ(watch.tracks().size(), 1u) << scan;
    EXPECT_EQ(watch.tracks()[0].id, 1u) << scan;
    EXPECT_LT((watch.tracks()[0].position - watch.walkers[0].at(begun_s + 0.1 * scan)).norm(), 0.2)
        << scan;
    EXPECT_LT((watch.tracks()[0].velocity - Vector2(0.0, 1.2)).norm(), 0.3) << scan;
  }
  EXPECT_GE(hidden, 2) << "else this tests nothing";
}

TEST(MovingObjectFilter, APersonThatIsGoneIsForgotten) {
  Watch watch{Room()};
  watch.look_for(1.0);
  watch.walkers = {walker(0.25, {2.0, -2.0}, {0.0, 1.0}, watch.time_s)};
  watch.look_for(2.0);
  ASSERT_EQ(watch.tracks().size(), 1u);
  watch.walkers.clear();
  watch.look_for(0.3);
  EXPECT_EQ(watch.tracks().size(), 0u) << "the place is seen free";

  watch.walkers = {walker(0.25, {2.0, -2.0}, {0.0, 1.0}, watch.time_s)};
  watch.look_for(2.0);
  ASSERT_EQ(watch.tracks().size(), 1u);
  const std::uint32_t id = watch.tracks()[0].id;
  const auto known = [&] {
    const auto tracks = watch.tracks();
    return std::any_of(tracks.begin(), tracks.end(), [&](const auto& t) { return t.id == id; });
  };
  watch.room.circles = {{{0.5, 0.0}, 0.4}};  // now something hides half of the room
  watch.walkers.clear();
  watch.look_for(1.0);
  EXPECT_TRUE(known());
  watch.look_for(1.5);
  EXPECT_FALSE(known());
}

TEST(MovingObjectFilter, TeamMatesAreNotTracked) {
  Watch watch{Room()};
  watch.look_for(1.0);
  watch.walkers = {walker(0.25, {2.0, -2.0}, {0.0, 1.0}, watch.time_s)};
  for (int scan = 0; scan < 30; ++scan) {
    std::vector<Beam> beams = watch.scan({});
    for (Beam& beam : beams) {
      if ((beam.end.head<2>() - watch.walkers[0].at(watch.time_s)).norm() < 0.4)
        beam.kind = BeamEnd::kIgnored;  // as PeerTracks does
    }
    watch.take(beams);
    EXPECT_EQ(watch.tracks().size(), 0u);
  }
}

TEST(MovingObjectFilter, TwoSensorsThatTakeTurnsFollowOneThing) {
  Watch watch{Room()};
  watch.look_for(1.0);
  const Vector2 velocity(-0.8, 0.6);
  watch.walkers = {walker(0.25, {3.0, -1.5}, velocity, watch.time_s)};
  for (int scan = 0; scan < 40; ++scan) {
    // The second one is heard first, 60 ms before its time.
    const double time_s = watch.time_s;
    for (double ahead_s : {0.06, 0.0}) {
      watch.time_s = time_s + ahead_s;
      watch.take(watch.scan({ahead_s == 0.0 ? Vector2(0.0, 0.0) : Vector2(-2.0, 1.0), 0.0}));
    }
    watch.time_s = time_s + 0.1;
    if (scan < 10) continue;
    const auto tracks = watch.filter.moving(time_s + 0.06);
    ASSERT_EQ(tracks.size(), 1u);
    EXPECT_LT((tracks[0].position - watch.walkers[0].at(time_s + 0.06)).norm(), 0.1);
    EXPECT_LT((tracks[0].velocity - velocity).norm(), 0.2);
  }
}

Room cluttered(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share;
  Room room;
  while (room.circles.size() < 14) {
    const Vector2 centre =
        room.low + (room.high - room.low).cwiseProduct(Vector2(share(random), share(random)));
    const double radius_m = 0.05 + 0.35 * share(random);
    if (std::abs(centre.norm() - 1.5) > radius_m + 0.35) room.circles.push_back({centre, radius_m});
  }
  return room;
}

TEST(MovingObjectFilter, ARobotThatDrivesAmongStandingThingsSeesNothingMove) {
  Senses senses;
  senses.jitter_m = 0.01;
  senses.jitter_rad = 0.3 * M_PI / 180.0;
  for (int seed = 1; seed <= 10; ++seed) {
    Watch watch(cluttered(seed), seed, senses);
    OccupancyMap plain{shipped_map_options()};
    for (int scan = 0; scan < 300; ++scan) {  // 2.4 rounds at 0.5 m/s, looking about
      const double angle = 0.0333 * scan;
      const Pose pose{1.5 * Vector2(std::cos(angle), std::sin(angle)),
                      angle + 2.0 * std::sin(0.05 * scan)};
      watch.look(pose);
      std::vector<Beam> beams = watch.newest;
      for (Beam& beam : beams) {
        if (beam.kind == BeamEnd::kIgnored) beam.kind = BeamEnd::kHit;
      }
      plain.insert_scan(beams);
      for (const TrackedObstacle& track : watch.tracks())
        EXPECT_LT(track.velocity.norm(), 0.3) << "seed " << seed << ", scan " << scan;
    }
    EXPECT_NEAR(static_cast<double>(watch.map.occupied_voxels().size()),
                static_cast<double>(plain.occupied_voxels().size()), 5.0);
  }
}

TEST(MovingObjectFilter, TakesGarbageAndIsQuick) {
  Watch watch{Room()};
  watch.look_for(1.0);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-8.0, 8.0);
  for (int scan = 0; scan < 20; ++scan) {
    std::vector<Beam> beams;
    for (int i = 0; i < 10000; ++i) {
      Beam beam{{coordinate(random), coordinate(random), 0.2},
                {coordinate(random), coordinate(random), 0.2},
                static_cast<BeamEnd>(i % 3),
                watch.time_s};
      if (i % 7 == 0) beam.end.x() = std::nan("");
      if (i % 11 == 0) beam.end.y() = INFINITY;
      if (i % 13 == 0) beam.origin = beam.end;
      beams.push_back(beam);
    }
    watch.time_s += 0.1;
    EXPECT_NO_THROW(watch.filter.sort(beams, watch.map));
    for (const TrackedObstacle& track : watch.tracks()) {
      EXPECT_TRUE(track.position.allFinite() && track.velocity.allFinite());
      EXPECT_TRUE(track.covariance.allFinite());
    }
  }
  std::vector<Beam> none;
  watch.filter.sort(none, watch.map);
}

TEST(MovingObjectFilter, TakesAboutTheTimeOfTheMap) {
  Watch watch{cluttered(3)};
  for (int i = 0; i < 4; ++i)
    watch.walkers.push_back(walker(0.25, {3.5 - i, -2.0}, {0.0, 1.0}, 101.0));
  watch.look_for(3.0);
  const auto beams = watch.scan({});
  std::chrono::nanoseconds sorting{0};
  std::chrono::nanoseconds mapping{0};
  for (int i = 0; i < 100; ++i) {
    auto copy = beams;
    const auto begin = std::chrono::steady_clock::now();
    watch.filter.sort(copy, watch.map);
    const auto sorted = std::chrono::steady_clock::now();
    watch.map.insert_scan(copy);
    sorting += sorted - begin;
    mapping += std::chrono::steady_clock::now() - sorted;
  }
  EXPECT_LT(sorting, 3 * mapping) << sorting.count() << " ns, and the map " << mapping.count();
}

}  // namespace
}  // namespace mocha
