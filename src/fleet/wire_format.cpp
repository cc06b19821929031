#include "fleet/wire_format.h"

#include <algorithm>
#include <iterator>
#include <mocha_lcm/datagram_t.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "fleet/byte_codec.h"
#include "fleet/message_fields.h"
#include "fleet/motion_codec.h"
#include "fleet/stop_codec.h"

namespace mocha {
namespace {

constexpr std::size_t kLcmHeader = 8 + 16;  // magic number, sequence, and the channel's name
// Before the body: the fingerprint of the LCM type, version, sealed, seal, size.
constexpr std::size_t kSealAt = 8 + 1 + 1;
constexpr std::size_t kSizeAt = kSealAt + FleetKey::kSealBytes;
constexpr std::size_t kFrame = kSizeAt + 2;
constexpr std::size_t kMostBody = kMostDatagramBytes - kLcmHeader - kFrame;

enum class Kind : std::uint8_t { kPromise = 1, kBeat = 2, kWayRequest = 3, kFleetStops = 4 };

PromiseState get_state(ByteReader& in) {
  const auto state = in.get<std::uint8_t>();
  require_said(state >= static_cast<int>(PromiseState::kProposed) &&
                   state <= static_cast<int>(PromiseState::kWithdrawn),
               "no state has the number " + std::to_string(state));
  return static_cast<PromiseState>(state);
}

void put_head(ByteWriter& out, Kind kind, const std::string& agent, std::uint32_t epoch,
              std::uint32_t number) {
  out.put(static_cast<std::uint8_t>(kind));
  put_name(out, agent);
  out.put(epoch);
  out.put(number);
}

void put_promise(ByteWriter& out, const Promise& promise, std::uint32_t number) {
  put_head(out, Kind::kPromise, promise.agent, promise.id.epoch, number);
  out.put(promise.id.sequence);
  out.put(static_cast<std::uint8_t>(promise.state));
  out.put(static_cast<std::int32_t>(promise.priority));
  // Rounded up: nobody may take a robot for smaller than it is.
  const double radius_mm = std::ceil(promise.footprint_radius_m * kRadii - 1e-6);
  put_number<std::uint16_t>(out, radius_mm, 1.0, "footprint_radius");
  if (promise.state != PromiseState::kWithdrawn) put_motion(out, *promise.motion);
}

Promise get_promise(ByteReader& in, std::string agent, std::uint32_t epoch) {
  Promise promise;
  promise.agent = std::move(agent);
  promise.id.epoch = epoch;
  promise.id.sequence = in.get<std::uint32_t>();
  promise.state = get_state(in);
  promise.priority = in.get<std::int32_t>();
  promise.footprint_radius_m = get_number<std::uint16_t>(in, kRadii);
  if (promise.state != PromiseState::kWithdrawn) promise.motion = get_motion(in);
  validate(promise);
  return promise;
}

void put_line(ByteWriter& out, const Seen& seen) {
  put_name(out, seen.agent);
  out.put(seen.id.epoch);
  out.put(seen.id.sequence);
  out.put(static_cast<std::uint8_t>(seen.state));
}

void put_line(ByteWriter& out, const Echo& echo) {
  put_name(out, echo.agent);
  put_number<std::int64_t>(out, echo.stamp_s, kTimes, "the stamp of an echo");
  put_number<std::uint32_t>(out, echo.held_s, kTimes, "the time that an echo was held");
}

void put_beat(ByteWriter& out, const Beat& beat, std::uint32_t number) {
  put_head(out, Kind::kBeat, beat.agent, beat.epoch, number);
  put_number<std::int64_t>(out, beat.stamp_s, kTimes, "the stamp");
  out.put(count_of(beat.seen.size(), "lines"));
  for (const Seen& seen : beat.seen) put_line(out, seen);
  out.put(count_of(beat.echoes.size(), "echoes"));
  for (const Echo& echo : beat.echoes) put_line(out, echo);
}

Beat get_beat(ByteReader& in, std::string agent, std::uint32_t epoch) {
  Beat beat;
  beat.agent = std::move(agent);
  beat.epoch = epoch;
  beat.stamp_s = get_time(in);
  const std::size_t lines = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < lines; ++i) {
    Seen seen;
    seen.agent = get_name(in);
    seen.id.epoch = in.get<std::uint32_t>();
    seen.id.sequence = in.get<std::uint32_t>();
    seen.state = get_state(in);
    beat.seen.push_back(std::move(seen));
  }
  const std::size_t echoes = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < echoes; ++i) {
    Echo echo;
    echo.agent = get_name(in);
    echo.stamp_s = get_time(in);
    echo.held_s = get_number<std::uint32_t>(in, kTimes);
    beat.echoes.push_back(std::move(echo));
  }
  return beat;
}

void put_request(ByteWriter& out, const WayRequest& request, std::uint32_t number) {
  put_head(out, Kind::kWayRequest, request.agent, request.epoch, number);
  out.put(static_cast<std::uint8_t>(request.rank.stuck));
  out.put(static_cast<std::int32_t>(request.rank.priority));
  put_name(out, request.rank.agent);
  put_number<std::uint16_t>(out, request.radius_m, kRadii, "the radius of a way request");
  put_number<std::uint16_t>(out, request.speed_mps, kRadii, "the speed of a way request");
  out.put(count_of(request.way.size(), "places"));
  for (const Vector2& place : request.way) {
    put_number<std::int32_t>(out, place.x(), kPlaces, "a place of a way");
    put_number<std::int32_t>(out, place.y(), kPlaces, "a place of a way");
  }
}

