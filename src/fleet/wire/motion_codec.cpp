#include "fleet/wire/motion_codec.h"

#include <cmath>

#include "fleet/wire/message_fields.h"
#include "trajectory/descriptor.h"

namespace mocha {
namespace {

constexpr std::uint16_t kNoLimit = 0xffff;  // of the acceleration, while a robot brakes

/// Counted from the beginning of the motion.
void put_place(ByteWriter& out, const Vector2& place, const PlaceCounts& origin) {
  const PlaceCounts counts = counts_of(place);
  put_number<std::int32_t>(out, static_cast<double>(counts.x - origin.x), 1.0, "x");
  put_number<std::int32_t>(out, static_cast<double>(counts.y - origin.y), 1.0, "y");
}

Vector2 get_place(ByteReader& in, const PlaceCounts& origin) {
  const std::int64_t x = origin.x + in.get<std::int32_t>();
  const std::int64_t y = origin.y + in.get<std::int32_t>();
  return place_of({x, y});
}

void put_phase(ByteWriter& out, const PhaseDescriptor& phase, const PlaceCounts& origin) {
  out.put(static_cast<std::uint8_t>(phase.kind));
  if (phase.kind != PhaseDescriptor::Kind::kDrive) {
    put_number<std::int32_t>(out, phase.yaw_start_rad, kFine, "a heading");
    if (phase.kind == PhaseDescriptor::Kind::kTurn) {
      put_number<std::int32_t>(out, phase.yaw_change_rad, kFiner, "a turn");
      for (const TurnRates& rates : {phase.start_rates, phase.end_rates}) {
        put_number<std::int32_t>(out, rates.yaw_rate, kFine, "a yaw rate");
        put_number<std::int32_t>(out, rates.yaw_acceleration, kFine, "a yaw acceleration");
      }
    }
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

PhaseDescriptor get_phase(ByteReader& in, const PlaceCounts& origin) {
  PhaseDescriptor phase;
  const auto kind = in.get<std::uint8_t>();
  require_said(kind <= static_cast<int>(PhaseDescriptor::Kind::kStand),
               "a phase is of no known kind");
  phase.kind = static_cast<PhaseDescriptor::Kind>(kind);
  std::size_t pieces = 1;
  std::size_t points = 1;
  if (phase.kind != PhaseDescriptor::Kind::kDrive) {
    phase.yaw_start_rad = get_number<std::int32_t>(in, kFine);
    if (phase.kind == PhaseDescriptor::Kind::kTurn) {
      phase.yaw_change_rad = get_number<std::int32_t>(in, kFiner);
      for (TurnRates* rates : {&phase.start_rates, &phase.end_rates}) {
        rates->yaw_rate = get_number<std::int32_t>(in, kFine);
        rates->yaw_acceleration = get_number<std::int32_t>(in, kFine);
      }
    }
  } else {
    const auto forward = in.get<std::uint8_t>();
    require_said(forward <= 1, "a drive's direction is neither 1 nor 0");
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

}  // namespace

void put_braking(ByteWriter& out, const Braking& braking) {
  put_number<std::uint16_t>(out, braking.deceleration(), kBrakings, "deceleration");
  if (std::isinf(braking.max_acceleration())) return out.put(kNoLimit);
  put_number<std::uint16_t>(out, braking.max_acceleration(), kBrakings, "max_acceleration");
}

Braking get_braking(ByteReader& in) {
  const double deceleration = get_number<std::uint16_t>(in, kBrakings);
  const auto limit = in.get<std::uint16_t>();
  return limit == kNoLimit ? Braking(deceleration)
                           : Braking(deceleration, static_cast<double>(limit) / kBrakings);
}

void put_motion(ByteWriter& out, const Motion& motion) {
  require_said(!motion.empty(), "there is no motion");
  const MotionDescriptor descriptor = describe(motion);
  put_number<std::int64_t>(out, descriptor.start_time_s, kTimes, "the start");
  out.put(count_of(descriptor.phases.size(), "phases"));
  const PlaceCounts origin = counts_of(descriptor.phases.front().points.front());
  out.put(origin.x);
  out.put(origin.y);
  for (const PhaseDescriptor& phase : descriptor.phases) put_phase(out, phase, origin);
}

std::shared_ptr<const Motion> get_motion(ByteReader& in) {
  MotionDescriptor descriptor;
  descriptor.start_time_s = get_time(in);
  const std::size_t phases = in.get<std::uint8_t>();
  const PlaceCounts origin{in.get<std::int64_t>(), in.get<std::int64_t>()};
  for (const std::int64_t count : {origin.x, origin.y})
    require_said(std::abs(static_cast<double>(count)) < kMostPlaceCount, "x or y is out of range");
  for (std::size_t i = 0; i < phases; ++i) descriptor.phases.push_back(get_phase(in, origin));
  return std::make_shared<const Motion>(rebuild(descriptor));
}

}  // namespace mocha
