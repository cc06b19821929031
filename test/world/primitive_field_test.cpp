#include "world/primitive_field.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <limits>
#include <random>

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Random {
 public:
  explicit Random(int seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  template <int D>
  Eigen::Matrix<double, D, 1> place(double low, double high) {
    Eigen::Matrix<double, D, 1> p;
    for (double& value : p) value = between(low, high);
    return p;
  }

 private:
  std::mt19937 engine_;
};

/// A star with a corner every 360 / corners degrees: simple, and mostly not convex.
Polygon random_star(Random& random, const Vector2& centre, int corners) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    polygon.corners.push_back(centre +
                              random.between(0.4, 2.5) * Vector2(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

template <int D>
std::vector<typename PrimitiveField<D>::Primitive> random_primitives(int seed, int count);

template <>
std::vector<Obstacle> random_primitives<2>(int seed, int count) {
  Random random(seed);
  std::vector<Obstacle> obstacles;
  for (int i = 0; i < count; ++i) {
    const Vector2 centre = random.place<2>(0.0, 40.0);
    if (i % 3 == 0) {
      obstacles.push_back(random_star(random, centre, 3 + i % 6));
    } else {
      obstacles.push_back(Circle{centre, random.between(0.0, 2.0)});
    }
  }
  return obstacles;
}

template <>
std::vector<Cylinder> random_primitives<3>(int seed, int count) {
  Random random(seed);
  std::vector<Cylinder> cylinders;
  for (int i = 0; i < count; ++i) {
    Cylinder cylinder{random.place<2>(0.0, 40.0), random.between(0.0, 2.0)};
    if (i % 2 == 0) cylinder.from_z_m = random.between(0.0, 5.0);
    if (i % 3 == 0) cylinder.to_z_m = random.between(5.0, 20.0);
    cylinders.push_back(cylinder);
  }
  return cylinders;
}

double distance(const Obstacle& obstacle, const Vector2& p) {
  return std::visit([&](const auto& shape) { return gap(p, shape).distance_m; }, obstacle);
}

double distance(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  const double beside = (p.head<2>() - cylinder.centre).norm() - cylinder.radius_m;
  const double beyond = std::max(cylinder.from_z_m - p.z(), p.z() - cylinder.to_z_m);
  return std::min(0.0, std::max(beside, beyond)) +
         std::hypot(std::max(0.0, beside), std::max(0.0, beyond));
}

/// Distances of all primitives from p, ascending.
template <int D>
std::vector<double> brute_force(const PrimitiveField<D>& field,
                                const typename PrimitiveField<D>::Vector& p) {
  std::vector<double> distances;
  for (const auto& primitive : field.primitives()) distances.push_back(distance(primitive, p));
  std::sort(distances.begin(), distances.end());
  return distances;
}

template <int D>
std::vector<double> visited(const PrimitiveField<D>& field,
                            const typename PrimitiveField<D>::Vector& p, double radius_m) {
  std::vector<double> distances;
  field.visit_near(p, radius_m, [&](const auto& near) {
    distances.push_back(near.distance_m);
    EXPECT_NEAR(near.gradient.norm(), 1.0, 1e-9);
  });
  std::sort(distances.begin(), distances.end());
  return distances;
}

template <int D>
void expect_brute_force(const PrimitiveField<D>& field,
                        const typename PrimitiveField<D>::Vector& p) {
  const std::vector<double> expected = brute_force(field, p);
  EXPECT_NEAR(field.sample(p).distance_m, expected.front(), 1e-9);
  EXPECT_NEAR(field.distance_bound(p), std::max(0.0, expected.front()), 1e-9);
  for (const double radius : {0.0, 0.7, 2.0, 5.0, 60.0}) {
    const std::vector<double> found = visited(field, p, radius);
    ASSERT_EQ(found.size(),
              std::lower_bound(expected.begin(), expected.end(), radius) - expected.begin())
        << p.transpose() << " radius " << radius;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9);
  }
}

template <typename Dimension>
class PrimitiveFields : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PrimitiveFields, Dimensions);

TYPED_TEST(PrimitiveFields, AgreeWithBruteForceEverywhere) {
  constexpr int D = TypeParam::value;
  for (int seed = 0; seed < 12; ++seed) {
    const int count = seed < 4 ? seed + 1 : 20 * seed;
    const PrimitiveField<D> field(random_primitives<D>(seed, count), 0.3 + 0.4 * seed);
    Random random(seed + 100);
    for (int i = 0; i < 300; ++i) expect_brute_force<D>(field, random.place<D>(-10.0, 50.0));
    for (int i = 0; i < 20; ++i) expect_brute_force<D>(field, random.place<D>(-1e4, 1e4));
  }
}

TYPED_TEST(PrimitiveFields, GradientsAreThoseOfTheDistance) {
  constexpr int D = TypeParam::value;
  constexpr double kStep_m = 1e-6;
  const PrimitiveField<D> field(random_primitives<D>(5, 80), 2.0);
  Random random(6);
  int smooth = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto p = random.place<D>(-5.0, 45.0);
    const auto found = field.sample(p);
    ASSERT_NEAR(found.gradient.norm(), 1.0, 1e-9);
    typename PrimitiveField<D>::Vector slope;
    bool kink = false;
    for (int axis = 0; axis < D; ++axis) {
      const auto step = (kStep_m * PrimitiveField<D>::Vector::Unit(axis)).eval();
      const double ahead = field.sample(p + step).distance_m - found.distance_m;
      const double behind = found.distance_m - field.sample(p - step).distance_m;
      kink = kink || std::abs(ahead - behind) > 1e-3 * kStep_m;
      slope[axis] = (ahead + behind) / (2.0 * kStep_m);
    }
    if (kink) continue;  // halfway between two surfaces
    ++smooth;
    EXPECT_LT((slope - found.gradient).norm(), 1e-5) << p.transpose();
  }
  EXPECT_GT(smooth, 1950);
}

