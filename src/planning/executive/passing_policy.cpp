#include "planning/executive/passing_policy.h"

#include <algorithm>
#include <utility>

#include "planning/global/front_end.h"
#include "planning/passing/obstacles_along.h"

namespace mocha {
namespace {

constexpr double kSayAgain_s = 0.3;
// From the first call on, until all have said where they are to get.
constexpr double kGather_s = 0.5;
constexpr double kHold_s = 1.2;
constexpr double kHoldAgain_s = 5.0;
constexpr double kCallAgain_s = 2.0;   // at least, after an order that it could not keep to
constexpr double kStuck_s = 6.0;       // it may go on, and does not
constexpr double kObstructed_s = 1.0;  // the same, with an obstacle on its way
constexpr double kLetDown_s = 10.0;    // the robot that it waits for has left the order
constexpr double kForgotten_s = 40.0;  // it waits, and nobody of the order gets on
constexpr double kNoNews_s = 45.0;     // whoever still waits has given it up by then
constexpr double kAtPlace_m = 0.15;
constexpr double kSoon_s = 0.5;  // planning takes about so long

}  // namespace

PassingPolicy::PassingPolicy(std::string name, int priority, RobotModel robot,
                             const PlannerOptions& options)
    : name_(std::move(name)),
      priority_(priority),
      robot_(std::move(robot)),
      travel_(homotopy_path_options(robot_, options).travel),
      leader_(name_, robot_, options) {
  said_.agent = name_;
  said_.priority = priority_;
}

void PassingPolicy::set_options(const PlannerOptions& options) {
  leader_.set_options(options);
  travel_ = homotopy_path_options(robot_, options).travel;
}

/// An instruction that comes late, or again, does not bring the order back.
void PassingPolicy::begin_goal() {
  leave_order();
  void_ = newest_;
  offered_.reset();
  leader_.retire();
  finished_ = PassingOrderId();
  obstacles_.clear();
  calls_ = false;
}

void PassingPolicy::leave_order() {
  followed_.reset();
  promised_.clear();
  stretch_.reset();
  impediment_.reset();
}

// --- what others say ---

void PassingPolicy::hear(const PassingMessage& message, double now_s) {
  if (const auto* instruction = std::get_if<PassingInstruction>(&message)) {
    if (instruction->robot == name_ && instruction->id.leader != name_) follow(*instruction);
    return;
  }
  const auto& intent = std::get<PassingIntent>(message);
  if (intent.agent == name_) return;
  const HeardIntents::Heard heard = heard_.hear(intent, now_s);
  if (heard == HeardIntents::Heard::kNoRoom) return;
  if (heard == HeardIntents::Heard::kNews || intent.calls) news_s_ = now_s;
  leader_.hear(intent, now_s);
  // Two have made an order at the same time.
  const bool leads = intent.follows.leader == intent.agent && is_recent(intent.follows, now_s);
  if (!leads || !outranks(intent, said_) || !leader_.competes(intent.follows, intent.agent)) return;
  leader_.retire();
  if (followed_ && followed_->id().leader == name_) leave_order();
}

/// Of a new order the first part, with which the robot can begin; or more of what it follows.
void PassingPolicy::follow(const PassingInstruction& instruction) {
  if (followed_ && followed_->id() == instruction.id) {
    followed_->add(instruction);
    return;
  }
  const bool is_late =
      instruction.id.leader == newest_.leader && instruction.id.number < newest_.number;
  if (instruction.first != 0 || is_late || instruction.id == void_) return;
  newest_ = instruction.id;
  offered_ = instruction;
}

bool PassingPolicy::somebody_calls(double now_s) const {
  const auto fresh = heard_.all(now_s);
  // Who is through says so as well: that alone is no reason to go on.
  const bool has_news = now_s < news_s_ + kNoNews_s;
  return std::any_of(fresh.begin(), fresh.end(), [&](const PassingIntent& intent) {
    return intent.calls || (has_news && intent.follows.number > 0);
  });
}

std::uint32_t PassingPolicy::promised_by(const std::string& name) const {
  if (name == name_) return followed_->promised();
  const auto found = promised_.find(name);
  return found != promised_.end() ? found->second : 0;
}

/// What was heard once counts, though its robot may be through and silent by now.
void PassingPolicy::note_promised(double now_s) {
  for (const std::string& robot : followed_->robots()) {
    const PassingIntent* said = heard_.of(robot, now_s);
    if (said == nullptr || said->follows != followed_->id()) continue;
    std::uint32_t& moves = promised_[robot];
    moves = std::max(moves, said->moves);
  }
}

// --- what the robot does ---

std::vector<PassingMessage> PassingPolicy::step(const PassingSituation& situation,
                                                const SceneSource& scene) {
  const double now_s = situation.now_s;
  if (offered_) take_up(situation, scene);
  if (followed_) progress(situation);
  watch(situation, scene);
  hold(now_s);
  std::vector<PassingMessage> messages;
  if (leads(now_s)) lead(situation, scene);
  const PassingIntent now = intent(situation);
  const bool takes_part = calls_ || follows() || somebody_calls(now_s);
  if (!takes_part || (!is_news(said_, now) && now_s < said_s_ + kSayAgain_s)) return messages;
  said_ = now;
  said_s_ = now_s;
  leader_.say(heard_, now_s, messages);
  messages.emplace_back(now);
  return messages;
}

/// A new order where the robot comes to rest at its beginning. Where obstacles are on its way,
/// watch() leaves it at once.
void PassingPolicy::take_up(const PassingSituation& situation, const SceneSource& scene) {
  const PassingInstruction instruction = *std::exchange(offered_, std::nullopt);
  FollowedOrder order(instruction);
  const Vector2 rest = situation.committed.end_pose().position;
  const auto start = order.start();
  if (!order.is_over() && !(start && (*start - rest).norm() < kAtPlace_m)) return;
  leave_order();
  note_obstacles(instruction.part, scene({rest}));
  leader_.retire_for(order.id());
  followed_ = std::move(order);
  finished_ = PassingOrderId();
  calls_ = false;
  progressed_s_ = situation.now_s;
}

/// Gets on with its order.
void PassingPolicy::progress(const PassingSituation& situation) {
  note_promised(situation.now_s);
  followed_->note_promise(situation.committed);
  const MotionState soon = situation.committed.at(situation.now_s + kSoon_s);
  if (soon.at_rest) followed_->note_stand(soon.pose.position, kAtPlace_m);
  // The way on leads forward: what it drives backward, it drives to its end.
  if (soon.speed > 0.0) followed_->note_drive(soon.pose.position);
  stretch_ = followed_->grant([this](const std::string& name) { return promised_by(name); });
  std::uint32_t moves = 0;
  for (const std::string& robot : followed_->robots()) moves += promised_by(robot);
  // What it has promised may begin with a wait.
  const bool goes_on =
      !stands(situation.measured) || situation.committed.end_time() > situation.now_s;
  if (moves != seen_moves_ || goes_on) progressed_s_ = situation.now_s;
  seen_moves_ = moves;
  if (!followed_->is_over()) return;
  finished_ = followed_->id();
  finished_moves_ = followed_->moves();
  news_s_ = situation.now_s;
  leave_order();
}

/// Those that its own map has on these turns.
void PassingPolicy::note_obstacles(const std::vector<PassingTurn>& turns,
                                   const PlanningScene& scene) {
  obstacles_.clear();
  for (const PassingTurn& turn : turns) {
    const auto found = obstacles_along(turn.path, *scene.static_map, travel_.required_clearance_m);
    obstacles_.insert(obstacles_.end(), found.begin(), found.end());
  }
  if (obstacles_.size() > kMostObstacles) obstacles_.resize(kMostObstacles);
}

/// A robot that it waits for says that it keeps to another order, or to none.
bool PassingPolicy::is_let_down(double now_s) const {
  const auto names =
      followed_->waits_for([this](const std::string& name) { return promised_by(name); });
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    const PassingIntent* said = heard_.of(name, now_s);
    return said != nullptr && said->follows != followed_->id();
  });
}

