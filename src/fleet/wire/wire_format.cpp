#include "fleet/wire/wire_format.h"

#include <algorithm>
#include <iterator>
#include <mocha_lcm/datagram_t.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "fleet/wire/byte_codec.h"
#include "fleet/wire/message_fields.h"
#include "fleet/wire/motion_codec.h"
#include "fleet/wire/passing_codec.h"
#include "fleet/wire/stop_codec.h"

namespace mocha {
namespace {

constexpr std::size_t kLcmHeader = 8 + 16;  // magic number, sequence, and the channel's name
// Before the body: the fingerprint of the LCM type, version, sealed, seal, size.
constexpr std::size_t kSealAt = 8 + 1 + 1;
constexpr std::size_t kSizeAt = kSealAt + FleetKey::kSealBytes;
constexpr std::size_t kFrame = kSizeAt + 2;
constexpr double kReaches = 100.0;  // in a metre
constexpr std::size_t kMostBody = kMostDatagramBytes - kLcmHeader - kFrame;

enum class Kind : std::uint8_t {
  kTrajectory = 1,
  kHeartbeat = 2,
  kPassingIntent = 3,
  kPassingInstruction = 4,
  kFleetStops = 5
};

TrajectoryState get_state(ByteReader& in) {
  const auto state = in.get<std::uint8_t>();
  require_said(state >= static_cast<int>(TrajectoryState::kProposed) &&
                   state <= static_cast<int>(TrajectoryState::kWithdrawn),
               "no state has the number " + std::to_string(state));
  return static_cast<TrajectoryState>(state);
}

void put_head(ByteWriter& out, Kind kind, const std::string& agent, std::uint32_t epoch,
              std::uint32_t number) {
  out.put(static_cast<std::uint8_t>(kind));
  put_name(out, agent);
  out.put(epoch);
  out.put(number);
}

void put_trajectory(ByteWriter& out, const CommittedTrajectory& trajectory, std::uint32_t number) {
  put_head(out, Kind::kTrajectory, trajectory.agent, trajectory.id.epoch, number);
  out.put(trajectory.id.sequence);
  out.put(static_cast<std::uint8_t>(trajectory.state));
  out.put(static_cast<std::int32_t>(trajectory.priority));
  // Rounded up: a robot must not be taken for smaller than it is.
  const double radius_mm = std::ceil(trajectory.footprint_radius_m * kRadii - 1e-6);
  put_number<std::uint16_t>(out, radius_mm, 1.0, "footprint_radius");
  if (trajectory.state == TrajectoryState::kWithdrawn) return;
  put_braking(out, trajectory.braking.value());
  put_motion(out, *trajectory.motion);
}

CommittedTrajectory get_trajectory(ByteReader& in, std::string agent, std::uint32_t epoch) {
  CommittedTrajectory trajectory;
  trajectory.agent = std::move(agent);
  trajectory.id.epoch = epoch;
  trajectory.id.sequence = in.get<std::uint32_t>();
  trajectory.state = get_state(in);
  trajectory.priority = in.get<std::int32_t>();
  trajectory.footprint_radius_m = get_number<std::uint16_t>(in, kRadii);
  if (trajectory.state != TrajectoryState::kWithdrawn) {
    trajectory.braking = get_braking(in);
    trajectory.motion = get_motion(in);
  }
  validate(trajectory);
  return trajectory;
}

void put_line(ByteWriter& out, const Acknowledgement& acknowledgement) {
  put_name(out, acknowledgement.agent);
  out.put(acknowledgement.id.epoch);
  out.put(acknowledgement.id.sequence);
  out.put(static_cast<std::uint8_t>(acknowledgement.state));
}

void put_line(ByteWriter& out, const Echo& echo) {
  put_name(out, echo.agent);
  put_number<std::int64_t>(out, echo.stamp_s, kTimes, "the stamp of an echo");
  put_number<std::uint32_t>(out, echo.held_s, kTimes, "the time that an echo was held");
}

void put_heartbeat(ByteWriter& out, const Heartbeat& heartbeat, std::uint32_t number) {
  put_head(out, Kind::kHeartbeat, heartbeat.agent, heartbeat.epoch, number);
  put_number<std::int64_t>(out, heartbeat.stamp_s, kTimes, "the stamp");
  // Rounded up: a robot must not be taken to promise less far than it does.
  const double reach_cm = std::ceil(heartbeat.promise_reach_m * kReaches - 1e-6);
  put_number<std::uint16_t>(out, reach_cm, 1.0, "promise_reach");
  out.put(count_of(heartbeat.acknowledgements.size(), "lines"));
  for (const Acknowledgement& acknowledgement : heartbeat.acknowledgements)
    put_line(out, acknowledgement);
  out.put(count_of(heartbeat.echoes.size(), "echoes"));
  for (const Echo& echo : heartbeat.echoes) put_line(out, echo);
}

Heartbeat get_heartbeat(ByteReader& in, std::string agent, std::uint32_t epoch) {
  Heartbeat heartbeat;
  heartbeat.agent = std::move(agent);
  heartbeat.epoch = epoch;
  heartbeat.stamp_s = get_time(in);
  heartbeat.promise_reach_m = get_number<std::uint16_t>(in, kReaches);
  const std::size_t lines = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < lines; ++i) {
    Acknowledgement acknowledgement;
    acknowledgement.agent = get_name(in);
    acknowledgement.id.epoch = in.get<std::uint32_t>();
    acknowledgement.id.sequence = in.get<std::uint32_t>();
    acknowledgement.state = get_state(in);
    heartbeat.acknowledgements.push_back(std::move(acknowledgement));
  }
  const std::size_t echoes = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < echoes; ++i) {
    Echo echo;
    echo.agent = get_name(in);
    echo.stamp_s = get_time(in);
    echo.held_s = get_number<std::uint32_t>(in, kTimes);
    heartbeat.echoes.push_back(std::move(echo));
  }
  return heartbeat;
}

