#include <gtest/gtest.h>

#include <atomic>

#include "planning/street.h"

namespace mocha {
namespace {

constexpr double kFront_m = 0.3;    // of the rover, from its centre
constexpr double kPerson_m = 0.25;  // radius

OccupancyGrid square() { return free_grid({-8.0, -6.0}, {16.0, 6.0}); }

/// Along x, as wide as given between the walls.
OccupancyGrid corridor(double width_m) {
  OccupancyGrid grid = free_grid({-4.0, -3.0}, {18.0, 3.0});
  fill_box(grid, {-4.0, 0.5 * width_m}, {18.0, 3.0});
  fill_box(grid, {-4.0, -3.0}, {18.0, -0.5 * width_m});
  return grid;
}

/// Of a robot that dithers, more is seen than a swerve out, past and back.
void expect_steady(const Street& street, int swings) {
  EXPECT_LE(street.yaw_swings, swings);
  EXPECT_LE(street.switches, 2);
}

TEST(People, OneCrosses) {
  for (const double speed : {0.4, 0.8, 1.3}) {
    SCOPED_TRACE(speed);
    Street street(square(), {9.0, 0.0}, {{{4.0, -4.0 * speed}, {{60.0, {0.0, speed}}}}});
    street.begin_rolling();
    EXPECT_TRUE(street.run_to_goal(40.0)) << street.loop.output.message;
    EXPECT_GT(street.least_gap_m, 0.0);
    EXPECT_EQ(street.loop.emergencies, 0);
    expect_steady(street, 6);
  }
}

TEST(People, OneWhoStandsAppearsAMetreAhead) {
  Street street(square(), {9.0, 0.0});
  street.begin_rolling(0.97);
  street.run(2.0);
  ASSERT_GT(street.loop.state().twist.speed, 0.9);
  const Vector2 appears = street.here() + Vector2(kFront_m + 1.0 + kPerson_m, 0.0);
  street.walkers = {{appears, {}, kPerson_m, street.t()}};
  EXPECT_TRUE(street.run_to_goal(60.0)) << street.loop.output.message;
  EXPECT_GT(street.least_gap_m, 0.0);
}

TEST(People, OneWhoWalksTowardsItAppearsAMetreAhead) {
  Street street(square(), {9.0, 0.0});
  street.begin_rolling(0.97);
  street.run(2.0);
  const Vector2 appears = street.here() + Vector2(kFront_m + 1.0 + kPerson_m, 0.0);
  Walker walker{appears, {{street.t(), {0.0, 0.0}}, {9.0, {-0.5, 0.0}}}, kPerson_m, street.t()};
  street.walkers = {walker};
  EXPECT_TRUE(street.run_to_goal(60.0)) << street.loop.output.message;
  // It cannot both brake and back off in the second that is left; but it hardly moves any more.
  EXPECT_LT(street.contact_speed, 0.3);
}

TEST(People, OneStandsWhereADetourWouldComeBack) {
  Street street(square(), {10.0, 0.0}, {{{3.5, 0.0}, {}}, {{5.2, 0.0}, {}}});
  street.begin_rolling();
  EXPECT_TRUE(street.run_to_goal(60.0)) << street.loop.output.message;
  EXPECT_GT(street.least_gap_m, 0.0);
  expect_steady(street, 8);
}

TEST(People, OneWhoIsFasterComesFromBehind) {
  for (const double aside_m : {0.0, 0.2, -0.4}) {
    SCOPED_TRACE(aside_m);
    Street street(square(), {10.0, 0.0}, {{{-4.0, aside_m}, {{60.0, {1.6, 0.0}}}}});
    street.begin_rolling();
    EXPECT_TRUE(street.run_to_goal(60.0)) << street.loop.output.message;
    EXPECT_GT(street.least_gap_m, 0.0);
  }
}

TEST(People, OneComesFromBehindBeforeItHasSetOff) {
  struct Case {
    double width_m;
    double speed;
    double behind_m;
  };
  // Where it is narrow, he has to be farther away for there to be a way past.
  for (const auto& [width_m, speed, behind_m] :
       {Case{2.4, 1.0, 2.5}, Case{2.4, 1.27, 3.7}, Case{3.4, 1.27, 3.0}, Case{3.4, 1.5, 3.7}}) {
    for (const double aside_m : {-0.05, 0.05}) {
      SCOPED_TRACE(testing::Message() << speed << " m/s, " << behind_m << " m behind, " << width_m);
      Street street(corridor(width_m), {10.0, 0.0},
                    {{{-behind_m, aside_m}, {{60.0, {speed, 0.0}}}}});
      EXPECT_TRUE(street.run_to_goal(40.0)) << street.loop.output.message;
      EXPECT_GT(street.least_gap_m, 0.0);
    }
  }
}

/// A person that has walked one way and turns round at once, before a robot at full speed.
struct TurnsRound {
  double gap_m;    ///< from body to body when he turns
  double aside_m;  ///< of the robot's way, then
  double speed;
  double course_rad;  ///< in which he has walked

