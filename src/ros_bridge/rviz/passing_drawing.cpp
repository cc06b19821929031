#include "ros_bridge/rviz/passing_drawing.h"

#include <algorithm>
#include <utility>

namespace mocha {
namespace {

constexpr double kBroad_m = 0.12;
constexpr double kThin_m = 0.03;
constexpr double kPlace_m = 0.15;
constexpr double kTurnTextHeight_m = 0.25;
const std_msgs::ColorRGBA kColor = color(0.9, 0.45, 0.0, 0.7);
const std_msgs::ColorRGBA kObstacleColor = color(0.9, 0.0, 0.0, 0.9);

}  // namespace

PassingDrawing::PassingDrawing(std::string robot) : robot_(std::move(robot)) {}

void PassingDrawing::note(const PassingMessage& message) {
  std::visit([this](const auto& each) { note(each); }, message);
}

void PassingDrawing::note(const PassingIntent& intent) {
  if (intent.agent == robot_) obstacles_ = intent.obstacles;
  if (intent.agent == robot_ && intent.follows != followed_.id) {
    followed_ = intent.follows == offered_.id ? std::exchange(offered_, {}) : Order();
    promised_.clear();
  }
  const std::vector<std::string>& robots = followed_.robots;
  if (intent.follows == followed_.id &&
      std::find(robots.begin(), robots.end(), intent.agent) != robots.end())
    promised_[intent.agent] = intent.moves;
}

void PassingDrawing::note(const PassingInstruction& instruction) {
  if (instruction.robot != robot_) return;
  Order& order = instruction.id == followed_.id ? followed_ : offered_;
  if (order.id != instruction.id) order = {instruction.id, instruction.robots, {}};
  if (order.robots != instruction.robots) return;  // turns name them by their index
  for (std::uint32_t i = 0; i < instruction.part.size(); ++i)
    order.turns[instruction.first + i] = instruction.part[i];
}

bool PassingDrawing::may_make(const PassingTurn& turn) const {
  return std::all_of(turn.after.begin(), turn.after.end(), [this](const PassingProgress& other) {
    const auto found = promised_.find(followed_.robots[other.robot]);
    return found != promised_.end() && found->second >= other.moves;
  });
}

void PassingDrawing::draw(Drawing& drawing) const {
  for (const Vector2& obstacle : obstacles_)
    drawing.add_square("obstacles", obstacle, kPlace_m, kObstacleColor);
  const auto own = promised_.find(robot_);
  const std::uint32_t promised = own != promised_.end() ? own->second : 0;
  bool permitted = true;
  for (auto it = followed_.turns.lower_bound(std::max(promised, 1U) - 1);
       it != followed_.turns.end(); ++it) {
    const auto& [number, turn] = *it;
    if (number >= promised) permitted = permitted && may_make(turn);
    drawing.add_line("turns", turn.path, permitted ? kBroad_m : kThin_m, kColor, false);
    drawing.add_square("places", turn.path.back(), kPlace_m, kColor);
    drawing.add_label("numbers", std::to_string(number + 1), turn.path.back(), kTurnTextHeight_m,
                      kColor);
  }
}

}  // namespace mocha
