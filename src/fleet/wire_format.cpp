#include "fleet/wire_format.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mocha_lcm/datagram_t.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "fleet/byte_codec.h"
#include "trajectory/descriptor.h"

namespace mocha {
namespace {

constexpr std::size_t kLcmHeader = 8 + 16;  // magic number, sequence, and the channel's name
constexpr std::size_t kFrame = 8 + 1 + 2;   // the fingerprint of the LCM type, version, size
constexpr std::size_t kMostName = 63;

// What an integer counts, in one second, metre, and so on. Whole numbers: so the nearest double to
// a decimal number comes back as it went.
constexpr double kTimes = 1e6;       // in [s]
constexpr double kPlaces = 1e5;      // in [m]
constexpr double kFine = 1e5;        // in [rad], [m/s], [m/s^2]
constexpr double kRadii = 1e3;       // in [m]
constexpr double kMostCount = 9e15;  // doubles hold whole numbers exactly up to about here

enum class Kind : std::uint8_t { kPromise = 1, kBeat = 2 };

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument("message: " + what);
}

template <typename Integer>
void put_number(ByteWriter& out, double value, double counts, const char* name) {
  const double count = std::round(value * counts);
  const bool held = std::abs(count) < kMostCount &&
                    count >= static_cast<double>(std::numeric_limits<Integer>::min()) &&
                    count <= static_cast<double>(std::numeric_limits<Integer>::max());
  require(held, std::string(name) + " = " + std::to_string(value) + " is out of range");
  out.put(static_cast<Integer>(count));
}

template <typename Integer>
double get_number(ByteReader& in, double counts) {
  return static_cast<double>(in.get<Integer>()) / counts;
}

/// Of either sign, as put_number() takes it.
double get_time(ByteReader& in) {
  const auto count = in.get<std::int64_t>();
  require(std::abs(static_cast<double>(count)) < kMostCount, "a time is out of range");
  return static_cast<double>(count) / kTimes;
}

void check_name(const std::string& name) {
  require(!name.empty() && name.size() <= kMostName, "a name has no or more than 63 characters");
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '/';
  });
  require(plain, "a name has characters that names of robots do not have");
}

void put_name(ByteWriter& out, const std::string& name) {
  check_name(name);
  out.put_text(name);
}

std::string get_name(ByteReader& in) {
  std::string name = in.get_text();
  check_name(name);
  return name;
}

std::uint8_t count_of(std::size_t size, const char* what) {
  require(size <= 255, std::string("more than 255 ") + what);
  return static_cast<std::uint8_t>(size);
}

PromiseState get_state(ByteReader& in) {
  const auto state = in.get<std::uint8_t>();
  require(state >= static_cast<int>(PromiseState::kProposed) &&
              state <= static_cast<int>(PromiseState::kWithdrawn),
          "no state has the number " + std::to_string(state));
  return static_cast<PromiseState>(state);
}