  Street street() const {
    constexpr double kTurns_s = 1.5;
    constexpr double kSeen_s = 0.3;  // before
    Street street(square(), {9.0, 0.0});
    street.begin_rolling();
    const double along_m = std::sqrt(std::pow(gap_m + kFront_m + kPerson_m, 2) - aside_m * aside_m);
    const Vector2 turns(0.9 * kTurns_s + along_m, aside_m);
    const Vector2 velocity = speed * Vector2(std::cos(course_rad), std::sin(course_rad));
    street.walkers = {{turns - kSeen_s * velocity,
                       {{kTurns_s - kSeen_s, {0.0, 0.0}}, {kSeen_s, velocity}, {20.0, -velocity}},
                       kPerson_m,
                       kTurns_s - kSeen_s}};
    return street;
  }
};

TEST(People, OneWhoTurnsRoundIsAvoided) {
  for (const double aside_m : {-0.3, -0.1, 0.1, 0.3}) {
    for (const double speed : {0.5, 1.0}) {
      for (const double course_rad : {-0.6, 0.0, 0.6, 1.2}) {
        SCOPED_TRACE(testing::Message() << aside_m << " m, " << speed << " m/s, " << course_rad);
        Street street = TurnsRound{1.6, aside_m, speed, course_rad}.street();
        EXPECT_TRUE(street.run_to_goal(40.0)) << street.loop.output.message;
        // Straight at it at 1 m/s, there is time to stop, but not to get out of the way.
        const bool hopeless = std::abs(aside_m) < 0.2 && speed > 0.9 && course_rad == 0.0;
        EXPECT_TRUE(hopeless || street.least_gap_m > 0.0) << street.least_gap_m;
        EXPECT_LT(street.contact_speed, 0.05);
      }
    }
  }
}

TEST(People, TwoCloseAGap) {
  for (const double speed : {0.3, 0.6}) {
    SCOPED_TRACE(speed);
    // They meet in the middle about when the robot would be there, and stand for a while.
    const double walks_s = 4.0;
    const double apart_m = walks_s * speed + kPerson_m;
    Street street(square(), {9.0, 0.0},
                  {{{4.0, apart_m}, {{walks_s, {0.0, -speed}}}},
                   {{4.0, -apart_m}, {{walks_s, {0.0, speed}}}}});
    street.begin_rolling();
    EXPECT_TRUE(street.run_to_goal(60.0)) << street.loop.output.message;
    EXPECT_GT(street.least_gap_m, 0.0);
  }
}

TEST(People, OneInFrontIsFollowedWhereThereIsNoRoomToOvertake) {
  Street street(corridor(1.5), {12.0, 0.0}, {{{2.0, 0.0}, {{60.0, {0.35, 0.0}}}}});
  street.begin_rolling(0.6);
  street.run(20.0);
  EXPECT_GT(street.least_gap_m, 0.0);
  EXPECT_GT(street.here().x(), 4.0);  // behind one that is at 9 by then
  EXPECT_LT(street.here().x(), street.walkers[0].place(street.t()).x());
  expect_steady(street, 14);
}

TEST(People, OneInFrontIsOvertakenWhereThereIsRoom) {
  Street street(corridor(4.4), {12.0, 0.0}, {{{2.5, 0.0}, {{60.0, {0.3, 0.0}}}}});
  street.begin_rolling();
  EXPECT_TRUE(street.run_to_goal(25.0)) << street.loop.output.message;
  EXPECT_LT(street.walkers[0].place(street.t()).x(), 10.5);  // it is behind
  EXPECT_GT(street.least_gap_m, 0.0);
  expect_steady(street, 6);
}

TEST(People, OneComesHeadOnInACorridorWithRoom) {
  for (const double aside_m : {0.0, 0.15, -0.3}) {
    SCOPED_TRACE(aside_m);
    Street street(corridor(3.4), {10.0, 0.0}, {{{8.0, aside_m}, {{60.0, {-0.8, 0.0}}}}});
    street.begin_rolling();
    EXPECT_TRUE(street.run_to_goal(40.0)) << street.loop.output.message;
    EXPECT_GT(street.least_gap_m, 0.0);
    expect_steady(street, 6);
  }
}

TEST(People, OneStopsAndStarts) {
  for (const double stands_s : {0.5, 1.5, 4.0}) {
    SCOPED_TRACE(stands_s);
    Street street(square(), {9.0, 0.0},
                  {{{4.0, -3.0},
                    {{3.0, {0.0, 0.8}},
                     {stands_s, {0.0, 0.0}},
                     {2.0, {0.0, 0.8}},
                     {stands_s, {0.0, 0.0}},
                     {60.0, {0.0, 0.8}}}}});
    street.begin_rolling();
    EXPECT_TRUE(street.run_to_goal(60.0)) << street.loop.output.message;
    EXPECT_GT(street.least_gap_m, 0.0);
  }
}

TEST(People, OneTurns) {
  for (const double turns_s : {2.0, 3.0, 4.0}) {
    SCOPED_TRACE(turns_s);
    Street street(square(), {9.0, 0.0},
                  {{{4.5, 3.0}, {{turns_s, {0.0, -0.7}}, {60.0, {-0.7, 0.0}}}}});
    street.begin_rolling();
    EXPECT_TRUE(street.run_to_goal(60.0)) << street.loop.output.message;
    // A person that turns straight towards it a second away may walk into it, but it does not
    // drive.
    EXPECT_LT(street.contact_speed, 0.05);
  }
}

/// As a tracker sees people that is not sure, with errors drawn anew each time it looks. What they
/// are decides about a single drive; the planner decides about many.
TEST(People, JitterOfPredictionsIsNotPassedOn) {
  const Walker stands{{5.0, 0.05}, {}};
  const Walker crosses{{4.0, -3.2}, {{60.0, {0.0, 0.8}}}};
  const Walker comes_head_on{{8.0, 0.0}, {{60.0, {-0.8, 0.0}}}};
  const Walker is_overtaken{{2.5, 0.0}, {{60.0, {0.3, 0.0}}}};
  constexpr int kDraws = 10;
  int unsteady = 0;       // drives in which more is seen than a swerve out, past and back
  double switches = 0.0;  // these are per drive
  double yaw_swings = 0.0;
  double proposals_per_s = 0.0;
  for (const Walker& walker : {stands, crosses, comes_head_on, is_overtaken}) {
    for (int draw = 0; draw < kDraws; ++draw) {
      SCOPED_TRACE(testing::Message() << walker.start.transpose() << ", draw " << draw);
      Street street(square(), {10.0, 0.0}, {walker});
      street.noise_m = 0.03;
      street.noise_mps = 0.1;
      street.random.seed(draw);
      street.begin_rolling();
      EXPECT_TRUE(street.run_to_goal(40.0)) << street.loop.output.message;
      EXPECT_GT(street.least_gap_m, 0.0);
      EXPECT_LE(street.switches, 4);
      EXPECT_LE(street.yaw_swings, 12);
      EXPECT_LT(street.loop.proposals / street.t(), 4.0);
      unsteady += street.switches > 2 || street.yaw_swings > 8;
      switches += street.switches / (4.0 * kDraws);
      yaw_swings += street.yaw_swings / (4.0 * kDraws);
      proposals_per_s += street.loop.proposals / street.t() / (4.0 * kDraws);
    }
  }
  EXPECT_LE(unsteady, 2);
  EXPECT_LT(switches, 0.4);
  EXPECT_LT(yaw_swings, 4.5);
  EXPECT_LT(proposals_per_s, 2.0);
}

/// Counts how often it is looked at.
class Counted : public PredictedDisc {
 public:
  Counted(std::atomic<long>& looks, double t0, const Vector2& centre, const Vector2& velocity)
      : PredictedDisc("one of many", t0, centre, velocity, kPerson_m, 0.02), looks_(looks) {}
  Disc at(double t) const override {
    ++looks_;
    return PredictedDisc::at(t);
  }

