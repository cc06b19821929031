#include "topology/space_time/space_time_tube.h"

#include <gtest/gtest.h>

#include <limits>

#include "topology/signatures/signature_sums.h"
#include "trajectory/random_motion.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

/// Without gaps over the given time; returns by how much its discs are too large at most, and
/// expects them to hold the true ones.
double check_tube(const Tube<2>& tube, const MovingObstacle& obstacle, double from_s,
                  double until_s, double keep_m) {
  EXPECT_EQ(tube.front().start_s, from_s);
  EXPECT_EQ(tube.back().end_s, until_s);
  double excess_m = 0.0;
  for (std::size_t i = 0; i < tube.size(); ++i) {
    const TubePiece<2>& piece = tube[i];
    EXPECT_LT(piece.start_s, piece.end_s);
    if (i > 0) {
      EXPECT_EQ(piece.start_s, tube[i - 1].end_s);
      EXPECT_LT((piece.centre - tube[i - 1].centre_at(piece.start_s)).norm(), 1e-9);
    }
    for (int k = 0; k <= 50; ++k) {
      const double t = piece.start_s + (piece.end_s - piece.start_s) * k / 50.0;
      const auto disc = obstacle.at(t);
      const double apart_m = (disc.centre - piece.centre_at(t)).norm();
      EXPECT_LE(apart_m + disc.radius_m + keep_m, piece.radius_at(t) + 1e-9);
      excess_m = std::max(excess_m, piece.radius_at(t) - disc.radius_m - keep_m);
    }
  }
  return excess_m;
}

TEST(SpaceTimeTube, IsOnePieceAtConstantVelocity) {
  const PredictedDisc disc("person", 5.0, {1.0, 2.0}, {0.6, -0.8}, 0.25, 0.1);
  const Tube<2> tube = tube_of(disc, 6.0, 11.0, 0.4);
  ASSERT_EQ(tube.size(), 1u);
  EXPECT_LT(check_tube(tube, disc, 6.0, 11.0, 0.4), 1e-12);
  // Before it was seen the radius does not shrink, which one piece can only overstate.
  check_tube(tube_of(disc, 3.0, 8.0, 0.4), disc, 3.0, 8.0, 0.4);
  EXPECT_TRUE(tube_of(disc, 6.0, 6.0, 0.4).empty());
  EXPECT_TRUE(tube_of(disc, 6.0, std::nan(""), 0.4).empty());
}

TEST(SpaceTimeTube, HoldsTheDiscsOfATeamMate) {
  for (int seed = 0; seed < 40; ++seed) {
    const Motion drive = within(random_drive(seed, 5), {1.0, 1.0, 2.0}, 100.0);
    const Pose end = drive.end_pose();
    std::vector<Phase> phases = drive.phases();
    phases.emplace_back(StandPhase{end, 0.7});
    phases.emplace_back(TurnPhase{end, 1.0, 2.0});
    phases.emplace_back(StandPhase{{end.position + Vector2(5e-4, 5e-4), end.yaw_rad + 1.0}, 1.0});
    const PeerObstacle peer("ugv2", std::make_shared<const Motion>(100.0, phases), 0.3,
                            test::kRoverBraking);
    for (const double from_s : {98.5, 100.0, 102.3}) {
      const Tube<2> tube = tube_of(peer, from_s, from_s + 6.0, 0.2);
      EXPECT_LE(check_tube(tube, peer, from_s, from_s + 6.0, 0.2), 0.0301);
      EXPECT_LE(tube.size(), 40u);
    }
    const double rest_s = peer.rest_time();
    EXPECT_EQ(tube_of(peer, rest_s, rest_s + 9.0, 0.2).size(), 1u);
  }
}

TEST(SpaceTimeTube, HoldsWhatStartsAtSpeed) {
  const Motion drive = within(random_drive(3, 6), {1.2, 1.0, 2.0}, 100.0);
  const double cut_s = 0.5 * (drive.start_time() + drive.end_time());
  const PeerObstacle peer(
      "ugv2", std::make_shared<const Motion>(cut_s, drive.phases_between(cut_s, drive.end_time())),
      0.3, test::kRoverBraking);
  ASSERT_GT(peer.at(cut_s).velocity.norm(), 0.3);
  check_tube(tube_of(peer, cut_s - 0.63, cut_s + 3.0, 0.2), peer, cut_s - 0.63, cut_s + 3.0, 0.2);
}

template <int D>
void expect_exact_gaps() {
  using Place = Eigen::Matrix<double, D, 1>;
  std::mt19937_64 random(D);
  const auto place = [&] {
    Place p;
    for (double& x : p) x = uniform(random, -2.0, 2.0);
    return p;
  };
  for (int i = 0; i < 2000; ++i) {
    const double start_s = uniform(random, 0.0, 2.0);
    const TubePiece<D> piece = {start_s,
                                start_s + uniform(random, 0.1, 3.0),
                                place(),
                                i % 7 == 0 ? Place(Place::Zero()) : place(),
                                uniform(random, 0.0, 1.0),
                                i % 3 == 0 ? 0.0 : uniform(random, -3.0, 3.0)};
    const double p_s = uniform(random, 0.0, 2.0);
    const double q_s = i % 11 == 0 ? p_s : p_s + uniform(random, 0.1, 3.0);
    const Place p = place();
    const Place q = i % 11 == 0 ? p : place();
    double least_m = std::numeric_limits<double>::infinity();
    const double from_s = std::max(p_s, piece.start_s);
    const double until_s = std::min(q_s, piece.end_s);
    for (int k = 0; k <= 1000 && from_s <= until_s; ++k) {
      const double t = from_s + (until_s - from_s) * k / 1000.0;
      const Place at = q_s > p_s ? Place(p + (q - p) * (t - p_s) / (q_s - p_s)) : p;
      least_m = std::min(least_m, (at - piece.centre_at(t)).norm() - piece.radius_at(t));
    }
    const double gap_m = least_gap_m<D>(piece, p, p_s, q, q_s);
    if (std::isinf(least_m)) {
      EXPECT_EQ(gap_m, least_m);
    } else {
      EXPECT_LE(gap_m, least_m + 1e-9);
      EXPECT_GE(gap_m, least_m - 0.02);  // a step of the samples
    }
  }
}

TEST(SpaceTimeTube, GapsAreThoseOfSamples) {
  expect_exact_gaps<2>();
  expect_exact_gaps<3>();
}

}  // namespace
}  // namespace mocha
