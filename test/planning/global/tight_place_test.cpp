#include "planning/global/tight_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace mocha {
namespace {

constexpr int kMaxExpansions = 20000;

/// Solid is what lies beyond: normal . p > offset_m.
struct Wall {
  Vector2 normal;
  double offset_m;
};

struct Body {
  std::string name;
  double length_m;
  double width_m;
  double margin_m;

  double reach_m() const { return std::hypot(0.5 * length_m, 0.5 * width_m); }

  std::array<Vector2, 4> corners(const Pose& pose) const {
    const Vector2 ahead(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
    const Vector2 x = 0.5 * length_m * ahead;
    const Vector2 y = 0.5 * width_m * Vector2(-ahead.y(), ahead.x());
    const Vector2& p = pose.position;
    return {p + x + y, p + x - y, p - x + y, p - x - y};
  }

  /// How far the body reaches from the base.
  double extent_m(double yaw_rad, const Vector2& direction) const {
    double most_m = 0.0;
    for (const Vector2& corner : corners({{0.0, 0.0}, yaw_rad}))
      most_m = std::max(most_m, direction.dot(corner));
    return most_m;
  }
};

const Wall kBelow{{0.0, -1.0}, 0.0};
const Wall kLeft{{-1.0, 0.0}, 0.0};

double gap_m(const Body& body, const std::vector<Wall>& walls, const Pose& pose) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Vector2& corner : body.corners(pose)) {
    for (const Wall& wall : walls)
      least_m = std::min(least_m, wall.offset_m - wall.normal.dot(corner));
  }
  return least_m;
}

TightPlace beside(const Body& body, const std::vector<Wall>& walls, const Pose& start) {
  const double turning_m = body.reach_m() + body.margin_m;
  TightPlace tight;
  tight.start = start;
  tight.reach_m = body.reach_m();
  tight.margin_m = body.margin_m;
  tight.leaving = Leaving{6.0 * body.reach_m()};
  tight.gap_m = [body, walls](const Pose& pose) { return gap_m(body, walls, pose); };
  tight.is_out = [walls, turning_m](const Pose& pose) {
    return std::all_of(walls.begin(), walls.end(), [&](const Wall& wall) {
      return wall.offset_m - wall.normal.dot(pose.position) >= turning_m;
    });
  };
  tight.exit = start.position.cwiseMax(turning_m);
  return tight;
}

/// The least gap on the way, and what it is at the end.
struct Driven {
  Pose end;
  double least_m = std::numeric_limits<double>::infinity();
  int changes = 0;  // between forward, backward and turns
};

Driven driven(const TightPlace& tight, const std::vector<Stretch>& way) {
  Driven driven{tight.start};
  for (std::size_t k = 0; k < way.size(); ++k) {
    const Pose from = driven.end;
    for (int i = 1; i <= 50; ++i) {
      driven.end = along(from, way[k], i / 50.0);
      driven.least_m = std::min(driven.least_m, tight.gap_m(driven.end));
    }
    driven.changes += k > 0 && way[k].length_m * way[k - 1].length_m <= 0.0 &&
                      way[k].length_m != way[k - 1].length_m;
  }
  return driven;
}

/// Whether a turn is followed by one to the other side.
bool turns_to_and_fro(const std::vector<Stretch>& way) {
  const auto undone = [](const Stretch& before, const Stretch& after) {
    return before.length_m == 0.0 && after.length_m == 0.0 && before.turn_rad * after.turn_rad <= 0;
  };
  return std::adjacent_find(way.begin(), way.end(), undone) != way.end();
}

class TightPlaceTest : public ::testing::TestWithParam<Body> {
 protected:
  /// Every heading leads out, and the body keeps half of the margin, or about the gap it had.
  void expect_way_out(const std::vector<Wall>& walls, double gap) {
    for (int i = 0; i < 24; ++i) {
      const double yaw_rad = i * M_PI / 12;
      Pose start{{0.0, 0.0}, yaw_rad};
      for (const Wall& wall : walls)
        start.position -= (body_.extent_m(yaw_rad, wall.normal) + gap) * wall.normal;
      const TightPlace tight = beside(body_, walls, start);
      if (tight.is_out(start)) continue;
      const std::vector<Stretch> stretches = find_way_out(tight, kMaxExpansions);
      EXPECT_FALSE(turns_to_and_fro(stretches)) << gap << ", " << 15 * i;
      const Driven way = driven(tight, stretches);
      EXPECT_TRUE(tight.is_out(way.end)) << gap << " m, " << 15 * i << " degrees";
      EXPECT_GE(way.least_m,
                std::min(gap - Leaving::kLoss_m - Leaving::kSlack_m, 0.5 * body_.margin_m))
          << gap << ", " << 15 * i;
      EXPECT_LE(way.changes, 8) << gap << ", " << 15 * i;
    }
  }

