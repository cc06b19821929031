#include "fleet/storage/stop_store.h"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "fleet/storage/durable_file.h"

namespace mocha {
namespace {

// Line by line: the resets; the stop of this robot; those that each robot ordered for the fleet;
// and a last line, without which part of the file is missing.
const std::string kFirst = "emergency stops 1";
const std::string kLast = "end";
constexpr std::size_t kMostTrouble = 300;  // characters

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

/// The rest of a line, without the blank before it.
std::string rest_of(std::istream& line) {
  std::string rest;
  std::getline(line >> std::ws, rest);
  return rest;
}

void read_line(const std::string& text, StopRecord& record) {
  std::istringstream line(text);
  std::string what;
  line >> what;
  if (what == "resets") {
    line >> record.resets;
  } else if (what == "robot") {
    line >> record.robot >> record.since_s;
    require(!line.fail(), "'" + text + "' is damaged");
    record.reason = rest_of(line);
    return;
  } else if (what == "fleet") {
    FleetStop stop;
    line >> stop.agent >> stop.ordered >> stop.released >> stop.since_s;
    require(!line.fail(), "'" + text + "' is damaged");
    stop.reason = rest_of(line);
    validate(FleetStops{stop.agent, 0, {stop}});
    record.fleet[stop.agent] = stop;
    return;
  } else {
    throw std::invalid_argument("'" + text + "' is none of its lines");
  }
  require(!line.fail(), "'" + text + "' is damaged");
}

StopRecord read(const std::string& path) {
  std::ifstream file(path);
  StopRecord record;
  std::string line;
  require(std::getline(file, line) && line == kFirst, "does not begin with '" + kFirst + "'");
  while (std::getline(file, line) && line != kLast) read_line(line, record);
  require(line == kLast, "ends too early");
  return record;
}

}  // namespace

StopRecord load_stops(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error) && !error) return {};
  try {
    require(!error, error.message());
    return read(path);
  } catch (const std::invalid_argument& trouble) {
    StopRecord stopped;
    stopped.robot = true;
    stopped.reason = plain_reason(
        "it may have been stopped: " + path + " cannot be read: " + trouble.what(), kMostTrouble);
    return stopped;
  }
}

void save_stops(const std::string& path, const StopRecord& record) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(6) << kFirst << "\nresets " << record.resets << "\nrobot "
       << record.robot << " " << record.since_s << " " << record.reason << "\n";
  for (const auto& [agent, stop] : record.fleet) {
    text << "fleet " << agent << " " << stop.ordered << " " << stop.released << " " << stop.since_s
         << " " << stop.reason << "\n";
  }
  text << kLast << "\n";
  try {
    write_durably(path, text.str());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("emergency stops are not kept over a restart: " + path + " " +
                             error.what());
  }
}

}  // namespace mocha
