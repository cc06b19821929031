#include "world/zones.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include "world/world_file.h"

namespace mocha {
namespace {

std::string place_in(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

std::string name_of(const YamlReader& reader, const std::string& otherwise) {
  return reader.has("name") ? reader.at("name").text() : otherwise;
}

Zone read_keep_out(const YamlReader& reader, const std::string& otherwise) {
  if (reader.is_list_of_lists()) return {otherwise, reader.polygon()};
  reader.allow_keys({"name", "polygon"});
  return {name_of(reader, otherwise), reader.at("polygon").polygon()};
}

Zone read_speed_zone(const YamlReader& reader, const std::string& otherwise) {
  reader.allow_keys({"name", "polygon", "max_speed"});
  return {name_of(reader, otherwise), reader.at("polygon").polygon(),
          reader.at("max_speed").positive()};
}

template <typename Read>
void add(const YamlReader& reader, const char* list, Read read, Zones& zones) {
  if (!reader.has(list)) return;
  const auto items = reader.at(list).items();
  for (std::size_t i = 0; i < items.size(); ++i) zones.push_back(read(items[i], place_in(list, i)));
}

YAML::Node to_node(const Zone& zone) {
  YAML::Node node;
  node["name"] = zone.name;
  for (const Vector2& corner : zone.area.corners) {
    YAML::Node point;
    point.push_back(corner.x());
    point.push_back(corner.y());
    node["polygon"].push_back(point);
  }
  if (!zone.keeps_out()) node["max_speed"] = zone.max_speed;
  return node;
}

}  // namespace

void check(const Zones& zones) {
  std::set<std::string> names;
  for (const Zone& zone : zones) {
    const std::string fault = fault_of(zone.area);
    if (!fault.empty()) throw std::invalid_argument("zone `" + zone.name + "`: " + fault);
    if (!std::isfinite(zone.max_speed) || zone.max_speed < 0.0) {
      throw std::invalid_argument("zone `" + zone.name +
                                  "`: max_speed = " + std::to_string(zone.max_speed) +
                                  " m/s: must be 0 (keep out) or more, and finite");
    }
    if (!names.insert(zone.name).second)
      throw std::invalid_argument("zone `" + zone.name + "`: two zones have this name");
  }
}

std::vector<Polygon> kept_out_of(const Zones& zones) {
  std::vector<Polygon> areas;
  for (const Zone& zone : zones) {
    if (zone.keeps_out()) areas.push_back(zone.area);
  }
  return areas;
}

const Zone* keep_out_zone_at(const Zones& zones, const Vector2& place) {
  for (const Zone& zone : zones) {
    if (zone.keeps_out() && gap(place, zone.area).distance_m <= 0.0) return &zone;
  }
  return nullptr;
}

Zones read_zones(const YamlReader& reader) {
  Zones zones;
  add(reader, "keep_out", read_keep_out, zones);
  add(reader, "speed_zones", read_speed_zone, zones);
  try {
    check(zones);
  } catch (const std::invalid_argument& error) {
    reader.refuse(error.what());
  }
  return zones;
}

Zones load_zones(const std::string& path) {
  const YamlReader reader = YamlReader::file(path);
  reader.allow_keys(kWorldKeys);
  return read_zones(reader);
}

std::string to_yaml(const Zones& zones) {
  YAML::Node node(YAML::NodeType::Map);
  for (const Zone& zone : zones)
    node[zone.keeps_out() ? "keep_out" : "speed_zones"].push_back(to_node(zone));
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << node;
  return out.c_str();
}

Zones parse_zones(const std::string& text, const std::string& source) {
  const YamlReader reader = YamlReader::document(text, source);
  reader.allow_keys({"keep_out", "speed_zones"});
  return read_zones(reader);
}

}  // namespace mocha
