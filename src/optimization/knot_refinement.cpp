#include "optimization/knot_refinement.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace mocha {
namespace {

// The effort of a unit step of one knot, where all others, a unit of time apart, stay and the
// derivatives follow (S = 3, by minco.h), grows with the inverse fifth power of that time. Its
// second derivative is twice that.
constexpr double kUnitEffort = 103.87;
constexpr double kShortest = 0.2;  // of the mean piece: shorter halves are not made
constexpr double kLongest = 3.0;   // of the mean piece: longer ones are not made by removal
constexpr double kStill_m = 0.02;  // by which a curve may move where an idle knot leaves it

double stiffness(double effort_weight, double spacing_s) {
  return 2.0 * kUnitEffort * effort_weight / std::pow(spacing_s, 5);
}

/// The knots of a refined chain, one by one.
template <int D>
class ChainBuilder {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  explicit ChainBuilder(const TrialKnots<D>& trial) : trial_(trial) {}

  void add_piece(double duration_s, bool halved, int i) {
    if (halved) {
      durations_s_.push_back(0.5 * duration_s);
      chain_.knots.push_back(new_knot(i));
    }
    durations_s_.push_back(halved ? 0.5 * duration_s : duration_s);
  }
  void add_knot(const RayKnot<D>& knot) { chain_.knots.push_back(knot); }
  void prolong(double duration_s) { durations_s_.back() += duration_s; }

  KnotChain<D> take() {
    chain_.durations_s = Eigen::Map<Eigen::VectorXd>(
        durations_s_.data(), static_cast<Eigen::Index>(durations_s_.size()));
    return std::move(chain_);
  }

 private:
  RayKnot<D> new_knot(int i) const {
    const Vector along = trial_.curve.derivative({i, 0.5}, 1).normalized();
    const Vector gradient = trial_.by_middle.col(i);
    const Vector across = gradient - gradient.dot(along) * along;
    const bool has_direction = across.norm() > 1e-9 * (1.0 + gradient.norm());
    return RayKnot<D>::on_ray(trial_.middles.col(i),
                              has_direction ? across : Vector(along.unitOrthogonal()));
  }

  const TrialKnots<D>& trial_;
  KnotChain<D> chain_;
  std::vector<double> durations_s_;
};

/// A knot in piece `index`, or a variable for knot `index`.
struct Addition {
  double gain;
  bool is_knot;
  int index;
};

/// The most worthwhile additions; what is left out is worth less than `negligible`.
template <int D>
std::vector<Addition> choose_additions(const KnotChain<D>& chain, const TrialKnots<D>& trial,
                                       double negligible) {
  std::vector<Addition> additions;
  double left_out = 0.0;
  const double shortest_s = 2.0 * kShortest * chain.durations_s.mean();
  for (int i = 0; i < chain.pieces(); ++i) {
    if (chain.durations_s[i] < shortest_s) continue;
    additions.push_back({trial.knot_gains[i], true, i});
    left_out += trial.knot_gains[i];
  }
  for (int k = 0; k + 1 < chain.pieces(); ++k) {
    additions.push_back({trial.axis_gains[k], false, k});
    left_out += trial.axis_gains[k];
  }
  std::sort(additions.begin(), additions.end(),
            [](const Addition& a, const Addition& b) { return a.gain > b.gain; });
  std::size_t taken = 0;
  for (; taken < additions.size() && left_out > negligible; ++taken)
    left_out -= additions[taken].gain;
  additions.resize(taken);
  return additions;
}

/// Is knot k away from penalties, and would the curve hardly move without it? By the jump of its
/// last derivative: the force with which the knot holds it.
template <int D>
bool is_idle(const KnotChain<D>& chain, const TrialKnots<D>& trial, int k) {
  constexpr int kLast = 5;
  if (!trial.is_free[k] || !trial.is_free[k + 1]) return false;
  const Eigen::Matrix<double, D, 1> jump =
      trial.curve.derivative({k + 1, 0.0}, kLast) - trial.curve.derivative({k, 1.0}, kLast);
  const double spacing_s = 0.5 * (chain.durations_s[k] + chain.durations_s[k + 1]);
  return 2.0 * jump.norm() / stiffness(1.0, spacing_s) < kStill_m;
}

}  // namespace

