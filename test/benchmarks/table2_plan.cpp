#include "benchmarks/table2_plan.h"

#include "safety/curve_certificate.h"
#include "trajectory/arc_length.h"
#include "trajectory/extrema.h"

namespace mocha {

PrimitiveField<2> obstacle_field(const Table2World& world) {
  constexpr double kReach_m = 2.0;
  return PrimitiveField<2>({world.circles.begin(), world.circles.end()}, kReach_m);
}

Table2Measures measure(const PlanarPath& curve, const Table2World& world) {
  using Robot = Table2Robot;
  Table2Measures measures;
  measures.length_m = arc_length(curve);
  measures.duration_s = curve.duration();
  measures.top_speed = max_speed(curve).value;
  measures.mean_speed = measures.length_m / measures.duration_s;
  measures.kinematic_s =
      measures.length_m / Robot::kMaxSpeed + Robot::kMaxSpeed / Robot::kMaxAcceleration;
  const CurveCertificate<2, 3> certificate(curve);
  measures.feasible = !certificate.check_limits(Robot::kMaxSpeed, Robot::kMaxAcceleration) &&
                      !certificate.check_clearance(Robot::kRadius_m, obstacle_field(world), 0.0);
  return measures;
}

}  // namespace mocha
