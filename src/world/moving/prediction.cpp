#include "world/moving/prediction.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

constexpr double kRounding = 1e-6;  // of a filter's arithmetic, relative
constexpr double kNearlySure = 0.9999;
constexpr double kMost = 1000.0;  // of times ahead [s] and of deviations

void require_covariance(const Eigen::Matrix4d& covariance) {
  const double largest = covariance.cwiseAbs().maxCoeff();
  const bool sound =
      covariance.allFinite() &&
      (covariance - covariance.transpose()).cwiseAbs().maxCoeff() <= kRounding * largest &&
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(covariance, Eigen::EigenvaluesOnly)
              .eigenvalues()[0] >= -kRounding * largest;
  if (!sound) {
    throw std::invalid_argument(
        "the covariance is not finite, not symmetric, or not positive semidefinite");
  }
}

/// The largest standard deviation of a planar quantity.
double largest_sigma(const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues()[1]));
}

/// Of a planar normal distribution, the share 1 - confidence is farther away, in deviations.
double normal_deviations(double confidence) { return std::sqrt(-2.0 * std::log1p(-confidence)); }

void require_of_spread(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("the spread of predictions: ") + what);
}

bool ascends(const std::vector<double>& values, double above, double below) {
  double last = above;
  for (const double value : values) {
    if (!(value > last && value < below)) return false;
    last = value;
  }
  return !values.empty();
}

bool is_plausible(const Eigen::MatrixXd& deviations) {
  for (Eigen::Index row = 0; row < deviations.rows(); ++row) {
    double last = 0.0;
    for (const double value : deviations.row(row)) {
      if (!(value >= last && value <= kMost)) return false;
      last = value;
    }
  }
  return true;
}

/// Where a value is among ascending ones: between the `index`-th and the next, or outside.
struct Place {
  Eigen::Index index;
  double share;  ///< of the way to the next
};

Place place_of(double value, const std::vector<double>& ascending) {
  const auto next = std::upper_bound(ascending.begin(), ascending.end(), value);
  if (next == ascending.begin()) return {0, 0.0};
  const auto index = next - ascending.begin() - 1;
  if (next == ascending.end()) return {index, 0.0};
  return {index, (value - ascending[index]) / (*next - ascending[index])};
}

/// Linear in what a normal distribution would say, which is 0 for a confidence of 0.
double with_confidence(const Eigen::RowVectorXd& row, const std::vector<double>& confidences,
                       double confidence) {
  const double normal = normal_deviations(confidence);
  double before = 0.0;
  double value = 0.0;
  for (std::size_t i = 0; i < confidences.size(); ++i) {
    const double here = normal_deviations(confidences[i]);
    if (normal <= here) return value + (normal - before) / (here - before) * (row[i] - value);
    before = here;
    value = row[i];
  }
  return value;
}

double looked_up(const Eigen::MatrixXd& deviations, const PredictionSpread& spread, double ahead_s,
                 double confidence) {
  const auto [index, share] = place_of(ahead_s, spread.ahead_s);
  const double here = with_confidence(deviations.row(index), spread.confidences, confidence);
  if (share == 0.0) return here;
  const double next = with_confidence(deviations.row(index + 1), spread.confidences, confidence);
  return here + share * (next - here);
}

std::shared_ptr<const MovingObstacle> disc_of(const PredictedThing& thing, double time_s,
                                              double now_m, double then_m, double growth_s) {
  const double rate = growth_s > 0.0 ? (then_m - now_m) / growth_s : 0.0;
  return std::make_shared<PredictedDisc>("moving thing " + std::to_string(thing.id), time_s,
                                         thing.place, thing.velocity, thing.radius_m + now_m, rate,
                                         growth_s);
}

}  // namespace

PredictedDeviation PredictedDeviation::of(const Eigen::Matrix4d& covariance) {
  require_covariance(covariance);
  return {largest_sigma(covariance.topLeftCorner<2, 2>()),
          largest_sigma(covariance.bottomRightCorner<2, 2>())};
}

PredictionSpread PredictionSpread::normal() {
  PredictionSpread spread{{1.0}, {0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 0.9999}, {}, {}};
  spread.at.resize(1, static_cast<Eigen::Index>(spread.confidences.size()));
  for (Eigen::Index i = 0; i < spread.at.cols(); ++i)
    spread.at(0, i) = normal_deviations(spread.confidences[i]);
  spread.throughout = spread.at;
  return spread;
}

void PredictionSpread::check() const {
  require_of_spread(ascends(ahead_s, 0.0, kMost),
                    "its times are not ascending between 0 and 1000 s");
  require_of_spread(ascends(confidences, 0.0, 1.0),
                    "its confidences are not ascending between 0 and 1");
  for (const Eigen::MatrixXd& deviations : {at, throughout}) {
    require_of_spread(deviations.rows() == static_cast<Eigen::Index>(ahead_s.size()) &&
                          deviations.cols() == static_cast<Eigen::Index>(confidences.size()),
                      "it has not one value for each time and confidence");
    require_of_spread(is_plausible(deviations),
                      "its deviations are not ascending between 0 and 1000");
  }
}

double PredictionSpread::deviations_at(double ahead, double confidence) const {
  return looked_up(at, *this, ahead, confidence);
}

double PredictionSpread::deviations_throughout(double ahead, double confidence) const {
  return looked_up(throughout, *this, ahead, confidence);
}

RiskOptions RiskOptions::from(const ParameterTable& values, const RobotModel& robot) {
  return {values.number("risk"), values.number("growth_horizon"), robot.moving_clearance_m,
          robot.limits.max_speed, robot.footprint.circumscribed_radius_m()};
}

double confidence_of_each(const Predictions& predictions, const Vector2& place,
                          const RiskOptions& options) {
  const double growth_s = options.growth_s;
  const auto is_in_reach = [&](const PredictedThing& thing) {
    const double most = predictions.spread.deviations_throughout(growth_s, kNearlySure);
    const double reach_m = thing.radius_m + most * thing.deviation.after(growth_s) +
                           options.robot_radius_m + options.clearance_m +
                           growth_s * (options.robot_speed + thing.velocity.norm());
    return (thing.place - place).norm() <= reach_m;
  };
  const auto in_reach =
      std::count_if(predictions.things.begin(), predictions.things.end(), is_in_reach);
  return 1.0 - options.risk / static_cast<double>(std::max<std::ptrdiff_t>(1, in_reach));
}

Discs confident_discs(const Predictions& predictions, double confidence,
                      const RiskOptions& options) {
  const double growth_s = options.growth_s;
  const double deviations = predictions.spread.deviations_throughout(growth_s, confidence);
  Discs discs;
  for (const PredictedThing& thing : predictions.things) {
    const auto beyond_m = [&](double ahead_s) {
      return std::max(0.0, deviations * thing.deviation.after(ahead_s) - options.clearance_m);
    };
    discs.push_back(
        disc_of(thing, predictions.time_s, beyond_m(0.0), beyond_m(growth_s), growth_s));
  }
  return discs;
}

Discs likely_discs(const Predictions& predictions) {
  Discs discs;
  for (const PredictedThing& thing : predictions.things)
    discs.push_back(disc_of(thing, predictions.time_s, 0.0, 0.0, 0.0));
  return discs;
}

}  // namespace mocha
