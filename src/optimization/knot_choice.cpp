#include "optimization/knot_choice.h"

#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

#include "optimization/pace.h"

namespace mocha {
namespace {

constexpr double kExcess = 0.1;  // of a penalty over that of the path, by the cost of duration

template <int D>
class KnotChooser {
 public:
  using Points = typename KnotCandidates<D>::Points;

  KnotChooser(TrajectoryObjective<D, 3>& objective, const KnotCandidates<D>& candidates)
      : objective_(objective), candidates_(candidates) {}

  KnotChain<D> choose() {
    weigh_path();
    chosen_.clear();
    for (int i = 0; i <= intervals(); i += candidates_.coarsest) chosen_.push_back(i);
    while (halve_pieces()) {
    }
    return chain();
  }

 private:
  int intervals() const { return static_cast<int>(candidates_.path.cols()) - 1; }

  /// The curve through the chosen points becomes the objective's last.
  void evaluate() {
    const int pieces = static_cast<int>(chosen_.size()) - 1;
    Points knots(D, pieces - 1);
    Eigen::VectorXd durations_s(pieces);
    for (int i = 0; i < pieces; ++i) {
      durations_s[i] = step_s_ * (chosen_[i + 1] - chosen_[i]);
      if (i > 0) knots.col(i - 1) = candidates_.path.col(chosen_[i]);
    }
    objective_.set_knot_map(std::make_shared<WaypointMap<D>>(knots));
    Eigen::VectorXd gradient(objective_.variables());
    objective_.evaluate(objective_.initial(durations_s), gradient);
  }

  /// What each interval of the path is penalised, at a good pace.
  void weigh_path() {
    step_s_ = candidates_.duration_s / intervals();
    chosen_.resize(intervals() + 1);
    std::iota(chosen_.begin(), chosen_.end(), 0);
    evaluate();
    step_s_ = paced(objective_, Eigen::VectorXd::Constant(intervals(), step_s_)).mean();
    evaluate();
    for (int i = 0; i < intervals(); ++i) path_penalty_.push_back(objective_.penalty(i));
  }

  bool halve_pieces() {
    evaluate();
    const auto curve = objective_.curve();
    std::vector<int> finer;
    for (int i = 0; i < curve.pieces(); ++i) {
      finer.push_back(chosen_[i]);
      const int middle = (chosen_[i] + chosen_[i + 1]) / 2;
      if (middle == chosen_[i]) continue;
      const double off_m = (curve.derivative({i, 0.5}, 0) - candidates_.path.col(middle)).norm();
      const double of_path = std::accumulate(path_penalty_.begin() + chosen_[i],
                                             path_penalty_.begin() + chosen_[i + 1], 0.0);
      const double most = of_path + kExcess * objective_.duration_cost();
      if (off_m > candidates_.tolerance_m || objective_.penalty(i) > most) finer.push_back(middle);
    }
    finer.push_back(chosen_.back());
    chosen_.swap(finer);
    return chosen_.size() > finer.size();
  }

  KnotChain<D> chain() const {
    KnotChain<D> chain;
    Points path(D, chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) path.col(i) = candidates_.path.col(chosen_[i]);
    const auto references = candidates_.references(path);
    chain.durations_s.resize(path.cols() - 1);
    for (int i = 0; i + 1 < path.cols(); ++i) {
      chain.durations_s[i] = step_s_ * (chosen_[i + 1] - chosen_[i]);
      if (i == 0) continue;
      const Eigen::Matrix<double, D, 1> place = path.col(i);
      if (references) {
        chain.knots.push_back(RayKnot<D>::on_ray(place, place - references->col(i - 1)));
      } else {
        chain.knots.push_back(RayKnot<D>::on_ray(place, RayKnot<D>::Vector::UnitX()));
        chain.knots.back().freedom = D;
      }
    }
    return chain;
  }

  TrajectoryObjective<D, 3>& objective_;
  const KnotCandidates<D>& candidates_;
  std::vector<int> chosen_;  // columns of the path
  std::vector<double> path_penalty_;
  double step_s_ = 0.0;
};

}  // namespace

template <int D>
KnotChain<D> choose_knots(TrajectoryObjective<D, 3>& objective,
                          const KnotCandidates<D>& candidates) {
  const int coarsest = candidates.coarsest;
  const auto intervals = candidates.path.cols() - 1;
  if (coarsest < 1 || (coarsest & (coarsest - 1)) != 0 || intervals < coarsest ||
      intervals % coarsest != 0) {
    throw std::invalid_argument("KnotCandidates: coarsest is " + std::to_string(coarsest) +
                                ", allowed is a power of 2 that divides the path's " +
                                std::to_string(intervals) + " intervals");
  }
  if (!(candidates.duration_s > 0.0) || !(candidates.tolerance_m > 0.0) ||
      !candidates.path.allFinite()) {
    throw std::invalid_argument(
        "KnotCandidates: duration_s or tolerance_m is not above 0, or the path is not finite");
  }
  return KnotChooser<D>(objective, candidates).choose();
}

template KnotChain<2> choose_knots(TrajectoryObjective<2, 3>&, const KnotCandidates<2>&);
template KnotChain<3> choose_knots(TrajectoryObjective<3, 3>&, const KnotCandidates<3>&);

}  // namespace mocha
