#pragma once

#include <string>
#include <vector>

#include "world/obstacle.h"
#include "world/yaml_reader.h"

namespace mocha {

/// Ground with a rule of its own. Map frame.
struct Zone {
  std::string name;
  Polygon area;
  double max_speed = 0.0;  ///< [m/s] over it; 0: it is not to be entered

  bool keeps_out() const { return max_speed == 0.0; }
};

using Zones = std::vector<Zone>;

/// Throws std::invalid_argument, naming the zone and what is wrong, for areas that are no simple
/// polygons, for speeds that are negative or not finite, and for a name that stands twice.
void check(const Zones& zones);

/// The areas that are not to be entered.
std::vector<Polygon> kept_out_of(const Zones& zones);

/// The zone that is not to be entered and holds the place; null if there is none.
const Zone* keep_out_zone_at(const Zones& zones, const Vector2& place);

/// What stands under `keep_out` (polygons, or maps of `name` and `polygon`) and `speed_zones` (maps
/// of `name`, `polygon` and `max_speed`); zones without a name are named after their place there.
/// Throws WorldError.
Zones read_zones(const YamlReader& reader);

/// Of a YAML file with these two keys; all else that a world file holds is passed over. Throws
/// WorldError.
Zones load_zones(const std::string& path);

/// As load_zones() reads it, and back; `source` names the text in errors.
std::string to_yaml(const Zones& zones);
Zones parse_zones(const std::string& text, const std::string& source);

}  // namespace mocha
