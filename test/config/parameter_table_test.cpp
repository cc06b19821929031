#include "config/parameter_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>

namespace mocha {
namespace {

/// A file with the given contents, gone with the test.
class TextFile {
 public:
  explicit TextFile(const std::string& contents)
      : path_(::testing::TempDir() + "parameter_table_" + std::to_string(++count()) + ".yaml") {
    std::ofstream(path_) << contents;
  }
  ~TextFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  static int& count() {
    static int files = 0;
    return files;
  }
  std::string path_;
};

const char kSchema[] = R"(
speed: {was: velocity, default: 1.0, min: 0.1, max: 2.5, live: true, unit: m/s, about: How fast.}
beams: {default: 360, min: 3, max: 1000, live: true, unit: "-", about: How many.}
enabled: {default: true, live: true, unit: "-", about: Whether.}
shape: {default: disc, choices: [disc, rectangle], live: true, unit: "-", about: What.}
frame: {default: map, live: false, unit: "-", about: Where.}
mass: {gone: "it follows from `beams`"}
code: {default: "12", unit: "-", about: A text that looks like a number.}
)";

ParameterTable table() { return ParameterTable::from_schema(TextFile(kSchema).path()); }

/// The action throws ParameterError, and what() has all of `parts`.
void expect_error(const std::function<void()>& action, std::initializer_list<std::string> parts) {
  try {
    action();
    ADD_FAILURE() << "no error; expected one with " << *parts.begin();
  } catch (const ParameterError& error) {
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "`" << part << "` is not in: " << error.what();
    }
  }
}

void expect_refused(const std::string& values, std::initializer_list<std::string> parts) {
  ParameterTable parameters = table();
  expect_error([&] { parameters.assign(YAML::Load(values), "/ugv1/node"); }, parts);
}

TEST(ParameterTable, HasDefaultsOfTheirTypes) {
  const ParameterTable parameters = table();
  EXPECT_EQ(parameters.number("speed"), 1.0);
  EXPECT_EQ(parameters.integer("beams"), 360);
  EXPECT_TRUE(parameters.flag("enabled"));
  EXPECT_EQ(parameters.text("shape"), "disc");
  EXPECT_EQ(parameters.text("code"), "12");
  EXPECT_EQ(parameters.parameters().size(), 6u);
}

TEST(ParameterTable, AssignsValues) {
  ParameterTable parameters = table();
  parameters.assign(
      YAML::Load("{speed: 2, beams: 7, enabled: false, shape: rectangle, frame: odom}"), "test");
  EXPECT_EQ(parameters.number("speed"), 2.0);  // an integer is a number
  EXPECT_EQ(parameters.integer("beams"), 7);
  EXPECT_FALSE(parameters.flag("enabled"));
  EXPECT_EQ(parameters.text("shape"), "rectangle");
  EXPECT_EQ(parameters.text("frame"), "odom");
  parameters.assign_file(TextFile("speed: 0.5\n").path());
  EXPECT_EQ(parameters.number("speed"), 0.5);
}

TEST(ParameterTable, LimitsThemselvesAreAllowed) {
  ParameterTable parameters = table();
  EXPECT_NO_THROW(parameters.assign(YAML::Load("{speed: 0.1, beams: 1000}"), "test"));
  EXPECT_NO_THROW(parameters.assign(YAML::Load("{speed: 2.5, beams: 3}"), "test"));
}

TEST(ParameterTable, RefusesValuesNamingSourceKeyValueAndRange) {
  expect_refused("{sped: 1.0}", {"/ugv1/node", "unknown parameter", "sped"});
  expect_refused("{mass: 1.0}", {"/ugv1/node", "`mass` is gone: it follows from `beams`"});
  expect_refused("{velocity: 1.0}", {"/ugv1/node", "`velocity` is called `speed` now"});
  expect_refused("{speed: 2.6}", {"/ugv1/node", "speed", "2.6", "0.1", "2.5", "m/s"});
  expect_refused("{speed: 0.0}", {"speed", "0.1 to 2.5"});
  expect_refused("{speed: .nan}", {"speed", "nan", "0.1 to 2.5"});
  expect_refused("{speed: .inf}", {"speed", "inf"});
  expect_refused("{speed: fast}", {"speed = fast", "a number"});
  expect_refused("{speed: [1.0]}", {"speed", "single value"});
  expect_refused("{speed: }", {"speed"});
  expect_refused("{beams: 10.5}", {"beams = 10.5", "an integer"});
  expect_refused("{beams: 2}", {"beams = 2", "3 to 1000"});
  expect_refused("{enabled: 3}", {"enabled = 3", "true or false"});
  expect_refused("{shape: triangle}", {"shape = triangle", "disc, rectangle"});
}

TEST(ParameterTable, RefusesFilesThatAreNone) {
  ParameterTable parameters = table();
  expect_error([&] { parameters.assign_file("/nowhere/x.yaml"); },
               {"/nowhere/x.yaml", "cannot be read"});
  const TextFile list("[1, 2]");
  expect_error([&] { parameters.assign_file(list.path()); }, {list.path(), "not a map"});
  const TextFile broken("speed: [1,");
  expect_error([&] { parameters.assign_file(broken.path()); }, {broken.path()});
}

