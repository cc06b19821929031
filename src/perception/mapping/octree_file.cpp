#include "perception/mapping/octree_file.h"

#include <cmath>
#include <cstring>
#include <sstream>

#include "perception/mapping/map_error.h"

namespace mocha {
namespace {

const std::string kMagic = "# Octomap OcTree ";
const std::string kBinaryMark = "binary file";
const std::string kFullMark = "file";
const std::string kTreeType = "OcTree";
constexpr int kDepth = 16;
constexpr float kLargestLogOdds = 100.0F;

/// Walks a serialised tree without building it.
class NodeWalker {
 public:
  NodeWalker(const std::string& bytes, bool binary) : bytes_(bytes), binary_(binary) {}

  /// What is wrong, or nothing.
  std::string fault() {
    const std::string fault = node(0);
    if (!fault.empty()) return fault;
    return at_ == bytes_.size() ? "" : "data after the end of the tree";
  }

 private:
  std::string node(int depth) { return binary_ ? binary_node(depth) : full_node(depth); }

  /// .bt: two bits per child: 01 and 10 are leaves, 11 has children.
  std::string binary_node(int depth) {
    std::uint16_t children = 0;
    if (!read(children)) return "ends in the middle of the tree";
    for (int i = 0; i < 8; ++i) {
      if (((children >> (2 * i)) & 3) != 3) continue;
      if (depth + 1 >= kDepth) return "a tree deeper than 16 levels";
      if (std::string fault = node(depth + 1); !fault.empty()) return fault;
    }
    return {};
  }

  /// .ot: log-odds, then one bit per child.
  std::string full_node(int depth) {
    float log_odds = 0.0F;
    std::uint8_t children = 0;
    if (!read(log_odds) || !read(children)) return "ends in the middle of the tree";
    if (!(std::abs(log_odds) <= kLargestLogOdds)) return "log-odds that are no number";
    for (int i = 0; i < 8; ++i) {
      if (((children >> i) & 1) == 0) continue;
      if (depth >= kDepth) return "a tree deeper than 16 levels";
      if (std::string fault = node(depth + 1); !fault.empty()) return fault;
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
  file.resolution_m = 0.0;
  while (true) {
    if (!std::getline(in, line)) throw fail("has no data");
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "data") break;
    if (key == "id") words >> type;
    if (key == "size") words >> size;
    if (key == "res") words >> file.resolution_m;
  }
  if (type != kTreeType) throw fail("holds a tree of type '" + type + "', not OcTree");
  if (!(file.resolution_m > 0.0) || !std::isfinite(file.resolution_m)) {
    throw fail("has no valid resolution");
  }
  if (!(size >= 0.0)) throw fail("has no valid size");
  if (size == 0.0) return file;
  file.nodes = bytes.substr(static_cast<std::size_t>(in.tellg()));
  const std::string fault = NodeWalker(file.nodes, file.binary).fault();
  if (!fault.empty()) throw fail(fault);
  return file;
}

std::string octree_header(bool binary, std::size_t nodes, double resolution_m) {
  std::ostringstream header;
  header << kMagic << (binary ? kBinaryMark : kFullMark) << "\nid " << kTreeType << "\nsize "
         << nodes << "\nres " << resolution_m << "\ndata\n";
  return header.str();
}

}  // namespace mocha