bool PassingPolicy::is_stuck(const PassingSituation& situation) const {
  const double without_progress_s = situation.now_s - progressed_s_;
  if (stretch_) return without_progress_s > kStuck_s;
  return without_progress_s > kForgotten_s ||
         (without_progress_s > kLetDown_s && is_let_down(situation.now_s));
}

void PassingPolicy::watch(const PassingSituation& situation, const SceneSource& scene) {
  const bool called = calls_;
  const Vector2& here = situation.measured.pose.position;
  if (stretch_ && situation.now_s > progressed_s_ + kObstructed_s)
    note_obstacles({{stretch_->path, {}}}, scene({here}));
  if (follows() && (!obstacles_.empty() || is_stuck(situation))) {
    leave_order();
    calls_until_s_ = situation.now_s + kCallAgain_s;
  }
  calls_ =
      !follows() && situation.goal &&
      (situation.now_s < calls_until_s_ ||
       impediment_.is_impeded(stands(situation.measured), here, *situation.goal,
                              scene({here, *situation.goal}), robot_, travel_, situation.now_s));
  if (calls_ && !called) calls_since_s_ = situation.now_s;
}

/// From the first call on until an order may have come; another time only after a while.
void PassingPolicy::hold(double now_s) {
  const auto fresh = heard_.all(now_s);
  const bool called = calls_ || std::any_of(fresh.begin(), fresh.end(),
                                            [](const PassingIntent& other) { return other.calls; });
  if (called && now_s > called_s_ + kHoldAgain_s) called_s_ = now_s;
  holds_ = called && now_s < called_s_ + kHold_s;
}