template <int D>
TrialKnots<D> try_knots(TrajectoryObjective<D, 3>& objective, const KnotChain<D>& chain,
                        const typename Minco<D, 3>::Curve& curve,
                        const std::vector<double>& penalties) {
  const int pieces = chain.pieces();
  TrialKnots<D> trial;
  trial.curve = curve;
  trial.middles.resize(D, pieces);
  trial.by_middle.resize(D, pieces);
  trial.by_knot.resize(D, pieces - 1);
  typename TrialKnots<D>::Points points(D, 2 * pieces - 1);
  Eigen::VectorXd durations_s(2 * pieces);
  for (int i = 0; i < pieces; ++i) {
    trial.middles.col(i) = points.col(2 * i) = curve.derivative({i, 0.5}, 0);
    if (i + 1 < pieces) points.col(2 * i + 1) = chain.knots[i].position();
    durations_s.template segment<2>(2 * i).setConstant(0.5 * chain.durations_s[i]);
  }
  objective.set_knot_map(std::make_shared<WaypointMap<D>>(points));
  Eigen::VectorXd gradient(objective.variables());
  trial.cost = objective.evaluate(objective.initial(durations_s), gradient);
  for (int i = 0; i < pieces; ++i) {
    trial.by_middle.col(i) = gradient.template segment<D>(2 * i * D);
    const double finer = objective.penalty(2 * i) + objective.penalty(2 * i + 1);
    const double stiff = stiffness(objective.effort_weight(), 0.5 * chain.durations_s[i]);
    trial.is_free.push_back(finer == 0.0 && penalties[i] == 0.0);
    trial.knot_gains.push_back(trial.by_middle.col(i).squaredNorm() / (2.0 * stiff) +
                               std::abs(finer - penalties[i]));
    if (i + 1 == pieces) break;
    trial.by_knot.col(i) = gradient.template segment<D>((2 * i + 1) * D);
    const double spacing_s = 0.5 * (chain.durations_s[i] + chain.durations_s[i + 1]);
    trial.axis_gains.push_back(chain.knots[i].across(trial.by_knot.col(i)).squaredNorm() /
                               (2.0 * stiffness(objective.effort_weight(), spacing_s)));
  }
  return trial;
}

template <int D>
bool refine(KnotChain<D>& chain, const TrialKnots<D>& trial, double share) {
  const int pieces = chain.pieces();
  std::vector<bool> halved(pieces, false);
  std::vector<bool> promoted(pieces, false);
  const auto additions = choose_additions(chain, trial, share * trial.cost);
  for (const Addition& addition : additions) {
    if (addition.is_knot) {
      halved[addition.index] = true;
    } else {
      chain.knots[addition.index].promote(trial.by_knot.col(addition.index));
      promoted[addition.index] = true;
    }
  }
  const double longest_s = kLongest * chain.durations_s.mean();
  double last_s = chain.durations_s[0];
  ChainBuilder<D> refined(trial);
  refined.add_piece(last_s, halved[0], 0);
  for (int k = 0; k + 1 < pieces; ++k) {
    const double next_s = chain.durations_s[k + 1];
    const bool is_wanted = promoted[k] || halved[k] || halved[k + 1];
    if (!is_wanted && last_s + next_s < longest_s && is_idle(chain, trial, k)) {
      refined.prolong(next_s);
      last_s += next_s;
    } else {
      refined.add_knot(chain.knots[k]);
      refined.add_piece(next_s, halved[k + 1], k + 1);
      last_s = next_s;
    }
  }
  chain = refined.take();
  return !additions.empty();
}

template TrialKnots<2> try_knots(TrajectoryObjective<2, 3>&, const KnotChain<2>&,
                                 const Minco<2, 3>::Curve&, const std::vector<double>&);
template TrialKnots<3> try_knots(TrajectoryObjective<3, 3>&, const KnotChain<3>&,
                                 const Minco<3, 3>::Curve&, const std::vector<double>&);
template bool refine(KnotChain<2>&, const TrialKnots<2>&, double);
template bool refine(KnotChain<3>&, const TrialKnots<3>&, double);

}  // namespace mocha
