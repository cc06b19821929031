#include "fleet/protocol/committed_trajectory.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

CommittedTrajectory standing_for(double duration_s) {
  return {"ugv1",
          {1, 1},
          TrajectoryState::kProposed,
          0,
          0.3,
          test::kRoverBraking,
          std::make_shared<const Motion>(
              1.7e9, std::vector<Phase>{StandPhase{{Vector2::Zero(), 0.0}, duration_s}})};
}

TEST(CommittedTrajectory, OfMoreThanFiveMinutesIsMeantByNoRobot) {
  EXPECT_NO_THROW(validate(standing_for(299.0)));
  EXPECT_THROW(validate(standing_for(301.0)), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
