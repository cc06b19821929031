#include "fleet/protocol/yield_request.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "world/obstacle.h"

namespace mocha {
namespace {

YieldRequest request() {
  YieldRequest request;
  request.agent = "ugv2";
  request.rank = {false, 1, "ugv1"};
  request.radius_m = 0.3;
  request.speed_mps = 1.0;
  request.path = {{0.0, 0.0}, {5.0, 0.0}};
  return request;
}

void expect_refused(const YieldRequest& bad, const char* why) {
  try {
    validate(bad);
    ADD_FAILURE() << "is taken, though it " << why;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(YieldRequest, BeingStuckGoesBeforeThePriorityAndThatBeforeTheName) {
  const std::vector<Rank> ranks = {{true, 0, "ugv1"},  {true, -5, "ugv3"}, {false, 9, "ugv9"},
                                   {false, 0, "ugv1"}, {false, 0, "ugv2"}, {false, -1, "ugv0"}};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    for (std::size_t k = 0; k < ranks.size(); ++k)
      EXPECT_EQ(outranks(ranks[i], ranks[k]), i < k) << i << " " << k;
  }
}

TEST(YieldRequest, RefusesWhatNoRobotCanHaveMeant) {
  EXPECT_NO_THROW(validate(request()));
  YieldRequest bad = request();
  bad.agent.clear();
  expect_refused(bad, "no name");
  bad = request();
  bad.rank.agent.clear();
  expect_refused(bad, "no name");
  for (const double radius_m : {0.0, -1.0, 11.0, std::nan("")}) {
    bad = request();
    bad.radius_m = radius_m;
    expect_refused(bad, "radius");
  }
  for (const double speed_mps : {0.0, 51.0, std::nan("")}) {
    bad = request();
    bad.speed_mps = speed_mps;
    expect_refused(bad, "speed");
  }
  bad = request();
  bad.path.assign(kMostPathPlaces + 1, Vector2::Zero());
  expect_refused(bad, "places");
  bad = request();
  bad.path.back().y() = std::numeric_limits<double>::infinity();
  expect_refused(bad, "not finite");
}

TEST(YieldRequest, IsSaidInFewPlacesThatKeepItsShape) {
  std::vector<Vector2> spiral;
  for (int i = 0; i < 1000; ++i)
    spiral.emplace_back(0.01 * i * std::cos(0.02 * i), 0.01 * i * std::sin(0.02 * i));
  const std::vector<Vector2> few = said_shortly(spiral);
  ASSERT_LE(few.size(), kMostPathPlaces);
  EXPECT_EQ(few.front(), spiral.front());
  EXPECT_EQ(few.back(), spiral.back());
  double farthest_m = 0.0;
  for (const Vector2& place : spiral) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < few.size(); ++i)
      nearest_m =
          std::min(nearest_m, (place - nearest_on_segment(place, few[i - 1], few[i])).norm());
    farthest_m = std::max(farthest_m, nearest_m);
  }
  EXPECT_LT(farthest_m, 0.2);
  const std::vector<Vector2> straight = {{0.0, 0.0}, {1.0, 0.001}, {2.0, -0.001}, {3.0, 0.0}};
  EXPECT_EQ(said_shortly(straight).size(), 2u);
  EXPECT_TRUE(said_shortly({}).empty());
  EXPECT_EQ(said_shortly({Vector2(1.0, 2.0)}).size(), 1u);
  EXPECT_EQ(said_shortly(std::vector<Vector2>(500, Vector2(1.0, 2.0))).size(), 2u);
}

}  // namespace
}  // namespace mocha
