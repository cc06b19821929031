#include "benchmarks/space_time_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <unordered_set>

namespace mocha {
namespace {

constexpr double kCheck_s = 0.05;
constexpr double kArriving_m = 1.0;  // from the goal, where each state counts
constexpr double kRounding = 1e-9;

}  // namespace

class SpaceTimeSearch {
 public:
  SpaceTimeSearch(const SpaceTimeSolver& solver, const LatticeState& from,
                  const std::vector<MovingDisc>& movers, const SearchLimits& limits)
      : solver_(solver),
        options_(solver.options_),
        lattice_(solver.lattice_),
        units_(lattice_.units()),
        limits_(limits),
        first_step_(from.step),
        last_step_(static_cast<int>(options_.longest_s / units_.step_s)),
        horizon_step_(static_cast<int>(
            std::min(1e4, (limits.horizon_s - solver.start_time_s_) / units_.step_s))),
        checks_(std::max(1, static_cast<int>(std::lround(units_.step_s / kCheck_s)))) {
    list_pushes();
    place_movers(lattice_.place(from), movers);
    add(from, kNone);
  }

  std::vector<LatticeState> way() {
    for (int count = 0; !open_.empty() && count < limits_.most_expansions; ++count) {
      const std::uint32_t index = open_.top().index;
      open_.pop();
      const LatticeState state = nodes_[index].state;
      if (solver_.arrived(state) || state.step >= horizon_step_) return way_to(index);
      for (const Push& push : pushes_) expand(index, state, push);
    }
    return {};
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  struct Push {
    int ax, ay;
  };
  struct Node {
    LatticeState state;
    std::uint32_t from;
  };
  struct Entry {
    double bound_s;
    std::uint32_t index;
    std::int16_t step;
    bool operator<(const Entry& other) const {  // the queue's top is the greatest
      if (bound_s != other.bound_s) return bound_s > other.bound_s;
      return step < other.step;
    }
  };
  struct Kept {
    Vector2 centre;
    double keep_m2;
  };

  void list_pushes() {
    const int most = static_cast<int>(limits_.max_acceleration / units_.push + kRounding);
    for (int ax = -most; ax <= most; ++ax) {
      for (int ay = -most; ay <= most; ++ay) {
        const double acceleration = units_.push * std::hypot(ax, ay);
        if (acceleration > limits_.max_acceleration + kRounding) continue;
        pushes_.push_back({ax, ay});
        push_ = std::max(push_, acceleration);
      }
    }
  }

  /// All of them that can be met at each check, one check after the other.
  void place_movers(const Vector2& from, const std::vector<MovingDisc>& movers) {
    const int steps = std::min(last_step_, horizon_step_) - first_step_;
    const double own_m = solver_.robot_radius_m_ + options_.to_movers_m;
    firsts_.push_back(0);
    for (int i = 0; i <= steps * checks_; ++i) {
      const double elapsed_s = i * units_.step_s / checks_;
      const double time_s = solver_.start_time_s_ + first_step_ * units_.step_s + elapsed_s;
      for (const MovingDisc& mover : movers) {
        const auto disc = mover(time_s);
        if (!disc) continue;
        const double keep_m = disc->radius_m + own_m;
        const double reach_m = options_.max_speed * elapsed_s + keep_m + kRounding;
        if ((disc->centre - from).squaredNorm() > reach_m * reach_m) continue;
        movers_.push_back({disc->centre, keep_m * keep_m});
      }
      firsts_.push_back(static_cast<int>(movers_.size()));
    }
  }

  /// Least time to stand at the goal, if nothing were in the way and the speed pointed there.
  double to_go_s(const LatticeState& state) const {
    const double far_m =
        std::max(0.0, (lattice_.place(state) - solver_.goal_).norm() - options_.goal_tolerance_m);
    const double speed = lattice_.velocity(state).norm();
    const double brake_m = 0.5 * speed * speed / push_;
    if (far_m <= brake_m) return speed / push_;
    const double top = std::min(options_.max_speed, std::sqrt(push_ * far_m + 0.5 * speed * speed));
    const double ramps_m = (top * top - 0.5 * speed * speed) / push_;
    return (2.0 * top - speed) / push_ + std::max(0.0, far_m - ramps_m) / top;
  }

  std::uint64_t key(const LatticeState& state) const {
    return lattice_.key(state, (lattice_.place(state) - solver_.goal_).norm() < kArriving_m);
  }

  void add(const LatticeState& state, std::uint32_t from) {
    const double bound_s = state.step * units_.step_s + to_go_s(state);
    if (bound_s > options_.longest_s || state.step > last_step_) return;
    if (!seen_.insert(key(state)).second) return;
    open_.push({bound_s, static_cast<std::uint32_t>(nodes_.size()), state.step});
    nodes_.push_back({state, from});
  }

  void expand(std::uint32_t index, const LatticeState& state, const Push& push) {
    const bool reacts = state.step * units_.step_s >= solver_.reaction_s_;
    if (!reacts && (push.ax != 0 || push.ay != 0)) return;
    const LatticeState next = lattice_.pushed(state, push.ax, push.ay);
    if (lattice_.velocity(next).norm() > options_.max_speed + kRounding || next.step > last_step_)
      return;
    if (seen_.count(key(next)) > 0 || !lattice_.turns(state, next)) return;
    if (clear(state, push)) add(next, index);
  }

  bool clear(const LatticeState& from, const Push& push) const {
    const bool heeds_movers =
        !(limits_.may_be_touched_standing && from.stands() && push.ax == 0 && push.ay == 0);
    const Vector2 start = lattice_.place(from);
    const Vector2 velocity = lattice_.velocity(from);
    const Vector2 acceleration = lattice_.push(push.ax, push.ay);
    for (int i = 1; i <= checks_; ++i) {
      const double t = i * units_.step_s / checks_;
      const Vector2 place = start + t * velocity + 0.5 * t * t * acceleration;
      if (heeds_movers && meets_mover(place, (from.step - first_step_) * checks_ + i)) return false;
      if (!solver_.clearance_.clear(place)) return false;
    }
    return true;
  }

  bool meets_mover(const Vector2& place, int check) const {
    for (int k = firsts_[check]; k < firsts_[check + 1]; ++k) {
      if ((place - movers_[k].centre).squaredNorm() < movers_[k].keep_m2) return true;
    }
    return false;
  }

  std::vector<LatticeState> way_to(std::uint32_t index) const {
    std::vector<LatticeState> way;
    for (; index != kNone; index = nodes_[index].from) way.push_back(nodes_[index].state);
    std::reverse(way.begin(), way.end());
    return way;
  }

  const SpaceTimeSolver& solver_;
  const SolverOptions& options_;
  const SpaceTimeLattice& lattice_;
  const LatticeUnits& units_;
  const SearchLimits limits_;
  const int first_step_;
  const int last_step_;
  const int horizon_step_;
  const int checks_;  // in one step
  std::vector<Push> pushes_;
  double push_ = 0.0;  // [m/s^2] the hardest of them
  std::vector<Kept> movers_;
  std::vector<int> firsts_;  // of the movers of each check, and past the last one's
  std::vector<Node> nodes_;
  std::priority_queue<Entry> open_;
  std::unordered_set<std::uint64_t> seen_;
};

SpaceTimeSolver::SpaceTimeSolver(const SpaceTimeProblem& problem, const SolverOptions& options)
    : options_(options),
      lattice_(options.units, problem.start, problem.start_time_s, options.max_yaw_rate,
               options.can_reverse),
      clearance_(problem.ground, problem.robot_radius_m + options.to_walls_m,
                 options.units.length_m()),
      robot_radius_m_(problem.robot_radius_m),
      start_speed_(problem.start_speed),
      reaction_s_(problem.reaction_s),
      start_time_s_(problem.start_time_s),
      goal_(problem.goal) {}

bool SpaceTimeSolver::arrived(const LatticeState& state) const {
  return state.stands() && (lattice_.place(state) - goal_).norm() <= options_.goal_tolerance_m;
}

SearchLimits SpaceTimeSolver::whole_way() const {
  return {options_.max_acceleration, start_time_s_ + options_.longest_s + options_.units.step_s};
}

std::vector<LatticeState> SpaceTimeSolver::way(const LatticeState& from,
                                               const std::vector<MovingDisc>& movers,
                                               const SearchLimits& limits) const {
  return SpaceTimeSearch(*this, from, movers, limits).way();
}

std::optional<double> arrival_time_s(const SpaceTimeProblem& problem,
                                     const SolverOptions& options) {
  const SpaceTimeSolver solver(problem, options);
  const auto way = solver.way(solver.start(), problem.movers, solver.whole_way());
  if (way.empty()) return std::nullopt;
  return solver.lattice().time_s(way.back());
}

}  // namespace mocha
