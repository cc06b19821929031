#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "topology/signatures/signature_sums.h"
#include "topology/space_time/space_time.h"
#include "topology/space_time/timed_path.h"
#include "trajectory/plane_vectors.h"
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

Vector2 position_at(const TimedPath& path, double t) {
  std::size_t next = 1;
  while (next + 1 < path.size() && path[next].time_s <= t) ++next;
  const TimedPoint& p = path[next - 1];
  const TimedPoint& q = path[next];
  return p.position + (t - p.time_s) / (q.time_s - p.time_s) * (q.position - p.position);
}

Vector2 centre_at(const Tube<2>& tube, double t) {
  std::size_t next = 1;
  while (next < tube.size() && tube[next].start_s <= t) ++next;
  return tube[next - 1].centre_at(t);
}

/// How often the path turns about the tube's centre, paper (35). Between the times at which either
/// bends, the relative motion is straight.
double swept_turns(const TimedPath& path, const Tube<2>& tube) {
  std::vector<double> times;
  for (const TimedPoint& point : path) times.push_back(point.time_s);
  for (const TubePiece<2>& piece : tube) times.push_back(piece.start_s);
  std::sort(times.begin(), times.end());
  double swept_rad = 0.0;
  Vector2 last = position_at(path, times.front()) - centre_at(tube, times.front());
  for (const double t : times) {
    const Vector2 relative = position_at(path, t) - centre_at(tube, t);
    swept_rad += angle_between(last, relative);
    last = relative;
  }
  return swept_rad / (2.0 * M_PI);
}

TEST(SpaceTime, SignaturesDifferByTheWindings) {
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
      ASSERT_NEAR(swept_turns(a, all[r]) - swept_turns(b, all[r]), of_a[r] - of_b[r], 1e-9)
          << i << " " << r;
    different += of_a != of_b;
  }
  EXPECT_GT(different, 300);
  EXPECT_LT(different, 2700);
}

}  // namespace
}  // namespace mocha
