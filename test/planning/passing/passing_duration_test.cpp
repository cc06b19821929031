#include "planning/passing/passing_duration.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

PassingOrder into_a_siding_and_on_to(const Vector2& place) {
  return {{{{{0.0, 0.0}, {1.0, 0.0}}, {}}, {{{1.0, 0.0}, place}, {}}}};
}

TEST(PassingDuration, WhoMayDriveBackwardNeedNotTurnWhereTheWayLeadsBack) {
  const PassingPace turns{1.0, 1.0, 1.0, false, 0.0};
  const PassingPace backs{1.0, 1.0, 1.0, true, 0.0};
  const PassingOrder back = into_a_siding_and_on_to({0.0, 0.0});
  EXPECT_NEAR(duration_s(back, backs), 1.1 * 4.0, 1e-9) << "two moves, each from rest";
  EXPECT_NEAR(duration_s(back, turns), 1.1 * (4.0 + M_PI), 1e-9);
  const PassingOrder aside = into_a_siding_and_on_to({1.0, 1.0});
  EXPECT_NEAR(duration_s(aside, backs), duration_s(aside, turns), 1e-9);
  const PassingOrder on = into_a_siding_and_on_to({2.0, 0.0});
  EXPECT_NEAR(duration_s(on, backs), 1.1 * 3.0, 1e-9) << "without a stop";
}

}  // namespace
}  // namespace mocha