TYPED_TEST(PrimitiveFields, ABoxIsClearWhereAllItsPointsAre) {
  constexpr int D = TypeParam::value;
  constexpr double kSpacing_m = 0.1;
  const PrimitiveField<D> field(random_primitives<D>(7, 60), 1.5);
  Random random(8);
  int clear = 0;
  for (int i = 0; i < 400; ++i) {
    const auto corner = random.place<D>(-5.0, 45.0);
    const auto size = random.place<D>(0.0, D == 2 ? 3.0 : 1.2);
    typename PrimitiveField<D>::Box box(corner, (corner + size).eval());
    double least = kInfinity;
    Eigen::Array<int, D, 1> steps = (size.array() / kSpacing_m).ceil().template cast<int>();
    const int points = (steps + 1).prod();
    for (int k = 0; k < points; ++k) {
      typename PrimitiveField<D>::Vector p = corner;
      for (int axis = 0, rest = k; axis < D; rest /= steps[axis++] + 1) {
        p[axis] += size[axis] * (rest % (steps[axis] + 1)) / std::max(1, steps[axis]);
      }
      least = std::min(least, field.sample(p).distance_m);
    }
    // No point of the box is farther than half a diagonal of the raster from one of its points.
    const double between_m = 0.5 * std::sqrt(D) * kSpacing_m;
    for (const double radius : {least - between_m - 0.001, least - 2.0, least + 0.001, 4.0}) {
      if (radius < 0.0) continue;
      const bool said = field.clear(box, radius);
      clear += said;
      if (least < radius) {
        EXPECT_FALSE(said) << corner.transpose();
      }
      if (least > radius + between_m) {
        EXPECT_TRUE(said) << corner.transpose();
      }
    }
  }
  EXPECT_GT(clear, 200);
}

TYPED_TEST(PrimitiveFields, NothingIsNearWithinTheRoom) {
  constexpr int D = TypeParam::value;
  const PrimitiveField<D> field(random_primitives<D>(9, 60), 1.5);
  Random random(10);
  int roomy = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto p = random.place<D>(-5.0, 45.0);
    const auto direction = random.place<D>(-1.0, 1.0).normalized().eval();
    for (const double radius : {0.5, 1.5, 10.0}) {
      const double room_m = field.room(p, radius);
      EXPECT_GE(room_m, 0.0);
      if (!visited<D>(field, p, radius).empty()) {
        EXPECT_EQ(room_m, 0.0);
      }
      if (room_m == 0.0) continue;
      ++roomy;
      EXPECT_TRUE(visited<D>(field, p + 0.999 * room_m * direction, radius).empty());
    }
  }
  EXPECT_GT(roomy, 1000);
}

