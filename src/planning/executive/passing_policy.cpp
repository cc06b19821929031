#include "planning/executive/passing_policy.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fleet/wire/passing_parts.h"
#include "planning/candidates/peer_discs.h"
#include "planning/global/front_end.h"
#include "planning/passing/group_order.h"
#include "safety/requirement.h"

namespace mocha {
namespace {

constexpr double kSayAgain_s = 0.3;
constexpr double kLapse_s = 1.5;       // of what is not heard any more
constexpr double kGather_s = 0.5;      // from the first call on, until all have said where to
constexpr double kMakeAgain_s = 2.0;   // an order that is not kept to
constexpr double kStuck_s = 6.0;       // it may go on, and does not
constexpr double kForgotten_s = 40.0;  // it waits, and nobody of the order gets on
constexpr double kNoNews_s = 45.0;     // whoever still waits has given it up by then
constexpr std::size_t kMostHeard = 256;
constexpr double kAtPlace_m = 0.15;
constexpr double kHandover_s = 1.0;  // of moves, about: planning, settling
constexpr double kSpare_m = 0.02;    // more than promises keep

/// Where a team-mate will come to rest, by its promise.
Vector2 rest_place(const MovingObstacle& peer) { return peer.at(peer.rest_time()).centre; }

bool is_news(const PassingIntent& before, const PassingIntent& now) {
  return now.calls != before.calls || now.follows != before.follows || now.moves != before.moves;
}

/// Those farthest from `here` take no part where there are more than an order can be for.
void keep_nearest(const Vector2& here, std::vector<PassingMember>& members) {
  if (members.size() <= kMostPassing) return;
  std::vector<double> distances_m;
  for (const PassingMember& member : members) distances_m.push_back((member.place - here).norm());
  const auto first_out = distances_m.begin() + kMostPassing;
  std::nth_element(distances_m.begin(), first_out, distances_m.end());
  const auto is_out = [&](const PassingMember& member) {
    return (member.place - here).norm() >= *first_out;
  };
  members.erase(std::remove_if(members.begin(), members.end(), is_out), members.end());
}

}  // namespace

PassingPolicy::PassingPolicy(std::string name, int priority, RobotModel robot,
                             const PlannerOptions& options)
    : name_(std::move(name)),
      priority_(priority),
      robot_(std::move(robot)),
      travel_(homotopy_path_options(robot_, options).travel) {}

void PassingPolicy::set_options(const PlannerOptions& options) {
  travel_ = homotopy_path_options(robot_, options).travel;
}

void PassingPolicy::begin_goal() {
  leave_order();
  offered_.reset();
  led_.reset();
  finished_ = PassingOrderId();
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
  for (auto it = heard_.begin(); it != heard_.end();)
    it = now_s < it->second.time_s + kLapse_s ? std::next(it) : heard_.erase(it);
  const bool has_room = heard_.size() < kMostHeard || heard_.count(intent.agent) > 0;
  if (intent.agent == name_ || !has_room) return;
  Heard& heard = heard_.try_emplace(intent.agent, Heard{intent, now_s}).first->second;
  if (intent.calls || is_news(heard.intent, intent)) news_s_ = now_s;
  heard = {intent, now_s};
  if (led_ && intent.follows == led_->id) {
    std::uint32_t& moves = led_->promised[intent.agent];
    moves = std::max(moves, intent.moves);
  }
}

/// Of a new order the first part, with which the robot can begin; or more of what it follows.
void PassingPolicy::follow(const PassingInstruction& instruction) {
  if (followed_ && followed_->id() == instruction.id) {
    followed_->add(instruction);
    return;
  }
  const bool is_late =
      instruction.id.leader == newest_.leader && instruction.id.number < newest_.number;
  if (instruction.first != 0 || is_late) return;
  newest_ = instruction.id;
  offered_ = instruction;
}

std::vector<PassingIntent> PassingPolicy::others(double now_s) const {
  std::vector<PassingIntent> fresh;
  for (const auto& [name, heard] : heard_) {
    if (now_s < heard.time_s + kLapse_s) fresh.push_back(heard.intent);
  }
  return fresh;
}

bool PassingPolicy::somebody_calls(double now_s) const {
  const auto fresh = others(now_s);
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
void PassingPolicy::note_promised() {
  for (const std::string& robot : followed_->robots()) {
    const auto found = heard_.find(robot);
    if (found == heard_.end() || found->second.intent.follows != followed_->id()) continue;
    std::uint32_t& moves = promised_[robot];
    moves = std::max(moves, found->second.intent.moves);
  }
}

// --- what the robot does ---

std::vector<PassingMessage> PassingPolicy::step(const PassingSituation& situation,
                                                const SceneSource& scene) {
  const double now_s = situation.now_s;
  progress(situation);
  watch(situation, scene);
  std::vector<PassingMessage> messages;
  if (leads(now_s)) lead(situation, scene({situation.measured.pose.position}));
  const PassingIntent now = intent(situation);
  const bool takes_part = calls_ || follows() || somebody_calls(now_s);
  if (!takes_part || (!is_news(said_, now) && now_s < said_s_ + kSayAgain_s)) return messages;
  said_ = now;
  said_s_ = now_s;
  say_instructions(now_s, messages);
  messages.emplace_back(now);
  return messages;
}

/// Takes up a new order where it comes to rest at its beginning, and gets on with it.
void PassingPolicy::progress(const PassingSituation& situation) {
  const Vector2 rest = situation.committed.end_pose().position;
  if (offered_) {
    FollowedOrder order(*offered_);
    const auto start = order.start();
    if (order.is_over() || (start && (*start - rest).norm() < kAtPlace_m)) {
      leave_order();
      if (led_ && led_->id != order.id()) led_.reset();
      followed_ = std::move(order);
      finished_ = PassingOrderId();
      calls_ = false;
      progressed_s_ = situation.now_s;
    }
    offered_.reset();
  }
  if (!followed_) return;
  note_promised();
  followed_->note_promise(situation.committed);
  if (stands(situation.measured))
    followed_->note_stand(situation.measured.pose.position, kAtPlace_m);
  stretch_ = followed_->grant([this](const std::string& name) { return promised_by(name); });
  std::uint32_t moves = 0;
  for (const std::string& robot : followed_->robots()) moves += promised_by(robot);
  if (moves != seen_moves_ || !stands(situation.measured)) progressed_s_ = situation.now_s;
  seen_moves_ = moves;
  if (!followed_->is_over()) return;
  finished_ = followed_->id();
  finished_moves_ = followed_->promised();
  news_s_ = situation.now_s;
  leave_order();
}

bool PassingPolicy::is_stuck(const PassingSituation& situation) const {
  return follows() && situation.now_s > progressed_s_ + (stretch_ ? kStuck_s : kForgotten_s);
}

void PassingPolicy::watch(const PassingSituation& situation, const SceneSource& scene) {
  const bool called = calls_;
  if (is_stuck(situation)) {
    leave_order();
    calls_until_s_ = situation.now_s + kMakeAgain_s;
  }
  const Vector2& here = situation.measured.pose.position;
  calls_ =
      !follows() && situation.goal &&
      (situation.now_s < calls_until_s_ ||
       impediment_.is_impeded(stands(situation.measured), here, *situation.goal,
                              scene({here, *situation.goal}), robot_, travel_, situation.now_s));
  if (calls_ && !called) calls_since_s_ = situation.now_s;
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
  return intent;
}

// --- what the caller of the highest rank does ---

/// Whether a robot that has a part in the order that this one has made does not keep to it.
bool PassingPolicy::is_not_kept(double now_s) const {
  if (!led_) return false;
  const auto fresh = others(now_s);
  return std::any_of(fresh.begin(), fresh.end(), [&](const PassingIntent& intent) {
    const auto found = led_->instructions.find(intent.agent);
    if (found == led_->instructions.end() || intent.follows == led_->id) return false;
    const auto promised = led_->promised.find(intent.agent);
    return found->second.turns > (promised != led_->promised.end() ? promised->second : 0);
  });
}

/// Whether it is to make an order now: others are about, and none of them that calls
/// outranks it.
bool PassingPolicy::leads(double now_s) const {
  const bool is_asked = calls_ && now_s >= calls_since_s_ + kGather_s;
  if (!is_asked && !is_not_kept(now_s)) return false;
  if (led_ && now_s < led_->made_s + kMakeAgain_s) return false;
  PassingIntent own;
  own.agent = name_;
  own.priority = priority_;
  const auto fresh = others(now_s);
  const bool is_outranked =
      std::any_of(fresh.begin(), fresh.end(),
                  [&](const PassingIntent& other) { return other.calls && outranks(other, own); });
  return !fresh.empty() && !is_outranked;
}

void PassingPolicy::lead(const PassingSituation& situation, const PlanningScene& scene) {
  std::vector<PassingIntent> intents = others(situation.now_s);
  intents.push_back(intent(situation));
  std::sort(intents.begin(), intents.end(), outranks);
  std::vector<PassingMember> members;
  double radius_m = 0.0;
  std::vector<BlockedDisc> blocked;
  for (const PassingIntent& member : intents) {
    const auto peer = std::find_if(scene.peers.begin(), scene.peers.end(),
                                   [&](const auto& each) { return each->name() == member.agent; });
    const bool is_own = member.agent == name_;
    if (!is_own && peer == scene.peers.end()) continue;
    const Vector2 place = is_own ? situation.committed.end_pose().position : rest_place(**peer);
    members.push_back({member.agent, place, member.goal});
    radius_m = std::max(radius_m, member.radius_m);
  }
  keep_nearest(situation.measured.pose.position, members);
  for (const auto& peer : scene.peers) {
    const bool is_member =
        std::any_of(members.begin(), members.end(),
                    [&](const PassingMember& member) { return member.name == peer->name(); });
    if (!is_member) blocked.push_back(peer_keep_out(*peer, peer->rest_time(), robot_, 0.0));
  }
  // Counts on over a restart.
  number_ = std::max(number_ + 1, static_cast<std::uint32_t>(std::fmod(situation.now_s, 1e9)));
  led_ = Led{{name_, 0, number_}, {}, {}, situation.now_s};
  const double apart_m = radius_m + distance_to_peers_m(robot_) + kSpare_m;
  const auto unseen = scene.unseen ? scene.unseen() : nullptr;
  const auto group = order_group({*scene.static_map, std::move(blocked), unseen.get()}, members,
                                 {travel_, apart_m},
                                 {robot_.limits.max_speed, robot_.limits.max_acceleration,
                                  robot_.limits.max_yaw_rate, kHandover_s});
  if (!group) return;
  std::vector<std::string> names;
  for (const PassingMember& member : members) names.push_back(member.name);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const auto turns = static_cast<std::uint32_t>(group->order[i].size());
    led_->instructions[names[i]] = {led_->id, names[i], names, turns, 0, group->order[i]};
  }
  offered_ = quantised(led_->instructions[name_]);
  said_s_ = -std::numeric_limits<double>::infinity();
}

/// Again and again to whoever does not keep to it yet, or has more to be told of it; and to its own
/// robot, for people to see. An order that no datagram holds is void.
void PassingPolicy::say_instructions(double now_s, std::vector<PassingMessage>& messages) {
  if (!led_) return;
  const bool may_be_late = now_s > led_->made_s + kMakeAgain_s;
  try {
    for (const auto& [robot, whole] : led_->instructions) {
      const auto found = heard_.find(robot);
      const bool is_own = robot == name_;
      if (!is_own && (found == heard_.end() || now_s > found->second.time_s + kLapse_s)) continue;
      const bool keeps = is_own || found->second.intent.follows == led_->id;
      const std::uint32_t first = is_own ? 0 : keeps ? found->second.intent.moves : 0;
      if ((keeps && first >= whole.turns) || (!keeps && may_be_late)) continue;
      messages.emplace_back(fitting_part(whole, first));
    }
  } catch (const std::invalid_argument&) {
    led_->instructions.clear();
  }
}

}  // namespace mocha
