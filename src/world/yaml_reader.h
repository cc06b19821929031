#pragma once

#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// A value in a YAML file together with where it stands, so that every refusal names file, key and
/// value. Whatever does not hold what is asked for throws WorldError.
class YamlReader {
 public:
  /// The whole file, which must be a map.
  static YamlReader file(const std::string& path);
  /// The same of a text; `source` stands for the file in errors.
  static YamlReader document(const std::string& text, const std::string& source);

  /// Refuses keys that are not listed, or stand twice, and anything that is not a map.
  void allow_keys(std::initializer_list<const char*> keys) const;

  bool has(const std::string& key) const;
  bool is_list_of_lists() const;                ///< or an empty list
  YamlReader at(const std::string& key) const;  ///< must exist
  std::vector<YamlReader> items() const;        ///< of a list
  std::vector<YamlReader> items(std::size_t least, std::size_t most) const;

  double number() const;  ///< finite
  double positive() const;
  double not_negative() const;
  bool flag() const;
  std::string text() const;
  std::string path() const;             ///< of a file; relative ones begin where this file is
  Vector2 point() const;                ///< [x, y]
  std::vector<Vector2> points() const;  ///< [[x, y], ...]
  /// A simple one. A last corner that repeats the first only says that it is closed, which all are.
  Polygon polygon() const;

  /// Throws WorldError: "<file>: <key> = <value>: <why>".
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  YamlReader(std::string file, std::string key, YAML::Node node);

  std::string file_;
  std::string key_;
  YAML::Node node_;
};

}  // namespace mocha