TEST(PrimitiveField, ABoxThatAPolygonCrossesIsNotClear) {
  const Polygon needle{{{-10.0, 0.0}, {10.0, 0.001}, {-10.0, 0.002}}};
  const Polygon block{{{3.0, 3.0}, {9.0, 3.0}, {9.0, 9.0}, {3.0, 9.0}}};
  const PrimitiveField<2> field({needle, block}, 1.0);
  EXPECT_FALSE(field.clear({Vector2(1.0, -1.0), Vector2(2.0, 1.5)}, 0.0));
  EXPECT_FALSE(field.clear({Vector2(5.0, 5.0), Vector2(6.0, 6.0)}, 0.0));  // wholly inside
  EXPECT_FALSE(field.clear({Vector2(-50.0, -50.0), Vector2(50.0, 50.0)}, 0.0));
  EXPECT_TRUE(field.clear({Vector2(1.0, 0.5), Vector2(2.0, 1.5)}, 0.49));
  EXPECT_FALSE(field.clear({Vector2(1.0, 0.5), Vector2(2.0, 1.5)}, 0.51));
}

TEST(PrimitiveField, GradientsAreUnitVectorsOnRimsCentresAndAxes) {
  const PrimitiveField<2> plane({Circle{{1.0, 2.0}, 0.5}, Circle{{5.0, 2.0}, 0.0},
                                 Polygon{{{8.0, 0.0}, {10.0, 0.0}, {10.0, 2.0}, {8.0, 2.0}}}},
                                1.0);
  for (const Vector2& p : {Vector2(1.0, 2.0), Vector2(1.5, 2.0), Vector2(5.0, 2.0),
                           Vector2(9.0, 1.0), Vector2(8.0, 0.0), Vector2(10.0, 2.0)}) {
    EXPECT_NEAR(plane.sample(p).gradient.norm(), 1.0, 1e-12) << p.transpose();
  }
  for (const double off : {0.0, 1e-15, 1e-11, -1e-11, 1e-7, -1e-7}) {
    EXPECT_LT((plane.sample({9.0, -off}).gradient - Vector2(0.0, -1.0)).norm(), 1e-6) << off;
  }
  const PrimitiveField<3> space({Cylinder{{1.0, 2.0}, 0.5, 0.0, 3.0}}, 1.0);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(1.0, 2.0, 1.5), Eigen::Vector3d(1.0, 2.0, 9.0),
                                   Eigen::Vector3d(1.5, 2.0, 3.0), Eigen::Vector3d(1, 2, 0.5)}) {
    EXPECT_NEAR(space.sample(p).gradient.norm(), 1.0, 1e-12) << p.transpose();
  }
  EXPECT_EQ(space.sample({1.0, 2.0, 9.0}).distance_m, 6.0);
  EXPECT_EQ(space.sample({1.0, 2.0, 1.5}).distance_m, -0.5);
}

TYPED_TEST(PrimitiveFields, NothingIsInfinitelyFarAway) {
  constexpr int D = TypeParam::value;
  using Vector = typename PrimitiveField<D>::Vector;
  const PrimitiveField<D> empty({}, 1.0);
  const Vector p = Vector::Constant(3.0);
  EXPECT_EQ(empty.sample(p).distance_m, kInfinity);
  EXPECT_EQ(empty.sample(p).gradient, Vector::Zero().eval());
  EXPECT_EQ(empty.distance_bound(p), kInfinity);
  EXPECT_TRUE(visited<D>(empty, p, 1e9).empty());
  EXPECT_TRUE(empty.clear({Vector::Zero().eval(), p}, 1e9));
  const PrimitiveField<D> field(random_primitives<D>(1, 5), 1.0);
  const auto far = field.sample(Vector::Constant(1e200));
  EXPECT_GT(far.distance_m, 1e100);
  EXPECT_TRUE(far.gradient.allFinite());
}

