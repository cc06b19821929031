#include "safety/violation.h"

#include <gtest/gtest.h>

#include <limits>

namespace mocha {
namespace {

Violation clearance(double value, double limit) {
  Violation violation;
  violation.term = ViolatedTerm::kClearance;
  violation.time_s = 2.0;
  violation.place = {1.0, -0.5};
  violation.value = value;
  violation.limit = limit;
  return violation;
}

TEST(Violation, SaysWhatWhereAndByHowMuch) {
  EXPECT_EQ(describe(Violation{}), "no violation");
  EXPECT_EQ(describe(clearance(0.05, 0.1)),
            "clearance to obstacles 0.050 m, needs 0.100, at (1.00, -0.50)");
}

TEST(Violation, TellsTheValueFromTheLimit) {
  EXPECT_EQ(describe(clearance(0.00812, 0.00848)),
            "clearance to obstacles 0.0081 m, needs 0.0085, at (1.00, -0.50)");
  EXPECT_EQ(describe(clearance(-0.00050002, -0.00050001)),
            "clearance to obstacles -0.000500 m, needs -0.000500, at "
            "(1.00, -0.50)")
      << "to the micrometre";
}

TEST(Violation, NamesThePeerAndTheJump) {
  Violation near = clearance(0.3, 0.5);
  near.term = ViolatedTerm::kSeparation;
  near.peer = "ugv2";
  EXPECT_EQ(describe(near), "distance to ugv2 0.300 m, needs 0.500, at (1.00, -0.50)");
  Violation jump = clearance(std::numeric_limits<double>::infinity(), 2.0);
  jump.term = ViolatedTerm::kAcceleration;
  EXPECT_EQ(describe(jump).rfind("velocity jumps, acceleration inf m/s^2, limit 2.000", 0), 0u)
      << describe(jump);
}

}  // namespace
}  // namespace mocha
