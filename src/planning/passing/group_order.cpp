#include "planning/passing/group_order.h"

#include <cmath>
#include <utility>

#include "planning/passing/move_search.h"
#include "planning/passing/passing_search.h"
#include "planning/passing/quick_passing.h"

namespace mocha {
namespace {

constexpr double kAround_m = 8.0;  // of the group, in which it looks for room first
constexpr double kAtPlace_m = 0.02;
// One after the other, where the search is stopped before it finds a way.
constexpr MoveSearchOptions kMoveSearches[] = {{100000, 1.0}, {400000, 2.0}};
constexpr int kMostSteps = 300000;    // where no search for moves finds one
constexpr int kMostChoices = 200000;  // to find quicker ones

class Grouping {
 public:
  Grouping(const PassingGround& ground, const Eigen::AlignedBox2d& window,
           const std::vector<PassingMember>& members, const PlaceGraphOptions& options,
           const PassingPace& pace)
      : members_(members), options_(options), pace_(pace) {
    FixedPlaces fixed;
    for (const PassingMember& member : members) {
      const int place = number_of(member.goal.value_or(member.place), fixed.goals);
      problem_.goals.push_back(member.goal ? place : PassingProblem::kAnywhere);
    }
    for (const PassingMember& member : members)
      problem_.starts.push_back(start_number_of(member.place, fixed));
    problem_.graph = make_place_graph(ground, window, fixed, options);
    give_up_what_is_out_of_reach();
  }

  /// Gives up goals from the lowest rank on, until the others can be reached.
  std::optional<GroupOrder> order(const std::function<bool()>& should_stop) {
    for (;;) {
      PassingSequence sequence = some_sequence(should_stop);
      if (sequence.outcome == PassingSequence::Outcome::kFound)
        return group_of(
            quickened(problem_, std::move(sequence.steps), pace_, kMostChoices, should_stop));
      if (should_stop() || !give_up_lowest()) return std::nullopt;
    }
  }

 private:
  /// Of a place that is there, or is added.
  static int number_of(const Vector2& place, std::vector<Vector2>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if ((places[i] - place).norm() < kAtPlace_m) return static_cast<int>(i);
    }
    places.push_back(place);
    return static_cast<int>(places.size()) - 1;
  }

  static int start_number_of(const Vector2& place, FixedPlaces& fixed) {
    const int goals = static_cast<int>(fixed.goals.size());
    std::vector<Vector2> known = fixed.goals;
    const int goal = number_of(place, known);
    return goal < goals ? goal : goals + number_of(place, fixed.starts);
  }

  bool has_goal(std::size_t member) const {
    return problem_.goals[member] != PassingProblem::kAnywhere;
  }

  /// Also where a higher rank is to stand so near that both cannot.
  void give_up_what_is_out_of_reach() {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (!has_goal(i)) continue;
      const int goal = problem_.goals[i];
      bool possible = std::isfinite(distances_to(problem_.graph, goal)[problem_.starts[i]]);
      for (std::size_t j = 0; j < i && possible; ++j) {
        if (!has_goal(j)) continue;
        const auto& places = problem_.graph.places;
        const Vector2 apart = places[problem_.goals[j]] - places[goal];
        possible = problem_.goals[j] != goal && apart.norm() >= options_.apart_m;
      }
      if (!possible) problem_.goals[i] = PassingProblem::kAnywhere;
    }
  }

  bool give_up_lowest() {
    std::size_t last = members_.size();
    std::size_t goals = 0;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (!has_goal(i)) continue;
      last = i;
      ++goals;
    }
    if (goals <= 1) return false;
    problem_.goals[last] = PassingProblem::kAnywhere;
    return true;
  }

  PassingSequence some_sequence(const std::function<bool()>& should_stop) const {
    for (const MoveSearchOptions& options : kMoveSearches) {
      PassingSequence found = find_few_moves(problem_, options, should_stop);
      if (found.outcome != PassingSequence::Outcome::kStopped) return found;
    }
    return find_passing(problem_, kMostSteps, should_stop);
  }

  GroupOrder group_of(const std::vector<JointStep>& sequence) const {
    GroupOrder group{order_of(sequence, problem_.robots()), {}};
    for (std::size_t i = 0; i < members_.size(); ++i)
      group.gets_there.push_back(members_[i].goal && has_goal(i));
    return group;
  }

  const std::vector<PassingMember>& members_;
  const PlaceGraphOptions options_;
  const PassingPace pace_;
  PassingProblem problem_;
};

Eigen::AlignedBox2d around(const std::vector<PassingMember>& members) {
  Eigen::AlignedBox2d box(members.front().place);
  for (const PassingMember& member : members) {
    box.extend(member.place);
    if (member.goal) box.extend(*member.goal);
  }
  box.extend(box.min() - Vector2::Constant(kAround_m));
  box.extend(box.max() + Vector2::Constant(kAround_m));
  return box;
}

bool all_get_there(const GroupOrder& order, const std::vector<PassingMember>& members) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].goal && !order.gets_there[i]) return false;
  }
  return true;
}

}  // namespace

std::optional<GroupOrder> order_group(const PassingGround& ground,
                                      const std::vector<PassingMember>& members,
                                      const PlaceGraphOptions& options, const PassingPace& pace,
                                      const std::function<bool()>& should_stop) {
  if (members.empty() || static_cast<int>(members.size()) > JointStep::kMostRobots)
    return std::nullopt;
  const PassingGround unseen_too{ground.static_map, ground.blocked};
  const Eigen::AlignedBox2d& everywhere = ground.static_map.bounds();
  const Eigen::AlignedBox2d near = around(members);
  std::vector<std::pair<const PassingGround*, Eigen::AlignedBox2d>> attempts = {{&ground, near}};
  if (!near.contains(everywhere)) attempts.emplace_back(&ground, everywhere);
  if (ground.unseen != nullptr) attempts.emplace_back(&unseen_too, everywhere);
  std::optional<GroupOrder> best;
  for (const auto& [where, window] : attempts) {
    auto order = Grouping(*where, window, members, options, pace).order(should_stop);
    if (order && all_get_there(*order, members)) return order;
    if (order && !best) best = std::move(order);
  }
  return best;
}

}  // namespace mocha
