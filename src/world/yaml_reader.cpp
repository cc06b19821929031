#include "world/yaml_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "world/world_file.h"

namespace mocha {
namespace {

constexpr std::size_t kLongestQuote = 80;  // characters of a refused value that an error repeats

/// The value in one line, shortened.
std::string quoted(const YAML::Node& node) {
  YAML::Emitter out;
  out << YAML::Flow << node;
  std::string text = node.IsScalar() ? node.Scalar() : out.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() <= kLongestQuote ? text : text.substr(0, kLongestQuote) + "...";
}

template <typename T>
T parse(const YamlReader& reader, const YAML::Node& node, const std::string& expected) {
  T value{};
  if (!node.IsScalar() || !YAML::convert<T>::decode(node, value)) reader.refuse(expected);
  return value;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

YamlReader::YamlReader(std::string file, std::string key, YAML::Node node)
    : file_(std::move(file)), key_(std::move(key)), node_(std::move(node)) {}

YamlReader YamlReader::file(const std::string& path) {
  const std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw WorldError(path + ": cannot be read");
  return document(text.str(), path);
}

YamlReader YamlReader::document(const std::string& text, const std::string& source) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw WorldError(source + ": is not valid YAML: " + one_line(error.what()));
  }
  if (!root.IsMap()) throw WorldError(source + ": is not a map of names to values");
  return YamlReader(source, "", root);
}

void YamlReader::allow_keys(std::initializer_list<const char*> keys) const {
  if (!node_.IsMap()) refuse("expected a map of names to values");
  std::set<std::string> seen;
  for (const auto& item : node_) {
    if (!item.first.IsScalar()) refuse("a key is not a single word");
    const std::string& name = item.first.Scalar();
    const YamlReader entry(file_, key_.empty() ? name : key_ + "." + name, item.second);
    const bool known =
        std::any_of(keys.begin(), keys.end(), [&](const char* k) { return name == k; });
    if (!known) entry.refuse("unknown key");
    if (!seen.insert(name).second) entry.refuse("the key stands twice");
  }
}

bool YamlReader::has(const std::string& key) const { return node_[key].IsDefined(); }

bool YamlReader::is_list_of_lists() const {
  return node_.IsSequence() && (node_.size() == 0 || node_[0].IsSequence());
}

YamlReader YamlReader::at(const std::string& key) const {
  const std::string full = key_.empty() ? key : key_ + "." + key;
  if (!has(key)) throw WorldError(file_ + ": " + full + ": is missing");
  return YamlReader(file_, full, node_[key]);
}

std::vector<YamlReader> YamlReader::items() const {
  if (!node_.IsSequence()) refuse("expected a list");
  std::vector<YamlReader> list;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    list.push_back(YamlReader(file_, key_ + "[" + std::to_string(i) + "]", node_[i]));
  }
  return list;
}

std::vector<YamlReader> YamlReader::items(std::size_t least, std::size_t most) const {
  const std::vector<YamlReader> list = items();
  if (list.size() >= least && list.size() <= most) return list;
  const std::string count =
      least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
  refuse("expected " + count + " values");
}

double YamlReader::number() const {
  const auto value = parse<double>(*this, node_, "expected a number");
  if (!std::isfinite(value)) refuse("is not finite");
  return value;
}

double YamlReader::positive() const {
  const double value = number();
  if (!(value > 0.0)) refuse("must be more than 0");
  return value;
}

double YamlReader::not_negative() const {
  const double value = number();
  if (value < 0.0) refuse("must not be negative");
  return value;
}

bool YamlReader::flag() const { return parse<bool>(*this, node_, "expected true or false"); }

std::string YamlReader::text() const { return parse<std::string>(*this, node_, "expected a word"); }

std::string YamlReader::path() const {
  return std::filesystem::absolute(std::filesystem::path(file_).parent_path() / text());
}

Vector2 YamlReader::point() const {
  const auto values = items(2, 2);
  return {values[0].number(), values[1].number()};
}

std::vector<Vector2> YamlReader::points() const {
  std::vector<Vector2> list;
  for (const YamlReader& item : items()) list.push_back(item.point());
  return list;
}

Polygon YamlReader::polygon() const {
  Polygon polygon{points()};
  auto& corners = polygon.corners;
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  const std::string fault = fault_of(polygon);
  if (!fault.empty()) refuse(fault);
  return polygon;
}

void YamlReader::refuse(const std::string& why) const {
  throw WorldError(file_ + ": " + (key_.empty() ? "" : key_ + " = ") + quoted(node_) + ": " + why);
}

}  // namespace mocha
