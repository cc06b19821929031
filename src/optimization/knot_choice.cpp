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
      : objective_(objective),
        candidates_(candidates),
        step_s_(candidates.duration_s / intervals()) {}

  KnotChain<D> choose() {
    for (int i = 0; i <= intervals(); i += candidates_.coarsest) chosen_.push_back(i);
    const Eigen::VectorXd durations_s = place_knots(chosen_);
    step_s_ *= paced(objective_, durations_s).sum() / durations_s.sum();
    while (halve_pieces()) {
    }
    return chain();
  }

 private:
  int intervals() const { return static_cast<int>(candidates_.path.cols()) - 1; }

  /// Puts the objective's knots there; returns the durations between them.
  Eigen::VectorXd place_knots(const std::vector<int>& chosen) {
    const int pieces = static_cast<int>(chosen.size()) - 1;
    Points knots(D, pieces - 1);
    Eigen::VectorXd durations_s(pieces);
    for (int i = 0; i < pieces; ++i) {
      durations_s[i] = step_s_ * (chosen[i + 1] - chosen[i]);
      if (i > 0) knots.col(i - 1) = candidates_.path.col(chosen[i]);
    }
    objective_.set_knot_map(std::make_shared<WaypointMap<D>>(knots));
    return durations_s;
  }

  /// What each piece is penalised where the knots are there.
  std::vector<double> penalties(const std::vector<int>& chosen) {
    const Eigen::VectorXd durations_s = place_knots(chosen);
    Eigen::VectorXd gradient(objective_.variables());
    objective_.evaluate(objective_.initial(durations_s), gradient);
    std::vector<double> penalties;
    for (int i = 0; i < durations_s.size(); ++i) penalties.push_back(objective_.penalty(i));
    return penalties;
  }

  /// What the path is penalised between two of its points: weighed when it is asked for first.
  double path_penalty(int from, int to) {
    if (path_penalty_.empty()) {
      std::vector<int> all(candidates_.path.cols());
      std::iota(all.begin(), all.end(), 0);
      path_penalty_ = penalties(all);
    }
    return std::accumulate(path_penalty_.begin() + from, path_penalty_.begin() + to, 0.0);
  }

  bool halve_pieces() {
    const std::vector<double> penalty = penalties(chosen_);
    const auto curve = objective_.curve();
    const double excess = kExcess * objective_.duration_cost();
    std::vector<int> finer;
    for (int i = 0; i < curve.pieces(); ++i) {
      const int from = chosen_[i];
      const int to = chosen_[i + 1];
      finer.push_back(from);
      const int middle = (from + to) / 2;
      if (middle == from) continue;
      const double off_m = (curve.derivative({i, 0.5}, 0) - candidates_.path.col(middle)).norm();
      if (off_m > candidates_.tolerance_m ||
          (penalty[i] > excess && penalty[i] > excess + path_penalty(from, to)))
        finer.push_back(middle);
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
  std::vector<int> chosen_;           // columns of the path
  std::vector<double> path_penalty_;  // of each interval
  double step_s_;                     // between neighbours
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
