#include "topology/space_time/winding.h"

#include <gtest/gtest.h>

#include "topology/signatures/signature_sums.h"
#include "topology/space_time/space_time.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

constexpr double kSpan_s = 5.0;
constexpr double kMaxSpeed = 50.0;  // whatever is drawn can be driven

/// Anywhere in between.
TimedPath random_path(std::mt19937_64& random, int corners) {
  std::vector<double> times;
  for (int i = 0; i < corners; ++i) times.push_back(uniform(random, 0.1, kSpan_s - 0.1));
  std::sort(times.begin(), times.end());
  TimedPath path = {{{-2.0, 0.1}, 0.0}};
  for (const double t : times)
    path.push_back({{uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0)}, t});
  path.push_back({{2.0, -0.2}, kSpan_s});
  return path;
}

Tube<2> random_tube(std::mt19937_64& random, int pieces) {
  Tube<2> tube;
  Vector2 centre(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0));
  for (int i = 0; i < pieces; ++i) {
    const double start_s = kSpan_s * i / pieces;
    const double end_s = kSpan_s * (i + 1) / pieces;
    const Vector2 velocity(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0));
    tube.push_back({start_s, end_s, centre, velocity, 1e-3, 0.0});
    centre = tube.back().centre_at(end_s);
  }
  return tube;
}

TEST(Winding, IsTheDifferenceOfSignatures) {
  const PrimitiveField<2> field({}, 1.0);
  const Cuts<2> cuts({Vector2(0.3, 0.2)});  // and one that stands
  const Tube<2> standing = {{0.0, kSpan_s, {0.3, 0.2}, {0.0, 0.0}, 0.0, 0.0}};
  const Eigen::AlignedBox2d bounds(Vector2(-9.0, -9.0), Vector2(9.0, 9.0));
  std::mt19937_64 random(1);
  int different = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Tube<2>> tubes = {random_tube(random, 1), random_tube(random, 1 + i % 5)};
    const SpaceTime<2> space(field, cuts, bounds, {{-2.0, 0.1}, {2.0, -0.2}, 0.0, kSpan_s},
                             kMaxSpeed, tubes, {0.0, 0.0});
    const TimedPath a = random_path(random, i % 6);
    const TimedPath b = random_path(random, i % 5);
    const auto signature = [&](const TimedPath& path) {
      std::vector<Eigen::Vector3d> points;
      for (const TimedPoint& p : path) points.push_back(space.point(p.position, p.time_s));
      const Signature whole = space.signature_of(points);
      SignatureKey key = 0;
      for (std::size_t k = 1; k < points.size(); ++k) key += space.key(points[k - 1], points[k]);
      EXPECT_EQ(key, sum_of_keys(whole));
      return whole;
    };
    const Signature of_a = signature(a);
    const Signature of_b = signature(b);
    ASSERT_EQ(of_a.size(), 3u);
    const std::vector<Tube<2>> all = {standing, tubes[0], tubes[1]};
    for (std::size_t r = 0; r < all.size(); ++r)
      ASSERT_NEAR(winding_difference(a, b, all[r]), of_a[r] - of_b[r], 1e-9) << i << " " << r;
    EXPECT_EQ(same_class(a, b, all), of_a == of_b);
    different += of_a != of_b;
  }
  EXPECT_GT(different, 300);
  EXPECT_LT(different, 2700);
}

TEST(Winding, ToleratesEndsThatDisagree) {
  const Tube<2> crossing = {{0.0, 9.0, {0.0, -2.5}, {0.0, 1.0}, 0.5, 0.0}};
  const TimedPath before = {{{-2.5, 0.0}, 0.0}, {{0.8, 0.0}, 2.2}, {{2.5, 0.0}, 5.0}};
  const TimedPath behind = {{{-2.5, 0.0}, 0.0}, {{-0.8, 0.0}, 2.8}, {{2.5, 0.0}, 5.0}};
  const TimedPath driven = {
      {{-3.5, 0.3}, -1.0}, {{-2.4, 0.1}, 0.1}, {{-0.9, 0.2}, 2.7}, {{2.0, -0.4}, 4.4}};
  EXPECT_TRUE(same_class(driven, behind, {crossing}));
  EXPECT_FALSE(same_class(driven, before, {crossing}));
  EXPECT_LT(std::abs(winding_difference(driven, behind, crossing)), 0.2);
  EXPECT_GT(std::abs(winding_difference(driven, before, crossing)), 0.8);
  EXPECT_TRUE(same_class(driven, before, {}));
}

TEST(Winding, IsZeroWithoutACommonTime) {
  const Tube<2> tube = {{0.0, 9.0, {0.0, -2.5}, {0.0, 1.0}, 0.5, 0.0}};
  const TimedPath path = {{{-2.5, 0.0}, 0.0}, {{2.5, 0.0}, 5.0}};
  const TimedPath later = {{{-2.5, 0.0}, 5.0}, {{2.5, 0.0}, 9.0}};
  EXPECT_EQ(winding_difference(path, later, tube), 0.0);
  EXPECT_EQ(winding_difference(path, {}, tube), 0.0);
  EXPECT_EQ(winding_difference(path, path, {}), 0.0);
}

}  // namespace
}  // namespace mocha