PassingIntent PassingPolicy::intent(const PassingSituation& situation) const {
  PassingIntent intent;
  intent.agent = name_;
  intent.priority = priority_;
  intent.calls = calls_;
  intent.radius_m = robot_.footprint.circumscribed_radius_m();
  intent.goal = situation.goal;
  intent.follows = followed_ ? followed_->id() : finished_;
  intent.moves = followed_ ? followed_->promised() : finished_moves_;
  intent.obstacles = obstacles_;
  return intent;
}

// --- what the caller of the highest rank does ---

/// Whether it is to make an order now: others are about, and none of them that calls, or has just
/// made one, outranks it.
bool PassingPolicy::leads(double now_s) const {
  const auto fresh = heard_.all(now_s);
  const bool is_asked = calls_ && now_s >= calls_since_s_ + kGather_s;
  if (!is_asked && !leader_.is_not_kept(fresh)) return false;
  if (!leader_.may_make_another(now_s)) return false;
  const auto is_leader = [&](const PassingIntent& other) {
    const bool has_just_led =
        other.follows.leader == other.agent && is_recent(other.follows, now_s);
    return (other.calls || has_just_led) && outranks(other, said_);
  };
  const bool is_outranked = std::any_of(fresh.begin(), fresh.end(), is_leader);
  return !fresh.empty() && !is_outranked;
}

void PassingPolicy::lead(const PassingSituation& situation, const SceneSource& scene) {
  std::vector<PassingIntent> intents = heard_.all(situation.now_s);
  intents.push_back(intent(situation));
  std::sort(intents.begin(), intents.end(), outranks);
  const Vector2& here = situation.measured.pose.position;
  offered_ = leader_.make(intents, here, situation.committed.end_pose().position, scene({here}),
                          situation.now_s);
  said_s_ = -std::numeric_limits<double>::infinity();
}

}  // namespace mocha
