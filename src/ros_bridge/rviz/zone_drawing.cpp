#include "ros_bridge/rviz/zone_drawing.h"

#include <cstdio>

namespace mocha {
namespace {

constexpr double kOutline_m = 0.06;
constexpr double kNameHeight_m = 0.25;
const std_msgs::ColorRGBA kKeepOutColor = color(0.9, 0.2, 0.2, 0.9);
const std_msgs::ColorRGBA kSpeedColor = color(0.95, 0.7, 0.1, 0.9);
const std_msgs::ColorRGBA kExitColor = color(0.1, 0.6, 0.2, 0.9);

std::string label(const Zone& zone) {
  if (zone.keeps_out()) return zone.name;
  char speed[32];
  std::snprintf(speed, sizeof(speed), ": %.2g m/s", zone.max_speed);
  return zone.name + speed;
}

Vector2 centre(const Polygon& area) {
  Vector2 sum = Vector2::Zero();
  for (const Vector2& corner : area.corners) sum += corner;
  return sum / static_cast<double>(area.corners.size());
}

}  // namespace

void draw_zones(const Zones& zones, const std::vector<Vector2>& exit, Drawing& drawing) {
  for (const Zone& zone : zones) {
    const std_msgs::ColorRGBA& color = zone.keeps_out() ? kKeepOutColor : kSpeedColor;
    std::vector<Vector2> outline = zone.area.corners;
    outline.push_back(outline.front());
    drawing.add_line(zone.keeps_out() ? "keep-out zones" : "speed zones", outline, kOutline_m,
                     color, false);
    drawing.add_label("names of zones", label(zone), centre(zone.area), kNameHeight_m, color);
  }
  if (exit.size() > 1) drawing.add_line("way out", evenly(exit), kOutline_m, kExitColor, true);
}

}  // namespace mocha
