#include "simulation/mover_path.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

void expect_at(const Mover& mover, double elapsed_s, const Vector2& centre,
               const Vector2& velocity) {
  const auto state = mover_state(mover, elapsed_s);
  ASSERT_TRUE(state) << elapsed_s;
  EXPECT_NEAR((state->centre - centre).norm(), 0.0, 1e-9) << elapsed_s;
  EXPECT_NEAR((state->velocity - velocity).norm(), 0.0, 1e-9) << elapsed_s;
}

TEST(MoverPath, StandsAtTheEndOfAPathOrGoesRound) {
  const std::vector<Vector2> corners = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}};
  const Mover once = along_path(0.3, 2.0, false, corners);
  expect_at(once, -1.0, {0.0, 0.0}, {0.0, 0.0});
  expect_at(once, 2.5, {4.0, 1.0}, {0.0, 2.0});
  expect_at(once, 100.0, {4.0, 3.0}, {0.0, 0.0});
  // 12 m round: the last side leads back to the start.
  const Mover round = along_path(0.3, 2.0, true, corners);
  expect_at(round, 4.75, {2.0, 1.5}, {-1.6, -1.2});
  expect_at(round, 62.5, {4.0, 1.0}, {0.0, 2.0});
  const Mover back_and_forth = along_path(0.3, 1.0, true, {{0.0, 0.0}, {2.0, 0.0}});
  expect_at(back_and_forth, 3.0, {1.0, 0.0}, {-1.0, 0.0});
}

TEST(MoverPath, WhatHasNowhereToGoStands) {
  expect_at(along_path(0.3, 1.0, true, {{1.0, 2.0}}), 3.0, {1.0, 2.0}, {0.0, 0.0});
  expect_at(along_path(0.3, 0.0, true, {{1.0, 2.0}, {3.0, 2.0}}), 3.0, {1.0, 2.0}, {0.0, 0.0});
  expect_at(along_path(0.3, 1.0, false, {{1.0, 2.0}, {1.0, 2.0}, {2.0, 2.0}}), 0.5, {1.5, 2.0},
            {1.0, 0.0});
}

TEST(MoverPath, IsThereFromTheFirstKeyframeToTheLast) {
  const Mover passer{
      0.25, {{1.0, {0.0, 0.0}}, {3.0, {4.0, 0.0}}, {3.5, {4.0, 1.0}}}, AfterLast::kLeaves};
  EXPECT_FALSE(mover_state(passer, 0.999));
  expect_at(passer, 1.0, {0.0, 0.0}, {2.0, 0.0});
  expect_at(passer, 2.5, {3.0, 0.0}, {2.0, 0.0});
  expect_at(passer, 3.25, {4.0, 0.5}, {0.0, 2.0});
  expect_at(passer, 3.5, {4.0, 1.0}, {0.0, 0.0});
  EXPECT_FALSE(mover_state(passer, 3.501));
}

TEST(MoverPath, BeginsAnewAfterTheLastKeyframe) {
  const Mover again{0.5, {{1.0, {0.0, 0.0}}, {3.0, {4.0, 0.0}}}, AfterLast::kRepeats};
  EXPECT_FALSE(mover_state(again, 0.5));
  expect_at(again, 2.0, {2.0, 0.0}, {2.0, 0.0});
  expect_at(again, 4.0, {2.0, 0.0}, {2.0, 0.0});
  expect_at(again, 20.25, {2.5, 0.0}, {2.0, 0.0});
}

}  // namespace
}  // namespace mocha