/// Counted from the beginning of the motion, which may be far from the origin of the map.
struct Counts {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

Counts counts_of(const Vector2& place) {
  const Vector2 counts = kPlaces * place;
  require(counts.cwiseAbs().maxCoeff() < kMostCount / 2.0, "a place is out of range");
  return {std::llround(counts.x()), std::llround(counts.y())};
}

void put_place(ByteWriter& out, const Vector2& place, const Counts& origin) {
  const Counts counts = counts_of(place);
  put_number<std::int32_t>(out, static_cast<double>(counts.x - origin.x), 1.0, "x");
  put_number<std::int32_t>(out, static_cast<double>(counts.y - origin.y), 1.0, "y");
}

Vector2 get_place(ByteReader& in, const Counts& origin) {
  const std::int64_t x = origin.x + in.get<std::int32_t>();
  const std::int64_t y = origin.y + in.get<std::int32_t>();
  return Vector2(static_cast<double>(x), static_cast<double>(y)) / kPlaces;
}

void put_phase(ByteWriter& out, const PhaseDescriptor& phase, const Counts& origin) {
  out.put(static_cast<std::uint8_t>(phase.kind));
  if (phase.kind != PhaseDescriptor::Kind::kDrive) {
    put_number<std::int32_t>(out, phase.yaw_start_rad, kFine, "a heading");
    if (phase.kind == PhaseDescriptor::Kind::kTurn)
      put_number<std::int32_t>(out, phase.yaw_change_rad, kFine, "a turn");
  } else {
    out.put(static_cast<std::uint8_t>(phase.direction > 0));
    out.put(count_of(phase.durations_s.size(), "pieces"));
    for (const auto* ends : {&phase.start_derivatives, &phase.end_derivatives}) {
      for (int i = 0; i < 4; ++i) put_number<std::int32_t>(out, (*ends)(i), kFine, "a derivative");
    }
  }
  for (const double duration_s : phase.durations_s)
    put_number<std::uint32_t>(out, duration_s, kTimes, "a duration");
  for (const Vector2& point : phase.points) put_place(out, point, origin);
}

PhaseDescriptor get_phase(ByteReader& in, const Counts& origin) {
  PhaseDescriptor phase;
  const auto kind = in.get<std::uint8_t>();
  require(kind <= static_cast<int>(PhaseDescriptor::Kind::kStand), "a phase is of no known kind");
  phase.kind = static_cast<PhaseDescriptor::Kind>(kind);
  std::size_t pieces = 1;
  std::size_t points = 1;
  if (phase.kind != PhaseDescriptor::Kind::kDrive) {
    phase.yaw_start_rad = get_number<std::int32_t>(in, kFine);
    if (phase.kind == PhaseDescriptor::Kind::kTurn)
      phase.yaw_change_rad = get_number<std::int32_t>(in, kFine);
  } else {
    const auto forward = in.get<std::uint8_t>();
    require(forward <= 1, "a drive's direction is neither 1 nor 0");
    phase.direction = forward == 1 ? 1 : -1;
    pieces = in.get<std::uint8_t>();
    points = pieces + 1;
    for (auto* ends : {&phase.start_derivatives, &phase.end_derivatives}) {
      for (int i = 0; i < 4; ++i) (*ends)(i) = get_number<std::int32_t>(in, kFine);
    }
  }
  for (std::size_t i = 0; i < pieces; ++i)
    phase.durations_s.push_back(get_number<std::uint32_t>(in, kTimes));
  for (std::size_t i = 0; i < points; ++i) phase.points.push_back(get_place(in, origin));
  return phase;
}

void put_motion(ByteWriter& out, const Motion& motion) {
  require(!motion.empty(), "there is no motion");
  const MotionDescriptor descriptor = describe(motion);
  put_number<std::int64_t>(out, descriptor.start_time_s, kTimes, "the start");
  out.put(count_of(descriptor.phases.size(), "phases"));
  const Counts origin = counts_of(descriptor.phases.front().points.front());
  out.put(origin.x);
  out.put(origin.y);
  for (const PhaseDescriptor& phase : descriptor.phases) put_phase(out, phase, origin);
}

std::shared_ptr<const Motion> get_motion(ByteReader& in) {
  MotionDescriptor descriptor;
  descriptor.start_time_s = get_time(in);
  const std::size_t phases = in.get<std::uint8_t>();
  const Counts origin{in.get<std::int64_t>(), in.get<std::int64_t>()};
  for (const std::int64_t count : {origin.x, origin.y})
    require(std::abs(static_cast<double>(count)) < kMostCount / 2.0, "a place is out of range");
  for (std::size_t i = 0; i < phases; ++i) descriptor.phases.push_back(get_phase(in, origin));
  return std::make_shared<const Motion>(rebuild(descriptor));
}

void put_id(ByteWriter& out, const PromiseId& id, PromiseState state) {
  out.put(id.epoch);
  out.put(id.sequence);
  out.put(static_cast<std::uint8_t>(state));
}

void put_head(ByteWriter& out, const Promise& promise) {
  out.put(static_cast<std::uint8_t>(Kind::kPromise));
  put_name(out, promise.agent);
  put_id(out, promise.id, promise.state);
  out.put(static_cast<std::int32_t>(promise.priority));
  // Rounded up: nobody may take a robot for smaller than it is.
  const double radius_mm = std::ceil(promise.footprint_radius_m * kRadii - 1e-6);
  put_number<std::uint16_t>(out, radius_mm, 1.0, "footprint_radius");
}

Promise get_promise(ByteReader& in) {
  Promise promise;
  promise.agent = get_name(in);
  promise.id.epoch = in.get<std::uint32_t>();
  promise.id.sequence = in.get<std::uint32_t>();
  promise.state = get_state(in);
  promise.priority = in.get<std::int32_t>();
  promise.footprint_radius_m = get_number<std::uint16_t>(in, kRadii);
  if (promise.state != PromiseState::kWithdrawn) promise.motion = get_motion(in);
  validate(promise);
  return promise;
}

Beat get_beat(ByteReader& in) {
  Beat beat;
  beat.agent = get_name(in);
  beat.epoch = in.get<std::uint32_t>();
  beat.stamp_s = get_time(in);
  const std::size_t entries = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < entries; ++i) {
    Seen seen;
    seen.agent = get_name(in);
    seen.id.epoch = in.get<std::uint32_t>();
    seen.id.sequence = in.get<std::uint32_t>();
    seen.state = get_state(in);
    beat.seen.push_back(std::move(seen));
  }
  return beat;
}

