#include "perception/pose_graph/graph_file.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <sstream>

#include "perception/mapping/map_image.h"

namespace mocha {
namespace {

constexpr double kMostBeams = 100000.0;  // of a scan
constexpr const char* kDoubtful = "DOUBTFUL";

void write(std::ostream& out, const Pose& pose) {
  out << ' ' << pose.position.x() << ' ' << pose.position.y() << ' ' << pose.yaw_rad;
}

void write(std::ostream& out, const ScanKeyframe& keyframe) {
  const ScanHits& scan = keyframe.scan;
  out << "KEYFRAME " << scan.time_s;
  write(out, keyframe.odometry);
  out << ' ' << scan.sensor.x() << ' ' << scan.sensor.y();
  for (const std::vector<Vector2>* ends : {&scan.hits, &scan.misses}) {
    out << ' ' << ends->size();
    for (const Vector2& end : *ends)  // to the millimetre
      out << ' ' << std::round(1e3 * end.x()) / 1e3 << ' ' << std::round(1e3 * end.y()) / 1e3;
  }
  out << '\n';
}

/// Reads line after line; what is not as it should be is an error that names the line.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), in_(read_file(path)) {}

  DrivenMap read() {
    std::string text;
    while (std::getline(in_, text)) {
      ++line_;
      words_ = std::istringstream(text);
      std::string kind;
      if (!(words_ >> kind) || kind[0] == '#') continue;
      if (kind == "VERTEX_SE2") {
        read_vertex();
      } else if (kind == "KEYFRAME") {
        read_keyframe();
      } else if (kind == "EDGE_SE2") {
        read_edge();
      } else {
        refuse("begins with neither VERTEX_SE2, KEYFRAME nor EDGE_SE2");
      }
      std::string rest;
      require(!(words_ >> rest), "has more than it should have");
    }
    require(static_cast<int>(map_.keyframes.size()) == map_.graph.size(),
            "is the last, and a vertex has no keyframe");
    return std::move(map_);
  }

 private:
  [[noreturn]] void refuse(const char* what) const {
    throw MapError(path_ + ": line " + std::to_string(line_) + " " + what);
  }
  void require(bool holds, const char* what) const {
    if (!holds) refuse(what);
  }

  double number() {
    double value = 0.0;
    require(static_cast<bool>(words_ >> value) && std::isfinite(value),
            "has something else where a number should be, or ends too early");
    return value;
  }

  Vector2 point() {
    const double x = number();
    return {x, number()};
  }

  Pose pose() {
    const Vector2 position = point();
    const Pose result{position, wrap_angle(number())};
    require(is_usable(position), "has a place that is too far away");
    return result;
  }

  int keyframe() {
    const double value = number();
    require(value >= 0.0 && value < map_.graph.size() && value == std::floor(value),
            "names a vertex that does not stand before it");
    return static_cast<int>(value);
  }

  void read_vertex() {
    require(static_cast<int>(map_.keyframes.size()) == map_.graph.size(),
            "follows a vertex without keyframe");
    require(number() == map_.graph.size(), "has not the next number: vertices count from 0");
    map_.graph.add_keyframe(pose());
  }

  std::vector<Vector2> ends() {
    const double count = number();
    require(count >= 0.0 && count <= kMostBeams, "has an impossible number of beams");
    std::vector<Vector2> result(static_cast<std::size_t>(count));
    for (Vector2& end : result) end = point();
    return result;
  }

  void read_keyframe() {
    require(static_cast<int>(map_.keyframes.size()) == map_.graph.size() - 1,
            "does not follow its vertex");
    ScanKeyframe keyframe;
    keyframe.scan.time_s = number();
    keyframe.odometry = pose();
    keyframe.scan.sensor = point();
    keyframe.scan.hits = ends();
    keyframe.scan.misses = ends();
    try {
      check_measured(keyframe.scan, keyframe.odometry);
    } catch (const std::invalid_argument& error) {
      refuse(error.what());
    }
    map_.keyframes.push_back(std::move(keyframe));
  }

  void read_edge() {
    Constraint edge;
    edge.from = keyframe();
    edge.to = keyframe();
    require(edge.from != edge.to, "connects a vertex to itself");
    edge.relative = pose();
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column)
        edge.information(row, column) = edge.information(column, row) = number();
    }
    require(edge.information.llt().info() == Eigen::Success,
            "has an information matrix that is not positive definite");
    std::string word;
    edge.may_be_wrong = static_cast<bool>(words_ >> word);
    require(word.empty() || word == kDoubtful, "has more than it should have");
    map_.graph.add(edge);
  }

  const std::string path_;
  std::istringstream in_;
  int line_ = 0;
  std::istringstream words_;
  DrivenMap map_;
};

}  // namespace

void save_driven_map(const DrivenMap& map, const std::string& path) {
  std::ostringstream out;
  out.precision(12);
  out << "# VERTEX_SE2 id pose; KEYFRAME time odometry sensor hits x y ... "
         "misses x y ...; EDGE_SE2 from to pose "
         "information\n";
  for (int id = 0; id < map.graph.size(); ++id) {
    out << "VERTEX_SE2 " << id;
    write(out, map.graph.poses()[id]);
    out << '\n';
    write(out, map.keyframes[id]);
  }
  for (const Constraint& edge : map.graph.constraints()) {
    out << "EDGE_SE2 " << edge.from << ' ' << edge.to;
    write(out, edge.relative);
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column) out << ' ' << edge.information(row, column);
    }
    if (edge.may_be_wrong) out << ' ' << kDoubtful;
    out << '\n';
  }
  write_file(path, out.str());
}

DrivenMap load_driven_map(const std::string& path) { return Reader(path).read(); }

}  // namespace mocha
