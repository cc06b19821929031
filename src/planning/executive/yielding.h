#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fleet/protocol/yield_request.h"
#include "planning/candidates/planning_scene.h"
#include "planning/global/planner_options.h"
#include "world/robot_model.h"

namespace mocha {

/// Which robot makes room where two want the same narrow place. The robot of higher rank says which
/// way it wants. A robot that stands or would drive in that way keeps out of it until the other has
/// passed; if a third one stands in the way to where it keeps out, it asks that one in turn, in the
/// name of the higher rank. A robot without a place to keep out outranks all that have one; a
/// parked robot is outranked by all that are on their way.
///
/// As ranks are a total order, one robot always goes on; a request ends with its goal, so no robot
/// waits for ever.
class Yielding {
 public:
  /// `own`: this robot's rank while it is neither stuck nor parked.
  Yielding(Rank own, RobotModel robot, const PlannerOptions& options);
  void set_options(const PlannerOptions& options);

  /// A validated request of a team-mate, in force until it is replaced, withdrawn or lapses.
  void hear(const YieldRequest& request, double now_s);

  // --- what is asked of this robot ---

  /// Whether a request of higher rank is in force.
  bool yields(double now_s) const { return !above(now_s).empty(); }
  /// The highest rank with a way that a robot at `place` stands in; nothing where there is none.
  std::optional<Rank> in_way_of(const Vector2& place, double now_s) const;
  /// The same for a robot that drives `motion` and then stands: on such a way at a time when the
  /// other may have come there.
  std::optional<Rank> in_way_of(const Motion& motion, double now_s) const;

  /// The nearest place, along the map, that is off all ways of higher ranks; where there is none,
  /// one off as many of the highest as can be. Standing team-mates are driven around if possible;
  /// else they will be asked. Nothing where there is no such place: this robot is stuck.
  std::optional<Vector2> pull_over_point(const Vector2& from, const PlanningScene& scene,
                                         double now_s) const;

  // --- what it asks of others ---

  const Rank& own() const { return own_; }
  void set_stuck(bool stuck) { own_.stuck = stuck; }
  void set_parked(bool parked);

  /// The way on the map from here to there, team-mates aside; empty if there is none.
  std::vector<Vector2> path(const Vector2& from, const Vector2& to,
                            const PlanningScene& scene) const;
  /// Whether a team-mate is now closer to it than its centre must be, and `more_m` besides.
  bool is_near(const std::vector<Vector2>& path, const PlanningScene& scene, double now_s,
               double more_m) const;
  /// What to say to ask for it, in the name of `rank`; without a way, to ask no more.
  YieldRequest request_for(const std::vector<Vector2>& path, const Rank& rank) const;

 private:
  struct Heard {
    YieldRequest request;
    double until_s;
  };
  /// A place, and how many of the highest leave it alone.
  struct PullOverChoice {
    std::size_t spared = 0;
    std::optional<Vector2> place;
  };

  /// The requests in force that this robot yields to, highest first.
  std::vector<const YieldRequest*> above(double now_s) const;
  double keep_m(const YieldRequest& request) const;
  bool meets(const Motion& motion, const YieldRequest& request, double now_s) const;
  PullOverChoice best_pull_over_point(const std::vector<const YieldRequest*>& paths,
                                      const Vector2& from, const PlanningScene& scene, double now_s,
                                      bool around_all) const;

  Rank own_;
  const int priority_;
  const RobotModel robot_;
  HomotopyPathOptions options_;
  std::map<std::string, Heard> heard_;
};

}  // namespace mocha