ByteWriter body_of(const Datagram& datagram) {
  ByteWriter body;
  if (const auto* trajectory = std::get_if<CommittedTrajectory>(&datagram.message)) {
    validate(*trajectory);
    put_trajectory(body, *trajectory, datagram.number);
  } else if (const auto* intent = std::get_if<PassingIntent>(&datagram.message)) {
    validate(*intent);
    put_head(body, Kind::kPassingIntent, intent->agent, intent->epoch, datagram.number);
    put_intent(body, *intent);
  } else if (const auto* instruction = std::get_if<PassingInstruction>(&datagram.message)) {
    validate(*instruction);
    put_head(body, Kind::kPassingInstruction, instruction->id.leader, instruction->id.epoch,
             datagram.number);
    put_instruction(body, *instruction);
  } else if (const auto* stops = std::get_if<FleetStops>(&datagram.message)) {
    validate(*stops);
    put_head(body, Kind::kFleetStops, stops->agent, stops->epoch, datagram.number);
    put_stops(body, stops->stops);
  } else {
    put_heartbeat(body, std::get<Heartbeat>(datagram.message), datagram.number);
  }
  return body;
}

Datagram from_body(ByteReader in) {
  const auto kind = static_cast<Kind>(in.get<std::uint8_t>());
  require_said(kind >= Kind::kTrajectory && kind <= Kind::kFleetStops, "is of no known kind");
  std::string agent = get_name(in);
  const auto epoch = in.get<std::uint32_t>();
  Datagram datagram;
  datagram.number = in.get<std::uint32_t>();
  if (kind == Kind::kTrajectory) {
    datagram.message = get_trajectory(in, std::move(agent), epoch);
  } else if (kind == Kind::kPassingIntent) {
    datagram.message = get_intent(in, std::move(agent), epoch);
  } else if (kind == Kind::kPassingInstruction) {
    datagram.message = get_instruction(in, std::move(agent), epoch);
  } else if (kind == Kind::kFleetStops) {
    FleetStops stops{std::move(agent), epoch, get_stops(in)};
    validate(stops);
    datagram.message = std::move(stops);
  } else {
    datagram.message = get_heartbeat(in, std::move(agent), epoch);
  }
  require_said(in.left() == 0, "goes on after its end");
  return datagram;
}

void check_seal(std::vector<std::uint8_t> bytes, bool sealed, const FleetKey* key) {
  if (!sealed && key == nullptr) return;
  if (!sealed) throw SealError(SealFault::kUnsealed, "message: is not sealed with the fleet key");
  if (key == nullptr)
    throw SealError(SealFault::kNoKey, "message: is sealed, and this robot has no fleet key");
  FleetKey::Seal seal;
  const auto at = bytes.begin() + kSealAt;
  std::copy_n(at, seal.size(), seal.begin());
  std::fill_n(at, seal.size(), std::uint8_t{0});
  if (!key->sealed(seal, bytes.data(), bytes.size()))
    throw SealError(SealFault::kForeignSeal,
                    "message: is sealed with another fleet key, or broken");
}