WayRequest get_request(ByteReader& in, std::string agent, std::uint32_t epoch) {
  WayRequest request;
  request.agent = std::move(agent);
  request.epoch = epoch;
  const auto stuck = in.get<std::uint8_t>();
  require_said(stuck <= 1, "is neither stuck nor not");
  request.rank.stuck = stuck == 1;
  request.rank.priority = in.get<std::int32_t>();
  request.rank.agent = get_name(in);
  request.radius_m = get_number<std::uint16_t>(in, kRadii);
  request.speed_mps = get_number<std::uint16_t>(in, kRadii);
  const std::size_t places = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < places; ++i) {
    const double x = get_number<std::int32_t>(in, kPlaces);
    request.way.emplace_back(x, get_number<std::int32_t>(in, kPlaces));
  }
  validate(request);
  return request;
}

ByteWriter body_of(const Datagram& datagram) {
  ByteWriter body;
  if (const auto* promise = std::get_if<Promise>(&datagram.message)) {
    validate(*promise);
    put_promise(body, *promise, datagram.number);
  } else if (const auto* request = std::get_if<WayRequest>(&datagram.message)) {
    validate(*request);
    put_request(body, *request, datagram.number);
  } else if (const auto* stops = std::get_if<FleetStops>(&datagram.message)) {
    validate(*stops);
    put_head(body, Kind::kFleetStops, stops->agent, stops->epoch, datagram.number);
    put_stops(body, stops->stops);
  } else {
    put_beat(body, std::get<Beat>(datagram.message), datagram.number);
  }
  return body;
}

Datagram from_body(ByteReader in) {
  const auto kind = static_cast<Kind>(in.get<std::uint8_t>());
  require_said(kind >= Kind::kPromise && kind <= Kind::kFleetStops, "is of no known kind");
  std::string agent = get_name(in);
  const auto epoch = in.get<std::uint32_t>();
  Datagram datagram;
  datagram.number = in.get<std::uint32_t>();
  if (kind == Kind::kPromise) {
    datagram.message = get_promise(in, std::move(agent), epoch);
  } else if (kind == Kind::kWayRequest) {
    datagram.message = get_request(in, std::move(agent), epoch);
  } else if (kind == Kind::kFleetStops) {
    FleetStops stops{std::move(agent), epoch, get_stops(in)};
    validate(stops);
    datagram.message = std::move(stops);
  } else {
    datagram.message = get_beat(in, std::move(agent), epoch);
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
  mocha_lcm::datagram_t message;
  require_said(message.decode(data, 0, static_cast<int>(size)) == static_cast<int>(size),
               "is no datagram of this package");
  require_said(message.version == kWireVersion, "is of version " + std::to_string(message.version) +
                                                    ", not " + std::to_string(kWireVersion));
  require_said(message.sealed == 0 || message.sealed == 1, "is neither sealed nor unsealed");
  check_seal({data, data + size}, message.sealed == 1, key);
  return from_body(ByteReader(message.body.data(), message.body.size()));
}

std::vector<Beat> in_datagrams(const Beat& beat) {
  const auto about_sender = [&](const Seen& line) { return line.agent == beat.agent; };
  Beat head{beat.agent, beat.epoch, beat.stamp_s, {}, {}};
  std::copy_if(beat.seen.begin(), beat.seen.end(), std::back_inserter(head.seen), about_sender);
  ByteWriter written;
  put_beat(written, head, 0);
  const std::size_t head_bytes = written.bytes().size();
  std::vector<Beat> beats{head};
  std::size_t bytes = head_bytes;
  const auto make_room = [&](std::size_t more) {
    const bool full = beats.back().seen.size() == 255 || beats.back().echoes.size() == 255;
    if (bytes + more > kMostBody || full) {
      beats.push_back(head);
      bytes = head_bytes;
    }
    bytes += more;
  };
  for (const Seen& line : beat.seen) {
    if (about_sender(line)) continue;
    make_room(bytes_of(line));
    beats.back().seen.push_back(line);
  }
  for (const Echo& echo : beat.echoes) {
    make_room(bytes_of(echo));
    beats.back().echoes.push_back(echo);
  }
  return beats;
}

Promise quantised(const Promise& promise) {
  const std::vector<std::uint8_t> bytes = encode({0, promise});
  return std::get<Promise>(decode(bytes.data(), bytes.size()).message);
}

Motion quantised(const Motion& motion) {
  ByteWriter out;
  put_motion(out, motion);
  ByteReader in(out.bytes().data(), out.bytes().size());
  return *get_motion(in);
}

bool fits(const Motion& motion) {
  Promise promise;
  promise.agent = std::string(kMostName, 'x');
  promise.motion = std::make_shared<const Motion>(motion);
  ByteWriter body;
  try {
    put_promise(body, promise, 0);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return body.bytes().size() <= kMostBody;
}

}  // namespace mocha
