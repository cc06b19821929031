#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace mocha {

/// The emergency stops that one robot has ordered for the whole fleet. One holds while fewer are
/// released than were ordered.
struct FleetStop {
  std::string agent;           ///< at which they were ordered
  std::uint64_t ordered = 0;   ///< so many; counts over the starts of the agent
  std::uint64_t released = 0;  ///< so many of them are released
  double since_s = 0.0;        ///< when the newest was ordered, by the agent's clock
  std::string reason;          ///< of the newest, for people

  bool holds() const { return released < ordered; }
};

/// What a robot says of the emergency stops of its fleet.
struct FleetStops {
  std::string agent;
  std::uint32_t epoch = 0;
  std::vector<FleetStop> stops;
};

constexpr std::size_t kMostStopsSaid = 8;  // so that they fit into one datagram
constexpr std::size_t kMostReason = 60;    // characters

/// Throws std::invalid_argument, saying what is wrong, for what no robot can have meant: no name,
/// more released than ordered, more than kMostStopsSaid stops, a reason that is long or not plain.
void validate(const FleetStops& message);

/// Without what is not plain ASCII, and cut where it is too long.
std::string plain_reason(const std::string& text, std::size_t most = kMostReason);

/// What is kept over restarts.
struct StopRecord {
  bool robot = false;  ///< the stop of this robot alone holds
  double since_s = 0.0;
  std::string reason;
  std::map<std::string, FleetStop> fleet;  ///< by agent
  std::uint64_t resets = 0;  ///< counts the resets at this robot, and those of the fleet heard of
};

/// The emergency stops that hold for one robot: its own, and the fleet's, of which all robots tell
/// each other. Time is an argument; messages go in and come out.
///
/// Of each robot's orders for the fleet two numbers are known, ordered and released, and of what is
/// heard the larger one counts. So messages may come late, twice, in any order, or not at all, also
/// from recordings, and a robot that hears the newest of each knows what all know together. A reset
/// releases the stops that are known where it is made, and no others: one ordered meanwhile, or out
/// of reach, still holds. All is sent once a second, several times when it changes, and soon after
/// a robot shows that it knows less.
class EmergencyStop {
 public:
  /// More stops than a fleet has: a robot that claims a number farther above the known one is
  /// wrong, or wants us to run out of numbers.
  static constexpr std::uint64_t kMostNews = 1'000'000;
  /// Robots whose orders are remembered: no more than PeerTable knows.
  static constexpr std::size_t kMostAgents = 250;

  EmergencyStop(std::string agent, std::uint32_t epoch, StopRecord record);

  // An order for what holds already changes nothing.
  void stop_robot(double now, const std::string& reason);
  void stop_fleet(double now, const std::string& reason);
  /// Releases the stop of this robot; the fleet's go on to hold.
  void reset_robot();
  /// Releases all stops of the fleet that are known here; that of this robot goes on to hold.
  void reset_fleet(double now);

  /// A validated message of another robot.
  void receive(const FleetStops& message, double now);
  /// What is to be said to all now; mostly nothing.
  std::vector<FleetStops> tick(double now);

  bool stopped() const { return record_.robot || fleet_stopped(); }
  bool fleet_stopped() const { return !holding().empty(); }
  /// The stops of the fleet that hold.
  std::vector<FleetStop> holding() const;
  const StopRecord& record() const { return record_; }
  /// Goes up with every change of the record.
  int changes() const { return changes_; }
  /// What was heard and not believed.
  int refused() const { return refused_; }

 private:
  enum class News { kNone, kNewer, kOlder };

  News merge(const FleetStop& heard);
  bool make_room();
  void note_change(double now);

  const std::string agent_;
  const std::uint32_t epoch_;
  StopRecord record_;
  int changes_ = 0;
  int refused_ = 0;
  int repeats_ = 0;  // soon, of what has changed
  double said_s_ = -std::numeric_limits<double>::infinity();
  double say_next_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace mocha
