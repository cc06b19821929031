#include "planning/executive/passing_leader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fleet/wire/passing_parts.h"
#include "planning/candidates/peer_discs.h"
#include "planning/global/front_end.h"
#include "safety/requirement.h"

namespace mocha {
namespace {

constexpr double kMakeAgain_s = 2.0;  // an order that is not kept to
constexpr double kHandover_s = 0.4;   // of moves, about: planning, settling
constexpr std::uint32_t kRecent = 3;  // of numbers, which count seconds
constexpr double kSpare_m = 0.04;     // more than promises keep

/// Where a team-mate will come to rest, by its promise.
Vector2 rest_place(const MovingObstacle& peer) { return peer.at(peer.rest_time()).centre; }

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

/// The least number of an order that is made now: numbers go on over a restart.
std::uint32_t number_at(double now_s) { return static_cast<std::uint32_t>(std::fmod(now_s, 1e9)); }

}  // namespace

bool is_recent(const PassingOrderId& order, double now_s) {
  return order.number + kRecent >= number_at(now_s);
}

PassingLeader::PassingLeader(std::string name, RobotModel robot, const PlannerOptions& options)
    : name_(std::move(name)), robot_(std::move(robot)) {
  set_options(options);
}

void PassingLeader::set_options(const PlannerOptions& options) {
  travel_ = homotopy_path_options(robot_, options).travel;
}

void PassingLeader::retire_for(const PassingOrderId& other) {
  if (order_ && order_->id != other) order_.reset();
}

bool PassingLeader::competes(const PassingOrderId& other, const std::string& robot) const {
  return order_ && other != order_->id && order_->instructions.count(robot) > 0;
}

void PassingLeader::hear(const PassingIntent& intent, double now_s) {
  const bool is_new = obstacles_.note(intent.obstacles, now_s);
  if (!order_) return;
  if (is_new && order_->instructions.count(intent.agent) > 0) order_->is_obstructed = true;
  if (intent.follows != order_->id) return;
  std::uint32_t& moves = order_->promised[intent.agent];
  moves = std::max(moves, intent.moves);
}

bool PassingLeader::is_not_kept(const std::vector<PassingIntent>& heard) const {
  if (!order_) return false;
  return std::any_of(heard.begin(), heard.end(), [&](const PassingIntent& intent) {
    const auto found = order_->instructions.find(intent.agent);
    if (found == order_->instructions.end() || intent.follows == order_->id) return false;
    const auto promised = order_->promised.find(intent.agent);
    return found->second.turns > (promised != order_->promised.end() ? promised->second : 0);
  });
}

bool PassingLeader::may_make_another(double now_s) const {
  return !order_ || order_->is_obstructed || now_s >= order_->made_s + kMakeAgain_s;
}

std::vector<PassingMember> PassingLeader::members_of(const std::vector<PassingIntent>& intents,
                                                     const Vector2& rest,
                                                     const PlanningScene& scene) const {
  std::vector<PassingMember> members;
  for (const PassingIntent& intent : intents) {
    const auto peer = std::find_if(scene.peers.begin(), scene.peers.end(),
                                   [&](const auto& each) { return each->name() == intent.agent; });
    const bool is_own = intent.agent == name_;
    if (!is_own && peer == scene.peers.end()) continue;
    members.push_back({intent.agent, is_own ? rest : rest_place(**peer), intent.goal});
  }
  return members;
}

std::optional<GroupOrder> PassingLeader::order_for(const std::vector<PassingMember>& members,
                                                   double radius_m, const PlanningScene& scene,
                                                   double now_s) const {
  std::vector<BlockedDisc> blocked;
  for (const Vector2& obstacle : obstacles_.all(now_s))
    blocked.push_back({obstacle, travel_.required_clearance_m});
  for (const auto& peer : scene.peers) {
    const bool is_member =
        std::any_of(members.begin(), members.end(),
                    [&](const PassingMember& member) { return member.name == peer->name(); });
    if (!is_member) blocked.push_back(peer_keep_out(*peer, peer->rest_time(), robot_, 0.0));
  }
  const auto unseen = scene.unseen ? scene.unseen() : nullptr;
  const double apart_m = radius_m + distance_to_peers_m(robot_) + kSpare_m;
  return order_group({*scene.static_map, std::move(blocked), unseen.get()}, members,
                     {travel_, apart_m},
                     {robot_.limits.max_speed, robot_.limits.max_acceleration,
                      robot_.limits.max_yaw_rate, robot_.may_back(), kHandover_s});
}

std::optional<PassingInstruction> PassingLeader::make(const std::vector<PassingIntent>& intents,
                                                      const Vector2& here, const Vector2& rest,
                                                      const PlanningScene& scene, double now_s) {
  number_ = std::max(number_ + 1, number_at(now_s));
  order_ = Order{{name_, 0, number_}, {}, {}, now_s};
  std::vector<PassingMember> members = members_of(intents, rest, scene);
  keep_nearest(here, members);
  double radius_m = 0.0;
  for (const PassingIntent& intent : intents) radius_m = std::max(radius_m, intent.radius_m);
  const auto group = order_for(members, radius_m, scene, now_s);
  if (!group) return std::nullopt;
  std::vector<std::string> names;
  for (const PassingMember& member : members) names.push_back(member.name);
  const std::vector<std::uint32_t> alone = alone_from(group->order);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const auto turns = static_cast<std::uint32_t>(group->order[i].size());
    order_->instructions[names[i]] = {order_->id, names[i], names,          turns,
                                      alone[i],   0,        group->order[i]};
  }
  try {
    return quantised(order_->instructions.at(name_));
  } catch (const std::invalid_argument&) {
    order_->instructions.clear();  // places beyond what can be said
    return std::nullopt;
  }
}

void PassingLeader::say(const HeardIntents& heard, double now_s,
                        std::vector<PassingMessage>& messages) {
  if (!order_) return;
  const bool may_be_late = now_s > order_->made_s + kMakeAgain_s;
  try {
    for (const auto& [robot, whole] : order_->instructions) {
      const bool is_own = robot == name_;
      const PassingIntent* said = heard.of(robot, now_s);
      if (!is_own && said == nullptr) continue;
      const bool keeps = is_own || said->follows == order_->id;
      const std::uint32_t first = !is_own && keeps ? said->moves : 0;
      if ((keeps && first >= whole.turns) || (!keeps && may_be_late)) continue;
      messages.emplace_back(fitting_part(whole, first));
    }
  } catch (const std::invalid_argument&) {
    order_->instructions.clear();
  }
}

}  // namespace mocha
