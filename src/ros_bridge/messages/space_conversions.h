#pragma once

#include <mocha_ugv/MovingBall.h>
#include <mocha_ugv/PlanInSpace.h>
#include <nav_msgs/Path.h>

#include <string>

#include "planning/space/space_plan.h"
#include "world/moving/tube.h"

namespace mocha {

Eigen::Vector3d from_message(const geometry_msgs::Point& point);
geometry_msgs::Point point_message(const Eigen::Vector3d& point);

/// Throws std::invalid_argument, saying why, for what is no ball.
Tube<3> from_message(const mocha_ugv::MovingBall& ball);

/// A curve from rest to rest, which begins at `stamp`.
mocha_ugv::SpaceTrajectory curve_message(const PiecewisePolynomial<3, 3>& curve, double radius_m,
                                         const std::string& frame, ros::Time stamp);

/// The same curve. Throws std::invalid_argument, saying why, for a message that is none.
PiecewisePolynomial<3, 3> from_message(const mocha_ugv::SpaceTrajectory& message);

/// Poses along a curve that begins at `stamp`, `dt` [s] apart, and its end; the heading is that of
/// the motion.
nav_msgs::Path to_path(const PiecewisePolynomial<3, 3>& curve, const std::string& frame,
                       ros::Time stamp, double dt);

/// What was planned for a robot of that radius, to begin at `stamp`.
mocha_ugv::PlanInSpace::Response to_message(const SpacePlan& plan, double radius_m,
                                            const std::string& frame, ros::Time stamp);

}  // namespace mocha
