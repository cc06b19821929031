// Clocks that differ by what no exchange of messages can tell from a delay.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <variant>

#include "fleet/protocol/commitment_protocol.h"
#include "fleet/protocol/motions.h"
#include "fleet/protocol/shipped_options.h"
#include "trajectory/rover_braking.h"
#include "trajectory/separation.h"
#include "trajectory/stop_separation.h"

namespace mocha {
namespace {

constexpr double kBegin_s = 100.0;  // by the clock of the first robot, which is right
constexpr double kStep_s = 0.01;
constexpr double kRadius_m = 0.3;
constexpr double kStopError_m = 0.02;  // of stops that are looked at ten times a second

/// Two robots; all of the delay is on the way from the first to the second, or on the way back.
class Pair {
 public:
  Pair(const CommitmentOptions& first, const CommitmentOptions& second, double there_s,
       double back_s, double ahead_s)
      : robots_{CommitmentProtocol(first), CommitmentProtocol(second)},
        delay_s_{there_s, back_s},
        ahead_s_{0.0, ahead_s} {}

  /// By the clock of robot i.
  double now(int i) const { return now_s_ + ahead_s_[i]; }
  void brake(int i, Motion motion) { apply(i, robots_[i].brake(proposal(motion), now(i))); }
  void propose(int i, Motion motion) { apply(i, robots_[i].propose(proposal(motion), now(i))); }

  void run(double seconds) {
    for (const double until_s = now_s_ + seconds; now_s_ < until_s;) {
      now_s_ += kStep_s;
      while (!under_way_.empty() && under_way_.begin()->first <= now_s_) {
        const auto deliver = under_way_.begin()->second;
        under_way_.erase(under_way_.begin());
        deliver();
      }
      for (int i = 0; i < 2; ++i) apply(i, robots_[i].tick(now(i)));
    }
  }

  /// The motion in force, or to come, as it truly is.
  Motion promised(int i) const {
    const Motion& motion = *robots_[i].binding().newest().motion;
    return Motion(motion.start_time() - ahead_s_[i], motion.phases());
  }
  bool has_promised(int i, std::uint32_t sequence) const {
    return robots_[i].binding().newest().id.sequence == sequence;
  }

 private:
  static Proposal proposal(const Motion& motion) {
    return {1, kRadius_m, test::kRoverBraking, test::shared(motion)};
  }

  void apply(int i, const CommitmentActions& actions) {
    for (const CommittedTrajectory& trajectory : actions.trajectories) send(i, trajectory);
    if (actions.heartbeat) send(i, *actions.heartbeat);
  }

  template <typename Message>
  void send(int from, const Message& message) {
    const int to = 1 - from;
    under_way_.emplace(now_s_ + delay_s_[from],
                       [this, to, message] { apply(to, robots_[to].receive(message, now(to))); });
  }

  CommitmentProtocol robots_[2];
  double delay_s_[2];
  double ahead_s_[2];
  double now_s_ = kBegin_s;
  std::multimap<double, std::function<void()>> under_way_;
};

/// At up to 2 m/s through the origin.
Motion along_x(double start_s) { return test::drive(start_s, {{-4.0, 0.0}, {4.0, 0.0}}, 1.0); }
Motion along_y(double start_s) { return test::drive(start_s, {{0.0, -4.0}, {0.0, 4.0}}, 1.0); }

/// The first robot has promised along_x(); the second proposes along_y(), later by so much by its
/// own clock. Nothing: refused.
struct Met {
  double distance_m;  // of the centres, in truth
  bool by_stopping;   // in truth, one brakes and they come closer than demanded
};
std::optional<Met> promised_beside(const CommitmentOptions& first, double there_s, double back_s,
                                   double ahead_s, double later_s) {
  CommitmentOptions second = first;
  second.agent = "ugv2";
  Pair pair(first, second, there_s, back_s, ahead_s);
  pair.brake(0, test::stand(pair.now(0), {-4.0, 0.0}));
  pair.brake(1, test::stand(pair.now(1), {0.0, -4.0}));
  pair.run(3.0);
  pair.propose(0, along_x(pair.now(0) + 2.0));
  pair.run(1.0);
  EXPECT_TRUE(pair.has_promised(0, 2));
  pair.propose(1, along_y(pair.now(1) + 1.0 + later_s));
  pair.run(1.0);
  if (!pair.has_promised(1, 2)) return std::nullopt;
  const Motion one = pair.promised(0);
  const Motion other = pair.promised(1);
  const double apart_m = closest_approach(one, other, kBegin_s, kBegin_s + 60.0).distance_m;
  const double demanded_m = 2.0 * kRadius_m + first.stop_clearance_m - kStopError_m;
  const auto stop = first_stop_meeting({one, test::kRoverBraking}, {other, test::kRoverBraking},
                                       demanded_m, first.stop_reaction_s.value(), kBegin_s);
  return Met{apart_m, stop.has_value()};
}

struct Seen {
  int promised = 0;
  double least_m = std::numeric_limits<double>::infinity();
  int met_by_stopping = 0;
};

/// Whatever the second robot may promise, for clocks that differ by up to what hides.
Seen all_that_may_be_promised(const CommitmentOptions& options, double most_ahead_s) {
  Seen seen;
  for (const double there_s : {0.0, 0.1}) {
    for (const double ahead_s : {-most_ahead_s, 0.0, most_ahead_s}) {
      for (double later_s = -1.2; later_s < 4.0; later_s += 0.04) {
        const auto met = promised_beside(options, there_s, 0.1 - there_s, ahead_s, later_s);
        if (!met) continue;
        ++seen.promised;
        seen.least_m = std::min(seen.least_m, met->distance_m);
        seen.met_by_stopping += met->by_stopping;
      }
    }
  }
  return seen;
}

CommitmentOptions options() {
  CommitmentOptions options = test::shipped_options("ugv1");
  options.reach.promise_m = 20.0;  // robots at 2 m/s
  options.peer_clearance_m = 0.4;
  options.stop_clearance_m = 0.0;
  return options;
}

TEST(HiddenOffset, RobotsKeepApartWhateverTheirClocksHide) {
  const CommitmentOptions demands = options();
  const Seen seen = all_that_may_be_promised(demands, 0.12);
  EXPECT_GT(seen.promised, 100);
  EXPECT_GT(seen.least_m, 2.0 * kRadius_m + demands.peer_clearance_m - 2e-3);
}

TEST(HiddenOffset, RobotsKeepRoomToBrakeWhateverTheirClocksHide) {
  CommitmentOptions demands = options();
  demands.peer_clearance_m = 0.0;
  demands.stop_clearance_m = 0.2;
  const Seen seen = all_that_may_be_promised(demands, 0.12);
  EXPECT_GT(seen.promised, 100);
  EXPECT_EQ(seen.met_by_stopping, 0);
}

}  // namespace
}  // namespace mocha
