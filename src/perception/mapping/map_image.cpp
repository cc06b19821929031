#include "perception/mapping/map_image.h"

#include <yaml-cpp/yaml.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "perception/mapping/map_error.h"
#include "perception/mapping/png_image.h"

namespace mocha {
namespace {

constexpr double kOccupiedThreshold = 0.65;
constexpr double kFreeThreshold = 0.196;
constexpr unsigned char kOccupiedGrey = 0;
constexpr unsigned char kFreeGrey = 254;
constexpr unsigned char kUnknownGrey = 205;
constexpr double kMostPixels = 64e6;

/// The next number of a PGM header; comments run from # to the end of the line.
int header_number(std::istream& in) {
  std::string comment;
  while (in >> std::ws && in.peek() == '#') std::getline(in, comment);
  int number = -1;
  in >> number;
  return number;
}

GreyImage read_pgm(const std::string& bytes, const std::string& path) {
  std::istringstream in(bytes);
  std::string magic(2, ' ');
  in.read(magic.data(), 2);
  if (magic != "P5") throw MapError(path + ": is neither a binary PGM image (P5) nor a PNG image");
  GreyImage image;
  image.width = header_number(in);
  image.height = header_number(in);
  image.white = header_number(in);
  if (!in || image.width < 1 || image.height < 1 || image.white < 1 || image.white > 255 ||
      static_cast<double>(image.width) * image.height > kMostPixels) {
    throw MapError(path + ": has a PGM header with impossible numbers");
  }
  in.get();
  const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
  const auto begin = static_cast<std::size_t>(in.tellg());
  if (!in || bytes.size() - begin < pixels) {
    throw MapError(path + ": holds fewer pixels than its header says");
  }
  image.pixels = bytes.substr(begin, pixels);
  return image;
}

GreyImage load_image(const std::string& path) {
  const std::string bytes = read_file(path);
  if (!is_png(bytes)) return read_pgm(bytes, path);
  try {
    return read_png(bytes, kMostPixels);
  } catch (const std::exception& error) {
    throw MapError(path + ": " + error.what());
  }
}

struct Description {
  std::string image;
  double resolution_m;
  Vector2 origin;
  bool negate;
  double occupied_threshold;
  double free_threshold;
};

Description read_description(const std::string& path) {
  Description description;
  try {
    const YAML::Node map = YAML::Load(read_file(path));
    if (!map.IsMap()) throw MapError(path + ": is not a YAML map");
    for (const char* key :
         {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) {
      if (!map[key]) throw MapError(path + ": the key '" + key + "' is missing");
    }
    if (map["mode"] && map["mode"].as<std::string>() != "trinary") {
      throw MapError(path + ": mode: only trinary maps can be read");
    }
    const auto origin = map["origin"].as<std::vector<double>>();
    if (origin.size() != 3 || !std::isfinite(origin[0]) || !std::isfinite(origin[1])) {
      throw MapError(path + ": origin must be [x, y, yaw]");
    }
    if (origin[2] != 0.0) throw MapError(path + ": origin: a rotated map cannot be read");
    description = {map["image"].as<std::string>(),      map["resolution"].as<double>(),
                   Vector2(origin[0], origin[1]),       map["negate"].as<int>() != 0,
                   map["occupied_thresh"].as<double>(), map["free_thresh"].as<double>()};
  } catch (const YAML::Exception& error) {
    throw MapError(path + ": " + error.what());
  }
  if (!(description.resolution_m > 0.0) || !std::isfinite(description.resolution_m)) {
    throw MapError(path + ": resolution must be above 0 m");
  }
  if (!(description.free_threshold < description.occupied_threshold)) {
    throw MapError(path + ": free_thresh must be below occupied_thresh");
  }
  return description;
}

}  // namespace

std::string read_file(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (!file || !(bytes << file.rdbuf())) {
    if (errno == 0) throw MapError(path + ": is empty");
    throw MapError(path + ": cannot be read (" + std::strerror(errno) + ")");
  }
  return bytes.str();
}

void write_file(const std::string& path, const std::string& bytes) {
  const std::string part = path + ".part";
  errno = 0;
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  file << bytes;
  file.close();
  if (!file || std::rename(part.c_str(), path.c_str()) != 0) {
    const std::string reason = std::strerror(errno);
    std::remove(part.c_str());
    throw MapError(path + ": cannot be written (" + reason + ")");
  }
}

void save_map_image(const OccupancyGrid& grid, const std::string& yaml_path) {
  if (grid.cells.empty()) throw MapError(yaml_path + ": nothing has been mapped yet");
  const std::filesystem::path image = std::filesystem::path(yaml_path).replace_extension(".pgm");
  std::string pgm =
      "P5\n" + std::to_string(grid.width) + " " + std::to_string(grid.height) + "\n255\n";
  for (int y = grid.height - 1; y >= 0; --y) {
    for (int x = 0; x < grid.width; ++x) {
      const int8_t cell = grid.at(x, y);
      pgm += static_cast<char>(cell == OccupancyGrid::kOccupied ? kOccupiedGrey
                               : cell == OccupancyGrid::kFree   ? kFreeGrey
                                                                : kUnknownGrey);
    }
  }
  write_file(image.string(), pgm);
  YAML::Emitter yaml;
  yaml << YAML::BeginMap << YAML::Key << "image" << YAML::Value << image.filename().string();
  yaml << YAML::Key << "resolution" << YAML::Value << grid.resolution_m;
  yaml << YAML::Key << "origin" << YAML::Value << YAML::Flow << YAML::BeginSeq << grid.origin.x()
       << grid.origin.y() << 0.0 << YAML::EndSeq;
  yaml << YAML::Key << "negate" << YAML::Value << 0;
  yaml << YAML::Key << "occupied_thresh" << YAML::Value << kOccupiedThreshold;
  yaml << YAML::Key << "free_thresh" << YAML::Value << kFreeThreshold << YAML::EndMap;
  write_file(yaml_path, std::string(yaml.c_str()) + "\n");
}

OccupancyGrid load_map_image(const std::string& yaml_path) {
  const Description description = read_description(yaml_path);
  const std::filesystem::path image_path =
      std::filesystem::path(yaml_path).parent_path() / description.image;
  const GreyImage image = load_image(image_path.string());
  OccupancyGrid grid;
  grid.resolution_m = description.resolution_m;
  grid.origin = description.origin;
  grid.width = image.width;
  grid.height = image.height;
  grid.cells.reserve(image.pixels.size());
  for (int y = 0; y < grid.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(grid.height - 1 - y) * grid.width;
    for (int x = 0; x < grid.width; ++x) {
      const double grey =
          static_cast<unsigned char>(image.pixels[row + x]) / static_cast<double>(image.white);
      const double occupancy = description.negate ? grey : 1.0 - grey;
      const bool is_there = image.opaque.empty() || image.opaque[row + x] != 0;
      grid.cells.push_back(!is_there                                    ? OccupancyGrid::kUnknown
                           : occupancy > description.occupied_threshold ? OccupancyGrid::kOccupied
                           : occupancy < description.free_threshold     ? OccupancyGrid::kFree
                                                                        : OccupancyGrid::kUnknown);
    }
  }
  return grid;
}

Vector2 move_to_lattice(OccupancyGrid& grid) {
  const Vector2 origin = grid.resolution_m * (grid.origin / grid.resolution_m).array().round();
  const Vector2 shift = origin - grid.origin;
  grid.origin = origin;
  return shift;
}

}  // namespace mocha
