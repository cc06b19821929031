#include "perception/mapping/octree_file.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <utility>

#include "perception/mapping/map_error.h"

namespace mocha {
namespace {

const std::string kMagic = "# Octomap OcTree ";
const std::string kBinaryMark = "binary file";
const std::string kFullMark = "file";
const std::string kTreeType = "OcTree";
constexpr int kDepth = 16;
constexpr int kLowest = -(1 << (kDepth - 1));  // index of a voxel
constexpr float kLargestLogOdds = 100.0F;
constexpr double kLeastResolution_m = 1e-3;
constexpr double kMostResolution_m = 1e3;

/// Walks a serialised tree without building it.
class NodeWalker {
 public:
  using Visit = std::function<void(const OctreeLeaf&)>;

  NodeWalker(const OctreeFile& file, float free, float occupied, Visit visit)
      : bytes_(file.nodes),
        binary_(file.binary),
        free_(free),
        occupied_(occupied),
        visit_(std::move(visit)) {}

  /// What is wrong, or nothing.
  std::string fault() {
    const std::string fault = node({{kLowest, kLowest, kLowest}, 1 << kDepth, 0.0f}, 0);
    if (!fault.empty()) return fault;
    return at_ == bytes_.size() ? "" : "data after the end of the tree";
  }

 private:
  std::string node(const OctreeLeaf& cube, int depth) {
    return binary_ ? binary_node(cube, depth) : full_node(cube, depth);
  }

  static OctreeLeaf child(const OctreeLeaf& cube, int i) {
    OctreeLeaf part = cube;
    part.size /= 2;
    for (int axis = 0; axis < 3; ++axis) part.low[axis] += ((i >> axis) & 1) * part.size;
    return part;
  }

  /// .bt: two bits per child: 01 is a free leaf, 10 an occupied one, 11 has children.
  std::string binary_node(const OctreeLeaf& cube, int depth) {
    std::uint16_t children = 0;
    if (!read(children)) return "ends in the middle of the tree";
    for (int i = 0; i < 8; ++i) {
      const int kind = (children >> (2 * i)) & 3;
      if (kind == 0) continue;
      OctreeLeaf part = child(cube, i);
      if (kind != 3) {
        part.log_odds = kind == 1 ? free_ : occupied_;
        visit_(part);
        continue;
      }
      if (depth + 1 >= kDepth) return "a tree deeper than 16 levels";
      if (std::string fault = node(part, depth + 1); !fault.empty()) return fault;
    }
    return {};
  }

  /// .ot: log-odds, then one bit per child.
  std::string full_node(OctreeLeaf cube, int depth) {
    std::uint8_t children = 0;
    if (!read(cube.log_odds) || !read(children)) return "ends in the middle of the tree";
    if (!(std::abs(cube.log_odds) <= kLargestLogOdds)) return "log-odds that are no number";
    if (children == 0) visit_(cube);
    for (int i = 0; i < 8; ++i) {
      if (((children >> i) & 1) == 0) continue;
      if (depth >= kDepth) return "a tree deeper than 16 levels";
      if (std::string fault = node(child(cube, i), depth + 1); !fault.empty()) return fault;
    }
    return {};
  }

  template <class T>
  bool read(T& value) {
    if (bytes_.size() - at_ < sizeof(value)) return false;
    std::memcpy(&value, bytes_.data() + at_, sizeof(value));
    at_ += sizeof(value);
    return true;
  }

  const std::string& bytes_;
  bool binary_;
  float free_;
  float occupied_;
  Visit visit_;
  std::size_t at_ = 0;
};

}  // namespace

OctreeFile parse_octree_file(const std::string& bytes, const std::string& path) {
  const auto fail = [&](const std::string& reason) { return MapError(path + ": " + reason); };
  std::istringstream in(bytes);
  std::string line;
  std::getline(in, line);
  OctreeFile file;
  file.binary = line.rfind(kMagic + kBinaryMark, 0) == 0;
  if (!file.binary && line.rfind(kMagic + kFullMark, 0) != 0) {
    throw fail("is not an OctoMap file (.bt or .ot)");
  }
  std::string type;
  double size = -1.0;
  std::string resolution;
  while (true) {
    if (!std::getline(in, line)) throw fail("has no data");
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "data") break;
    if (key == "id") words >> type;
    if (key == "size") words >> size;
    if (key == "res") words >> resolution;
  }
  if (type != kTreeType) throw fail("holds a tree of type '" + type + "', not OcTree");
  file.resolution_m = 0.0;  // stays where there is nothing to read
  std::istringstream(resolution) >> file.resolution_m;
  if (!(file.resolution_m >= kLeastResolution_m && file.resolution_m <= kMostResolution_m))
    throw fail("resolution '" + resolution + "': expected a value from 0.001 to 1000 (m)");
  if (!(size >= 0.0)) throw fail("has no valid size");
  if (size == 0.0) return file;
  file.nodes = bytes.substr(static_cast<std::size_t>(in.tellg()));
  const std::string fault = NodeWalker(file, 0.0f, 0.0f, [](const OctreeLeaf&) {}).fault();
  if (!fault.empty()) throw fail(fault);
  return file;
}

void for_each_leaf(const OctreeFile& file, float free, float occupied,
                   const std::function<void(const OctreeLeaf&)>& visit) {
  if (!file.nodes.empty()) NodeWalker(file, free, occupied, visit).fault();
}

std::string octree_header(bool binary, std::size_t nodes, double resolution_m) {
  std::ostringstream header;
  header << kMagic << (binary ? kBinaryMark : kFullMark) << "\nid " << kTreeType << "\nsize "
         << nodes << "\nres " << resolution_m << "\ndata\n";
  return header.str();
}

}  // namespace mocha