TYPED_TEST(PrimitiveFields, WhatIsNotFiniteIsNowhere) {
  constexpr int D = TypeParam::value;
  using Vector = typename PrimitiveField<D>::Vector;
  const PrimitiveField<D> field(random_primitives<D>(1, 5), 1.0);
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    Vector p = Vector::Ones();
    p[D - 1] = value;
    EXPECT_TRUE(std::isnan(field.sample(p).distance_m));
    EXPECT_EQ(field.distance_bound(p), 0.0);
  }
  int visits = 0;
  field.visit_near(Vector::Constant(kNan), 1.0, [&](const auto& near) {
    ++visits;
    EXPECT_TRUE(std::isnan(near.distance_m));
  });
  EXPECT_EQ(visits, 1);
  EXPECT_FALSE(field.clear({Vector::Constant(kNan).eval(), Vector::Constant(kNan).eval()}, 1.0));
}

TEST(PrimitiveField, TakesWhateverIsHugeOrInOnePlace) {
  std::vector<Obstacle> heap(3000, Circle{{1.0, 1.0}, 50.0});
  heap.push_back(Circle{{-1e9, 3.0}, 1.0});
  heap.push_back(Circle{{1e9, 1e9}, 1.0});
  const PrimitiveField<2> field(heap, 1e-6);
  expect_brute_force<2>(field, {0.0, 0.0});
  expect_brute_force<2>(field, {1e9, 1e9 - 3.0});
  const PrimitiveField<2> wide({Circle{{0.0, 0.0}, 0.0}}, 1e6);
  expect_brute_force<2>(wide, {3.0, 4.0});
  const PrimitiveField<3> columns({Cylinder{{0.0, 0.0}, 1e12}, Cylinder{{1e12, 5.0}, 1.0}}, 1.0);
  EXPECT_LT(columns.sample({3.0, 4.0, 5.0}).distance_m, -1e11);
}

TEST(PrimitiveField, MemoryIsBoundedWhereEverythingIsNearEverything) {
  const std::vector<Obstacle> heap(3000, Circle{{1.0, 1.0}, 50.0});
  const auto allocated = [] { return mallinfo2().uordblks + mallinfo2().hblkhd; };
  const std::size_t before = allocated();
  const PrimitiveField<2> field(heap, 1e-9);
  EXPECT_LT(allocated() - before, 10u << 20);
  expect_brute_force<2>(field, {51.5, 1.0});
}

TEST(PrimitiveField, RefusesWhatIsNoShape) {
  const auto refuses = [](const auto& primitive, double reach_m = 1.0) {
    using Primitive = std::decay_t<decltype(primitive)>;
    constexpr int D = std::is_same_v<Primitive, Cylinder> ? 3 : 2;
    try {
      PrimitiveField<D>({primitive}, reach_m);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).size() > 10;
    }
    return false;
  };
  EXPECT_TRUE(refuses(Circle{{0.0, 0.0}, -0.1}));
  EXPECT_TRUE(refuses(Circle{{0.0, 0.0}, kNan}));
  EXPECT_TRUE(refuses(Circle{{0.0, 0.0}, kInfinity}));
  EXPECT_TRUE(refuses(Circle{{0.0, kNan}, 1.0}));
  EXPECT_TRUE(refuses(Circle{{1e13, 0.0}, 1.0}));
  EXPECT_TRUE(refuses(Polygon{{{0.0, 0.0}, {1.0, 0.0}}}));
  EXPECT_TRUE(refuses(Polygon{{{0.0, 0.0}, {1.0, 0.0}, {kInfinity, 1.0}}}));
  EXPECT_TRUE(refuses(Cylinder{{0.0, 0.0}, -1.0}));
  EXPECT_TRUE(refuses(Cylinder{{0.0, 0.0}, 1.0, 2.0, 1.0}));
  EXPECT_TRUE(refuses(Cylinder{{0.0, 0.0}, 1.0, kNan, 1.0}));
  EXPECT_TRUE(refuses(Cylinder{{0.0, 0.0}, 1.0, 0.0, kNan}));
  EXPECT_TRUE(refuses(Cylinder{{0.0, 0.0}, 1.0, kInfinity, kInfinity}));
  for (const double reach : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_TRUE(refuses(Circle{{0.0, 0.0}, 1.0}, reach));
  }
  EXPECT_FALSE(refuses(Circle{{0.0, 0.0}, 0.0}));
  EXPECT_FALSE(refuses(Cylinder{{0.0, 0.0}, 0.0, 1.0, 1.0}));
}

}  // namespace
}  // namespace mocha
