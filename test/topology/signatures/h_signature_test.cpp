#include "topology/signatures/h_signature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "topology/signatures/signature_sums.h"

namespace mocha {
namespace {

using Eigen::Vector2d;

double cross_of(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Out along the first and back along the second, which share their ends.
template <int D>
Path<D> loop_of(const Path<D>& out, const Path<D>& back) {
  Path<D> loop = out;
  loop.insert(loop.end(), back.rbegin() + 1, back.rend());
  return loop;
}

/// Paper (35) with its turns summed up: an integer for a closed path.
double winding(const Path<2>& path, const Vector2d& about) {
  double angle = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2d a = path[i - 1] - about;
    const Vector2d b = path[i] - about;
    angle += std::atan2(cross_of(a, b), a.dot(b));
  }
  return angle / (2.0 * M_PI);
}

/// The word of signed crossings of one obstacle's ray in a slanting direction, as a sum.
int crossings(const Path<2>& path, const Vector2d& foot) {
  const Vector2d direction(std::cos(0.7391), std::sin(0.7391));
  int sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double before = cross_of(direction, path[i - 1] - foot);
    const double after = cross_of(direction, path[i] - foot);
    if ((before < 0.0) == (after < 0.0)) continue;
    const Vector2d at = path[i - 1] + (path[i] - path[i - 1]) * before / (before - after);
    if (direction.dot(at - foot) > 0.0) sum += before < 0.0 ? 1 : -1;
  }
  return sum;
}

/// Groups of circles in 20 x 20 m, each with a point of its solid matter.
struct PlanarWorld {
  std::vector<Vector2d> centres;
  double radius_m = 0.2;
  std::vector<Vector2d> representatives;

  void add(const Vector2d& centre) {
    centres.push_back(centre);
    representatives.push_back(centre);
  }

  /// Many circles, one obstacle: its middle is free, its representative any of its circles.
  void add_c_shape(const Vector2d& middle, double opening_rad, int representative) {
    for (int i = 0; i < 28; ++i) {
      const double angle = opening_rad + 0.5 + i * (2.0 * M_PI - 1.0) / 27.0;
      centres.push_back(middle + 1.5 * Vector2d(std::cos(angle), std::sin(angle)));
      if (i == representative) representatives.push_back(centres.back());
    }
  }