/// Of a line in a heartbeat.
template <typename Line>
std::size_t bytes_of(const Line& line) {
  ByteWriter out;
  put_line(out, line);
  return out.bytes().size();
}

}  // namespace

std::vector<std::uint8_t> encode(const Datagram& datagram, const FleetKey* key) {
  const ByteWriter body = body_of(datagram);
  require_said(body.bytes().size() <= kMostBody, "does not fit into one datagram");
  mocha_lcm::datagram_t message{};
  message.version = kWireVersion;
  message.sealed = key != nullptr ? 1 : 0;
  message.size = static_cast<std::int16_t>(body.bytes().size());
  message.body = body.bytes();
  std::vector<std::uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  if (key != nullptr) {
    const FleetKey::Seal seal = key->seal(bytes.data(), bytes.size());
    std::copy(seal.begin(), seal.end(), bytes.begin() + kSealAt);
  }
  return bytes;
}

Datagram decode(const std::uint8_t* data, std::size_t size, const FleetKey* key) {
  require_said(size >= kFrame && size <= kMostDatagramBytes, "no datagram has so many bytes");
  require_said(kFrame + std::size_t{256} * data[kSizeAt] + data[kSizeAt + 1] == size,
               "its size is not what it says");
  mocha_lcm::datagram_t message{};
  require_said(message.decode(data, 0, static_cast<int>(size)) == static_cast<int>(size),
               "is no datagram of this package");
  require_said(message.version == kWireVersion, "is of version " + std::to_string(message.version) +
                                                    ", not " + std::to_string(kWireVersion));
  require_said(message.sealed == 0 || message.sealed == 1, "is neither sealed nor unsealed");
  check_seal({data, data + size}, message.sealed == 1, key);
  return from_body(ByteReader(message.body.data(), message.body.size()));
}

std::vector<Heartbeat> in_datagrams(const Heartbeat& heartbeat) {
  const auto about_sender = [&](const Acknowledgement& line) {
    return line.agent == heartbeat.agent;
  };
  Heartbeat head{heartbeat.agent,          heartbeat.epoch, heartbeat.stamp_s, {}, {},
                 heartbeat.promise_reach_m};
  std::copy_if(heartbeat.acknowledgements.begin(), heartbeat.acknowledgements.end(),
               std::back_inserter(head.acknowledgements), about_sender);
  ByteWriter written;
  put_heartbeat(written, head, 0);
  const std::size_t head_bytes = written.bytes().size();
  std::vector<Heartbeat> heartbeats{head};
  std::size_t bytes = head_bytes;
  const auto make_room = [&](std::size_t more) {
    const bool full =
        heartbeats.back().acknowledgements.size() == 255 || heartbeats.back().echoes.size() == 255;
    if (bytes + more > kMostBody || full) {
      heartbeats.push_back(head);
      bytes = head_bytes;
    }
    bytes += more;
  };
  for (const Acknowledgement& line : heartbeat.acknowledgements) {
    if (about_sender(line)) continue;
    make_room(bytes_of(line));
    heartbeats.back().acknowledgements.push_back(line);
  }
  for (const Echo& echo : heartbeat.echoes) {
    make_room(bytes_of(echo));
    heartbeats.back().echoes.push_back(echo);
  }
  return heartbeats;
}

CommittedTrajectory quantised(const CommittedTrajectory& trajectory) {
  const std::vector<std::uint8_t> bytes = encode({0, trajectory});
  return std::get<CommittedTrajectory>(decode(bytes.data(), bytes.size()).message);
}

Motion quantised(const Motion& motion) {
  ByteWriter out;
  put_motion(out, motion);
  ByteReader in(out.bytes().data(), out.bytes().size());
  return *get_motion(in);
}

bool fits(const Motion& motion) {
  CommittedTrajectory trajectory;
  trajectory.agent = std::string(kMostName, 'x');
  trajectory.braking = Braking(1.0);  // all take equally many bytes
  trajectory.motion = std::make_shared<const Motion>(motion);
  ByteWriter body;
  try {
    put_trajectory(body, trajectory, 0);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return body.bytes().size() <= kMostBody;
}

bool fits(const PassingInstruction& instruction) {
  return body_of({0, instruction}).bytes().size() <= kMostBody;
}

}  // namespace mocha