  const Body body_ = GetParam();
};

TEST_P(TightPlaceTest, LeavesAWallAtEveryHeading) {
  for (const double gap : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3}) expect_way_out({kBelow}, gap);
}

TEST_P(TightPlaceTest, LeavesACornerAtEveryHeading) {
  for (const double gap : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3}) expect_way_out({kBelow, kLeft}, gap);
}

TEST_P(TightPlaceTest, BacksOutOfASlotThatItCannotTurnIn) {
  constexpr double kDepth_m = 1.2;
  const double half_m = 0.5 * body_.width_m + body_.margin_m + 0.03;
  const double exit_m = kDepth_m + body_.reach_m() + body_.margin_m;
  TightPlace tight = beside(body_, {kBelow}, {{0.0, 0.5 * body_.length_m + 0.1}, -0.5 * M_PI});
  tight.gap_m = [&](const Pose& pose) {
    double least_m = gap_m(body_, {kBelow}, pose);
    for (const Vector2& corner : body_.corners(pose)) {
      if (corner.y() < kDepth_m) least_m = std::min(least_m, half_m - std::abs(corner.x()));
    }
    return least_m;
  };
  tight.is_out = [&](const Pose& pose) { return pose.position.y() >= exit_m; };
  tight.exit = {0.0, exit_m};
  const std::vector<Stretch> way = find_way_out(tight, kMaxExpansions);
  ASSERT_FALSE(way.empty());
  const Driven out = driven(tight, way);
  EXPECT_TRUE(tight.is_out(out.end));
  EXPECT_GE(out.least_m, body_.margin_m - 0.0045);
  for (const Stretch& stretch : way) EXPECT_LT(stretch.length_m, 0.0);
}

TEST_P(TightPlaceTest, LeavesAWallForwardWhereItCannotReverse) {
  // Nose away from the wall.
  const double behind_m = body_.extent_m(0.25 * M_PI, kBelow.normal) + 0.02;
  TightPlace tight = beside(body_, {kBelow}, {{0.0, behind_m}, 0.25 * M_PI});
  tight.can_reverse = false;
  const std::vector<Stretch> way = find_way_out(tight, kMaxExpansions);
  ASSERT_FALSE(way.empty());
  for (const Stretch& stretch : way) EXPECT_GE(stretch.length_m, 0.0);
  EXPECT_TRUE(tight.is_out(driven(tight, way).end));
}

TEST_P(TightPlaceTest, StaysInASlotWhereItCannotReverse) {
  // Nose in; there is no room to turn.
  const double half_m = 0.5 * body_.width_m + body_.margin_m + 0.005;
  TightPlace slot = beside(body_, {kBelow, {{1.0, 0.0}, half_m}, {{-1.0, 0.0}, half_m}},
                           {{0.0, 0.5 * body_.length_m + body_.margin_m + 0.005}, -0.5 * M_PI});
  slot.is_out = [](const Pose& pose) { return pose.position.y() > 1.5; };
  slot.exit = {0.0, 1.5};
  EXPECT_FALSE(find_way_out(slot, kMaxExpansions).empty());
  slot.can_reverse = false;
  EXPECT_TRUE(find_way_out(slot, kMaxExpansions).empty());
}

TEST_P(TightPlaceTest, SaysThatThereIsNoWayOutOfABox) {
  const double half_m = 0.5 * body_.length_m + 0.02;
  std::vector<Wall> box;
  for (const Vector2& normal : {Vector2(1, 0), Vector2(-1, 0), Vector2(0, 1), Vector2(0, -1)})
    box.push_back({normal, half_m});
  EXPECT_TRUE(find_way_out(beside(body_, box, {{0.0, 0.0}, 0.0}), kMaxExpansions).empty());
}

INSTANTIATE_TEST_SUITE_P(Bodies, TightPlaceTest,
                         ::testing::Values(Body{"jackal", 0.508, 0.43, 0.03},
                                           Body{"waveshare_rover", 0.271, 0.251, 0.055},
                                           Body{"own", 0.9, 0.6, 0.055}),
                         [](const auto& body) { return body.param.name; });

}  // namespace
}  // namespace mocha
