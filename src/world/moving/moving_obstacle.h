#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trajectory/stop_separation.h"

namespace mocha {

/// A disc whose motion is known or predicted: a peer on its promised motion, or a thing at constant
/// velocity. Map frame.
class MovingObstacle {
 public:
  struct Disc {
    Vector2 centre;
    Vector2 velocity;  ///< [m/s]
    double radius_m;
    double radius_rate;  ///< [m/s]
  };

  virtual ~MovingObstacle() = default;
  virtual Disc at(double t) const = 0;
  /// Upper bounds over all times from t on: on the speed [m/s] of the centre plus the growth of the
  /// radius.
  virtual double max_closing_speed(double t) const = 0;
  /// Upper bound on how far the disc sticks out, at any time between the two, of one that moves and
  /// grows uniformly from at(from_s) to at(until_s) [m].
  virtual double chord_error_m(double from_s, double until_s) const = 0;
  /// From this time on it stands still (infinity if never).
  virtual double rest_time() const = 0;
  /// Holds all that the disc ever covers [m]: the whole plane where nothing less is known.
  virtual Eigen::AlignedBox2d box() const;
  virtual const std::string& name() const = 0;
  /// The motion that it has promised, and how it brakes along it; none where it promises nothing.
  virtual std::optional<BrakableMotion> promised() const { return std::nullopt; }
};

/// Something that moves, and how far the centre of a base has to stay from it.
struct MovingThing {
  std::shared_ptr<const MovingObstacle> obstacle;
  double keep_m;   ///< from the rim of its disc
  double until_s;  ///< absolute time after which it is not counted any more (infinity: for ever)
};

/// A team-mate on its promised motion. Where that may be early or late by `mistimed_s`, its disc is
/// larger by what it may drive in that time.
class PeerObstacle : public MovingObstacle {
 public:
  /// Throws std::invalid_argument without a motion, or for a radius or `mistimed_s` that is
  /// negative or not finite.
  PeerObstacle(std::string name, std::shared_ptr<const Motion> motion, double radius_m,
               const Braking& braking, double mistimed_s = 0.0);
  Disc at(double t) const override;
  double max_closing_speed(double t) const override;
  double chord_error_m(double from_s, double until_s) const override;
  double rest_time() const override;
  Eigen::AlignedBox2d box() const override;
  const std::string& name() const override { return name_; }
  std::optional<BrakableMotion> promised() const override {
    return BrakableMotion{*motion_, braking_};
  }

 private:
  std::string name_;
  std::shared_ptr<const Motion> motion_;
  double radius_m_;
  Braking braking_;
  double max_speed_;
  std::vector<double> max_accelerations_;  // of the motion's phases
};

/// A thing seen at time t0 at constant velocity, its radius growing with the uncertainty of the
/// prediction. It grows for `growth_s` >= 0 only: a planner that looks again long before then
/// need not keep from all that may be unknown later.
class PredictedDisc : public MovingObstacle {
 public:
  /// Throws std::invalid_argument for values that are not finite and for a negative radius or
  /// growth.
  PredictedDisc(std::string name, double t0, const Vector2& centre, const Vector2& velocity,
                double radius_m, double radius_rate,
                double growth_s = std::numeric_limits<double>::infinity());
  Disc at(double t) const override;
  double max_closing_speed(double t) const override;
  double chord_error_m(double from_s, double until_s) const override;
  double rest_time() const override;
  const std::string& name() const override { return name_; }

 private:
  std::string name_;
  double t0_;
  Vector2 centre_;
  Vector2 velocity_;
  double radius_m_;
  double radius_rate_;
  double growth_s_;
};

}  // namespace mocha