 private:
  std::atomic<long>& looks_;
};

/// The most looks at one of so many things in one step, over several steps among them.
double looks_each(int count, double nearest_m, double farthest_m) {
  Street street(square(), {9.0, 0.0});
  street.begin_rolling();
  street.run(1.0);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::atomic<long> looks{0};
  double most = 0.0;
  for (int step = 0; step < 5; ++step) {
    street.loop.moving.clear();
    for (int i = 0; i < count; ++i) {
      const double course = 2.0 * M_PI * unit(random);
      const double apart_m = nearest_m + (farthest_m - nearest_m) * unit(random);
      const Vector2 direction(std::cos(course), std::sin(course));
      street.loop.moving.push_back(
          std::make_shared<Counted>(looks, street.loop.now_s, street.here() + apart_m * direction,
                                    Vector2(unit(random) - 0.5, unit(random) - 0.5)));
    }
    street.loop.expected = street.loop.moving;
    looks = 0;
    street.loop.step();
    most = std::max(most, static_cast<double>(looks) / count);
  }
  return most;
}

TEST(People, TenThousandOfThemAreBoundedWork) { EXPECT_LT(looks_each(10000, 20.0, 90.0), 100.0); }

TEST(People, AHundredAllAroundAreBoundedWork) { EXPECT_LT(looks_each(100, 1.0, 6.0), 40000.0); }

}  // namespace
}  // namespace mocha
