#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planning/replanner/certified_part.h"
#include "planning/worlds.h"
#include "safety/certifier.h"
#include "trajectory/rover_braking.h"

namespace mocha {

/// One robot that has promised a motion, and what may be driven instead.
class ManeuverTest : public ::testing::Test {
 protected:
  explicit ManeuverTest(const std::string& model = "rover")
      : robot_(load_robot_model("config", model)) {}

  /// As it stands at `now_s`; `committed` and `scene` must live on.
  static constexpr double kAnywhere_m = 1e6;

  ManeuverStart start_of(const Motion& committed, const LocalScene& scene, double now_s,
                         Course course = Course::kConfident) const {
    constexpr double kEmergency_s = 0.1;
    constexpr double kSettle_s = 0.3;
    return {robot_,
            requirements_,
            scene,
            course,
            committed,
            now_s,
            committed.switch_time(now_s + kEmergency_s),
            committed.switch_time(now_s + kSettle_s),
            committed.end_pose().position,
            kAnywhere_m};
  }

  Violation violation_of(const Motion& motion, const LocalScene& scene, RequirementName required,
                         double from_s) const {
    return certify(motion, robot_.footprint, scene, requirements_[required].from(from_s));
  }

  /// The first of the maneuvers of which a part is certified, and that part.
  struct Choice {
    Maneuver maneuver;
    Motion motion;
    std::string words() const { return maneuver.words; }
  };
  static std::optional<Choice> first_certified(const ManeuverStart& start,
                                               const Maneuvers& maneuvers,
                                               RequirementName required) {
    for (const Maneuver& maneuver : maneuvers) {
      if (const auto part = certified_part(start, maneuver, required))
        return Choice{maneuver, part->motion};
    }
    return std::nullopt;
  }

  static std::shared_ptr<const MovingObstacle> person(double t0, const Vector2& centre,
                                                      const Vector2& velocity) {
    constexpr double kPerson_m = 0.25;
    return std::make_shared<PredictedDisc>("person", t0, centre, velocity, kPerson_m, 0.0);
  }
  static std::shared_ptr<const MovingObstacle> peer(const Motion& motion) {
    return std::make_shared<PeerObstacle>("ugv2", std::make_shared<const Motion>(motion), 0.3,
                                          test::kRoverBraking);
  }

  RobotModel robot_;
  const Requirements requirements_{robot_};
};

}  // namespace mocha