  bool free(const Vector2d& p, const Vector2d& q) const {
    for (const Vector2d& centre : centres) {
      const Vector2d along = q - p;
      const double length2 = along.squaredNorm();
      const double share =
          length2 > 0.0 ? std::clamp(along.dot(centre - p) / length2, 0.0, 1.0) : 0.0;
      if ((p + share * along - centre).norm() < radius_m) return false;
    }
    return true;
  }
};

/// Corners on a coarse lattice, which the representatives are on too: vertical lines, and corners
/// above, below and beside representatives, are common.
Path<2> random_path(const PlanarWorld& world, const Vector2d& start, const Vector2d& goal,
                    std::mt19937_64& random) {
  Path<2> path = {start};
  const int corners = 2 + static_cast<int>(random() % 8);
  for (int tries = 0; tries < 10000; ++tries) {
    const Vector2d next(static_cast<double>(random() % 41) * 0.5,
                        static_cast<double>(random() % 41) * 0.5);
    const bool last = static_cast<int>(path.size()) > corners;
    if (last && world.free(path.back(), goal)) break;
    if (world.free(path.back(), next)) path.push_back(next);
  }
  path.push_back(goal);
  return world.free(path[path.size() - 2], goal) ? path : Path<2>{};
}

PlanarWorld random_world(const Vector2d& start, const Vector2d& goal, std::mt19937_64& random) {
  PlanarWorld world;
  const auto lattice = [&] {
    return Vector2d(static_cast<double>(4 + random() % 33) * 0.5,
                    static_cast<double>(4 + random() % 33) * 0.5);
  };
  for (int i = 0; i < 5; ++i) world.add(lattice());
  world.add(world.centres[0] + Vector2d(0.0, 2.0));  // shares x with another one
  world.add(start + 0.25 * static_cast<double>(1 + random() % 3) * (goal - start));
  world.add_c_shape(lattice(), uniform(random, 0.0, 2.0 * M_PI), static_cast<int>(random() % 28));
  return world;
}

TEST(PlanarSignature, IsTheWindingOfTheLoopThatTwoPathsForm) {
  std::mt19937_64 random(1);
  int pairs = 0;
  int alike = 0;
  int vertical = 0;
  while (pairs < 1000) {
    const Vector2d start(0.0, static_cast<double>(random() % 41) * 0.5);
    const Vector2d goal(20.0,
                        pairs % 3 == 0 ? start.y() : static_cast<double>(random() % 41) * 0.5);
    const PlanarWorld world = random_world(start, goal, random);
    const Path<2> one = random_path(world, start, goal, random);
    const Path<2> two = random_path(world, start, goal, random);
    if (one.empty() || two.empty()) continue;
    ++pairs;
    for (std::size_t i = 1; i < one.size(); ++i) vertical += one[i].x() == one[i - 1].x();
    const Cuts<2> cuts(world.representatives);
    const Signature first = signature_of(cuts, one);
    const Signature second = signature_of(cuts, two);
    const Path<2> loop = loop_of(one, two);
    for (std::size_t r = 0; r < world.representatives.size(); ++r) {
      const Vector2d foot = world.representatives[r];
      EXPECT_NEAR(first[r] - second[r], winding(loop, foot), 1e-6) << "pair " << pairs;
      EXPECT_EQ(first[r] - second[r], crossings(loop, foot)) << "pair " << pairs;
    }
    alike += first == second;
    EXPECT_EQ(first == second, key_along(cuts, one) == key_along(cuts, two));
  }
  EXPECT_GT(alike, 5);
  EXPECT_GT(vertical, 50);
}

TEST(PlanarSignature, TheRepresentativeOfAWallDoesNotMatter) {
  std::mt19937_64 random(2);
  PlanarWorld world;
  const Vector2d start(0.0, 10.0);
  const Vector2d goal(20.0, 10.0);
  world.add_c_shape({10.0, 10.0}, 0.3, 0);
  std::vector<Cuts<2>> choices;
  for (const Vector2d& centre : world.centres) choices.emplace_back(std::vector<Vector2d>{centre});
  int different = 0;
  for (int i = 0; i < 200; ++i) {
    const Path<2> one = random_path(world, start, goal, random);
    const Path<2> two = random_path(world, start, goal, random);
    if (one.empty() || two.empty()) continue;
    const int apart = signature_of(choices[0], one)[0] - signature_of(choices[0], two)[0];
    different += apart != 0;
    for (const Cuts<2>& cuts : choices) {
      EXPECT_EQ(signature_of(cuts, one)[0] - signature_of(cuts, two)[0], apart);
    }
  }
  EXPECT_GT(different, 30);
}

TEST(PlanarSignature, CountsCounterClockwiseTurns) {
  const Cuts<2> cuts({{0.0, 0.0}});
  const Path<2> round = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}, {1.0, 0.0}};
  EXPECT_EQ(signature_of(cuts, round), Signature{1});
  EXPECT_EQ(signature_of(cuts, Path<2>(round.rbegin(), round.rend())), Signature{-1});
  EXPECT_EQ(signature_of(cuts, loop_of(round, Path<2>(round.rbegin(), round.rend()))),
            Signature{2});
}

TEST(PlanarSignature, APathOfOneOrNoPointCrossesNothing) {
  const Cuts<2> cuts({{0.0, 0.0}, {1.0, 1.0}});
  EXPECT_EQ(signature_of(cuts, Path<2>{}), (Signature{0, 0}));
  EXPECT_EQ(signature_of(cuts, Path<2>{{0.0, 5.0}}), (Signature{0, 0}));
  EXPECT_EQ(signature_of(Cuts<2>({}), Path<2>{{0.0, 5.0}, {1.0, 1.0}}), Signature{});
  EXPECT_EQ(key_of(cuts, Vector2d(0.0, 5.0), Vector2d(0.0, 5.0)), 0u);
}

TEST(PlanarSignature, AddsUpAlongAPathAndTurnsItsSignWithIt) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector2d> feet;
    Path<2> path;
    for (int r = 0; r < 6; ++r) feet.emplace_back(uniform(random, 0, 9), uniform(random, 0, 9));
    for (int k = 0; k < 9; ++k) path.emplace_back(uniform(random, 0, 9), uniform(random, 0, 9));
    path[4].x() = feet[2].x();
    expect_sums(Cuts<2>(feet), path);
  }
}

TEST(PlanarSignature, KeysOfObstaclesDiffer) {
  std::vector<SignatureKey> keys;
  for (int r = 0; r < 2000; ++r) keys.push_back(key_of(r));
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

}  // namespace
}  // namespace mocha