std::vector<std::uint8_t> datagram(const ByteWriter& body) {
  mocha_lcm::datagram_t message;
  message.version = kWireVersion;
  require(body.bytes().size() < kMostDatagramBytes, "does not fit into one datagram");
  message.size = static_cast<std::int16_t>(body.bytes().size());
  message.body = body.bytes();
  std::vector<std::uint8_t> bytes(message.getEncodedSize());
  require(bytes.size() + kLcmHeader <= kMostDatagramBytes, "does not fit into one datagram");
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> encode(const Promise& promise) {
  validate(promise);
  ByteWriter body;
  put_head(body, promise);
  if (promise.state != PromiseState::kWithdrawn) put_motion(body, *promise.motion);
  return datagram(body);
}

std::vector<std::uint8_t> encode(const Beat& beat) {
  ByteWriter body;
  body.put(static_cast<std::uint8_t>(Kind::kBeat));
  put_name(body, beat.agent);
  body.put(beat.epoch);
  put_number<std::int64_t>(body, beat.stamp_s, kTimes, "the stamp");
  body.put(count_of(beat.seen.size(), "entries"));
  for (const Seen& seen : beat.seen) {
    put_name(body, seen.agent);
    put_id(body, seen.id, seen.state);
  }
  return datagram(body);
}

FleetMessage decode(const std::uint8_t* data, std::size_t size) {
  require(size >= kFrame && size <= kMostDatagramBytes, "no datagram has so many bytes");
  require(kFrame + std::size_t{256} * data[9] + data[10] == size, "its size is not what it says");
  mocha_lcm::datagram_t message;
  require(message.decode(data, 0, static_cast<int>(size)) == static_cast<int>(size),
          "is no datagram of this package");
  require(message.version == kWireVersion, "is of version " + std::to_string(message.version) +
                                               ", not " + std::to_string(kWireVersion));
  ByteReader in(message.body.data(), message.body.size());
  const auto kind = static_cast<Kind>(in.get<std::uint8_t>());
  require(kind == Kind::kPromise || kind == Kind::kBeat, "is of no known kind");
  FleetMessage decoded;
  if (kind == Kind::kPromise) {
    decoded = get_promise(in);
  } else {
    decoded = get_beat(in);
  }
  require(in.left() == 0, "goes on after its end");
  return decoded;
}

Promise quantised(const Promise& promise) {
  const std::vector<std::uint8_t> bytes = encode(promise);
  return std::get<Promise>(decode(bytes.data(), bytes.size()));
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
  ByteWriter body;
  try {
    put_head(body, promise);
    put_motion(body, motion);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return body.bytes().size() + kFrame + kLcmHeader <= kMostDatagramBytes;
}

}  // namespace mocha