TEST(ParameterTable, RefusesSchemasThatAreIncomplete) {
  const auto refuse = [](const std::string& schema, std::initializer_list<std::string> parts) {
    const TextFile file(schema);
    expect_error([&] { ParameterTable::from_schema(file.path()); }, parts);
  };
  refuse("a: {min: 0.0, max: 1.0, unit: m, about: x}", {"a", "default"});
  refuse("a: {default: 0.5, min: 0.0, max: 1.0, about: x}", {"a", "unit"});
  refuse("a: {default: 0.5, min: 0.0, max: 1.0, unit: m}", {"a", "about"});
  refuse("a: {default: 0.5, max: 1.0, unit: m, about: x}", {"a", "range"});
  refuse("a: {default: 1, unit: m, about: x}", {"a", "range"});
  refuse("a: {default: 2.0, min: 0.0, max: 1.0, unit: m, about: x}", {"a", "0 to 1"});
  refuse("a: {default: c, choices: [a, b], unit: m, about: x}", {"a = c", "one of a, b"});
  refuse("a: {default: true, live: 2, unit: m, about: x}", {"a.live = 2", "true or false"});
  refuse("a: 3", {"a", "default"});
  expect_error([] { ParameterTable::from_schema("/nowhere/schema.yaml"); },
               {"/nowhere/schema.yaml"});
}

TEST(ParameterTable, AssignsAllValuesOrNone) {
  ParameterTable parameters = table();
  EXPECT_THROW(parameters.assign(YAML::Load("{beams: 7, speed: 2.6}"), "test"), ParameterError);
  EXPECT_EQ(parameters.integer("beams"), 360);
}

TEST(ParameterTable, SaysWhatTheSchemaSays) {
  ParameterTable parameters = table();
  parameters.assign(YAML::Load("{speed: 2}"), "test");
  const Parameter& speed = parameters.parameters().at("speed");
  EXPECT_EQ(speed.value, ParameterValue(2.0));
  EXPECT_EQ(speed.default_value, ParameterValue(1.0));
  EXPECT_EQ(speed.min, 0.1);
  EXPECT_EQ(speed.max, 2.5);
  EXPECT_EQ(speed.unit, "m/s");
  EXPECT_EQ(speed.about, "How fast.");
  EXPECT_TRUE(speed.live);
  EXPECT_FALSE(parameters.parameters().at("frame").live);
  EXPECT_FALSE(parameters.parameters().at("code").live);
  EXPECT_EQ(parameters.parameters().at("shape").choices,
            (std::vector<std::string>{"disc", "rectangle"}));
}

TEST(ParameterTable, ChangesLiveParameters) {
  ParameterTable parameters = table();
  const auto notes = parameters.change(
      {{"speed", 2.5}, {"beams", 3}, {"enabled", false}, {"shape", std::string("rectangle")}});
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(parameters.number("speed"), 2.5);
  EXPECT_EQ(parameters.integer("beams"), 3);
  EXPECT_FALSE(parameters.flag("enabled"));
  EXPECT_EQ(parameters.text("shape"), "rectangle");
}

TEST(ParameterTable, ClampsChangesAndSaysSo) {
  ParameterTable parameters = table();
  const auto notes = parameters.change({{"speed", 7.5}, {"beams", -4}});
  EXPECT_EQ(parameters.number("speed"), 2.5);
  EXPECT_EQ(parameters.integer("beams"), 3);
  EXPECT_EQ(notes, (std::vector<std::string>{
                       "speed = 7.5: clamped to 2.5, from 0.1 to 2.5 (m/s)",
                       "beams = -4: clamped to 3, from 3 to 1000 (-)",
                   }));
  parameters.change({{"speed", -std::numeric_limits<double>::infinity()}});
  EXPECT_EQ(parameters.number("speed"), 0.1);
}

TEST(ParameterTable, RefusesChangesAsAWhole) {
  const auto refuse = [](const std::string& name, const ParameterValue& value,
                         std::initializer_list<std::string> parts) {
    ParameterTable parameters = table();
    expect_error([&] { parameters.change({{"enabled", false}, {name, value}}); }, parts);
    for (const auto& [unchanged, parameter] : parameters.parameters())
      EXPECT_EQ(parameter.value, parameter.default_value) << unchanged << " after " << name;
  };
  refuse("sped", 2.0, {"unknown parameter `sped`"});
  refuse("frame", std::string("odom"), {"frame", "at the start only"});
  refuse("speed", 2, {"speed = 2", "a number"});
  refuse("speed", std::string("2.0"), {"speed = 2.0", "a number"});
  refuse("speed", std::nan(""), {"speed = nan", "0.1 to 2.5"});
  refuse("beams", 10.0, {"beams = 10", "an integer"});
  refuse("beams", true, {"beams = true", "an integer"});
  refuse("enabled", 1, {"enabled = 1", "true or false"});
  refuse("shape", true, {"shape = true", "a text"});
  refuse("shape", std::string("triangle"), {"shape = triangle", "disc, rectangle"});
}

TEST(ParameterTable, RefusesQuestionsThatTheSchemaDoesNotAnswer) {
  const ParameterTable parameters = table();
  expect_error([&] { parameters.number("sped"); }, {"sped", "not declared"});
  expect_error([&] { parameters.number("beams"); }, {"beams", "another type"});
  expect_error([&] { parameters.integer("speed"); }, {"speed", "another type"});
  expect_error([&] { parameters.flag("shape"); }, {"shape", "another type"});
  expect_error([&] { parameters.text("enabled"); }, {"enabled", "another type"});
}

}  // namespace
}  // namespace mocha
