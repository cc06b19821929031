#include "perception/scan_sorter.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "watch.h"

namespace mocha {
namespace {

/// Normalised estimation error squared: about 4 on average for an honest covariance, less for a
/// cautious one.
double nees(const TrackedObstacle& track, const Vector2& position, const Vector2& velocity) {
  Eigen::Vector4d error;
  error << track.position - position, track.velocity - velocity;
  return error.dot(track.covariance.ldlt().solve(error));
}

TEST(ScanSorter, FollowsWhoWalksPastAndMapsNothingOfHim) {
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
  EXPECT_GT(sum / tracked, 0.05) << "nor to be of no use";
  printf("nees %.3f\n", sum / tracked);
}

TEST(ScanSorter, VelocityIsSteadyPastTheRobot) {
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

TEST(ScanSorter, WhoIsThereFromTheStartIsTrackedOnceHeWalksAndLeavesNoTrace) {
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

TEST(ScanSorter, WhoStandsBecomesMapAndLeavesNoGhost) {
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
       {Vector2(0.0, 1.0), Vector2(-1.0, 0.0), Vector2(1.0, 0.2), Vector2(0.0, 0.4)}) {
    watch.walkers = {walker(0.25, place, velocity, watch.time_s, watch.time_s + 1.5)};
    const double begun_s = watch.time_s;
    double gone_s = 0.0;
    double tracked_s = 0.0;
    for (int scan = 0; scan < 30; ++scan) {
      watch.look();
      if (watch.occupied_within(place, 0.35) > 0) gone_s = watch.time_s - begun_s;
      if (watch.tracks().empty() && tracked_s < 0.05 + 0.1 * scan)
        tracked_s = watch.time_s - begun_s;
    }
    printf("v %.1f %.1f: gone %.1f tracked %.1f\n", velocity.x(), velocity.y(), gone_s, tracked_s);
    watch.walkers = {walker(0.25, place, {0.0, 0.0})};
    watch.look_for(8.0);
  }
}

/// Two people whose ways cross; returns the fastest velocity shown and the ids seen.
TEST(ScanSorter, PeopleWhoPassEachOtherKeepTheirVelocities) {
  struct Meeting {
    Vector2 from[2];
    Vector2 velocity[2];
  };
  const Meeting meetings[] = {
      {{{2.0, -2.5}, {2.7, 2.0}}, {{0.0, 1.0}, {0.0, -1.0}}},   // side by side
      {{{1.5, -2.5}, {3.5, -2.5}}, {{0.5, 1.0}, {-0.5, 1.0}}},  // ways cross, 0.4 s apart
      {{{1.5, -2.0}, {2.6, -2.5}}, {{0.0, 1.0}, {0.0, 1.3}}},   // one overtakes behind the other
      {{{2.0, -2.0}, {2.6, -2.0}}, {{0.0, 0.9}, {0.0, 0.9}}}};  // abreast
  for (const Meeting& meeting : meetings) {
    Watch watch{Room()};
    watch.look_for(1.0);
    const double begun_s = watch.time_s;
    for (int i : {0, 1})
      watch.walkers.push_back(
          walker(0.22, meeting.from[i], meeting.velocity[i], begun_s - 0.4 * i));
    std::set<std::uint32_t> ids;
    for (int scan = 0; scan < 40; ++scan) {
      watch.look();
      printf("%.1f:", 0.1 * scan);
      for (const TrackedObstacle& track : watch.tracks()) {
        ids.insert(track.id);
        double off = 10.0, voff = 0.0;
        for (const auto& w : watch.walkers) {
          const double d = (w.at(watch.time_s - 0.1) - track.position).norm();
          if (d < off) {
            off = d;
            voff = (track.velocity - meeting.velocity[&w - &watch.walkers[0]]).norm();
          }
        }
        printf("  %d off %.2f voff %.2f r %.2f", track.id, off, voff, track.radius_m);
      }
      printf("\n");
    }
    printf("---- ids %zu\n", ids.size());
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

TEST(ScanSorter, ARobotThatDrivesAmongStandingThingsSeesNothingMove) {
  Senses senses;
  senses.jitter_m = 0.01;
  senses.jitter_rad = 0.3 * M_PI / 180.0;
  for (int seed = 1; seed <= 10; ++seed) {
    Watch watch(cluttered(seed), seed, senses);
    OccupancyMap plain{OccupancyMapOptions()};
    int tracks = 0, hits = 0;
    double fastest = 0.0;
    for (int scan = 0; scan < 300; ++scan) {  // 1.5 rounds at 0.5 m/s, looking about
      const double angle = 0.0333 * scan;
      const Pose pose{1.5 * Vector2(std::cos(angle), std::sin(angle)),
                      angle + 2.0 * std::sin(0.05 * scan)};
      watch.look(pose);
      auto beams = watch.newest;
      for (Beam& beam : beams)
        if (beam.kind == BeamEnd::kIgnored) beam.kind = BeamEnd::kHit;
      plain.insert_scan(beams);
      hits += watch.sorter.moving_hits();
      for (const auto& track : watch.tracks()) {
        ++tracks;
        fastest = std::max(fastest, track.velocity.norm());
      }
    }
    const auto a = watch.map.occupied_voxels().size();
    const auto b = plain.occupied_voxels().size();
    printf("seed %d: tracks %d fastest %.2f hits %d cells %zu plain %zu\n", seed, tracks, fastest,
           hits, a, b);
  }
}

TEST(ScanSorter, TakesGarbageAndIsQuick) {
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
    EXPECT_NO_THROW(watch.sorter.sort(beams, watch.map));
    for (const TrackedObstacle& track : watch.tracks()) {
      EXPECT_TRUE(track.position.allFinite() && track.velocity.allFinite());
      EXPECT_TRUE(track.covariance.allFinite());
    }
  }
  std::vector<Beam> none;
  watch.sorter.sort(none, watch.map);
}

TEST(ScanSorter, TakesLittleTime) {
  Watch watch{cluttered(3)};
  for (int i = 0; i < 4; ++i)
    watch.walkers.push_back(walker(0.25, {3.5 - i, -2.0}, {0.0, 1.0}, 101.0));
  watch.look_for(3.0);
  auto beams = watch.scan({});
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 100; ++i) {
    auto copy = beams;
    watch.sorter.sort(copy, watch.map);
  }
  const double each_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count() /
      100;
  printf("%.3f ms\n", each_ms);
  EXPECT_LT(each_ms, 2.0);
}

}  // namespace
}  // namespace mocha
