#pragma once

#include <optional>
#include <string>

#include "config/parameter_table.h"
#include "world/goal.h"

namespace mocha {

/// When a robot gives up what it is about and drives to where it is charged.
///
/// The battery is low once its voltage has been below a threshold for a while, as it sags when the
/// robot sets off; and is so until it has been charged as long. The goals at hand are given up, not
/// kept: their sender learns of it at once, and the robot does not set off by itself when it comes
/// off its charger hours later.
class LowBattery {
 public:
  struct Options {
    std::optional<Goal> goal;  ///< where to charge; nothing: the battery is not heeded
    double low_v;              ///< below, it is low
    double charged_v;          ///< from here on it is no longer
    double delay_s;            ///< either way

    /// Of config/global_planner.yaml, and `low_v` of base_driver. Throws ParameterError for a goal
    /// that is none and a battery that is charged below where it is low.
    static Options from(const ParameterTable& values, double low_v);
  };

  enum class News {
    kNone,
    kLow,      ///< all goals are given up
    kGo,       ///< the goal is to be taken
    kCharged,  ///< goals are taken again
  };

  explicit LowBattery(const Options& options) : options_(options) {}

  /// A voltage that was measured; what is not finite says nothing.
  void hear(double now_s, double voltage);

  /// What is to be done now. `idle`: the robot has no goal; where it did not arrive it is told to
  /// go again after half a minute. `stopped` for an emergency it stays, afterwards too, until it is
  /// told to go on.
  News step(double now_s, bool idle, bool stopped);
  void arrive() { arrived_ = true; }
  void go_on() { stays_ = false; }

  bool low() const { return low_; }
  /// Why no goal is taken, with values; empty where one is.
  std::string reason() const;
  /// Where it drives; only where News::kGo came.
  const Goal& goal() const { return *options_.goal; }

 private:
  Options options_;
  double voltage_ = 0.0;
  std::optional<double> since_s_;  // the voltage has been on the other side
  bool low_ = false;
  bool told_ = false;  // that it is low
  std::optional<double> sent_s_;
  bool arrived_ = false;
  bool stays_ = false;
};

}  // namespace mocha
