#include "world/margin_budget.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mocha {
namespace {

std::vector<std::pair<std::string, double>> contributions(const MarginBudget& budget) {
  return {{"tracking_m", budget.tracking_m},
          {"localisation_m", budget.localisation_m},
          {"map_m", budget.map_m},
          {"clock_s", budget.clock_s},
          {"max_speed_mps", budget.max_speed},
          {"tracking_still_m", budget.tracking_still_m},
          {"map_still_m", budget.map_still_m}};
}

}  // namespace

MarginBudget MarginBudget::of(const RobotModel& robot) {
  const Margins& margins = robot.margins;
  return {margins.tracking_m,     margins.localisation_m,   margins.map_m,      margins.clock_s,
          robot.limits.max_speed, margins.tracking_still_m, margins.map_still_m};
}

void MarginBudget::validate() const {
  for (const auto& [name, value] : contributions(*this)) {
    if (std::isfinite(value) && value >= 0.0) continue;
    std::ostringstream message;
    message << "margin budget: " << name << " = " << value << ": expected a value of at least 0";
    throw std::invalid_argument(message.str());
  }
}

double MarginBudget::peer_margin_m(const MarginBudget& peer) const {
  const double clocks_s = std::max(clock_s, peer.clock_s);
  return tracking_m + localisation_m + peer.tracking_m + peer.localisation_m +
         clocks_s * (max_speed + peer.max_speed);
}

std::vector<std::pair<std::string, double>> MarginBudget::listed() const {
  auto list = contributions(*this);
  list.emplace_back("static_margin_m", static_margin_m());
  list.emplace_back("static_margin_still_m", static_margin().still_m);
  list.emplace_back("peer_margin_m", peer_margin_m());
  return list;
}

}  // namespace mocha
