#include "fleet/wire/passing_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fleet/wire/message_fields.h"

namespace mocha {
namespace {

// What an intent says, as bits.
constexpr std::uint8_t kCalls = 1;
constexpr std::uint8_t kHasGoal = 2;
constexpr std::uint8_t kFollows = 4;
constexpr std::uint8_t kHasObstacles = 8;

/// Of either sign: the nearer to zero, the shorter.
void put_step(ByteWriter& out, std::int64_t step) {
  out.put_varint((static_cast<std::uint64_t>(step) << 1) ^ static_cast<std::uint64_t>(step >> 63));
}

std::int64_t get_step(ByteReader& in) {
  const std::uint64_t folded = in.get_varint();
  const auto step = static_cast<std::int64_t>(folded >> 1) ^ -static_cast<std::int64_t>(folded & 1);
  require_said(std::abs(static_cast<double>(step)) < kMostCount, "a place is out of range");
  return step;
}

/// From `before`, which becomes this place.
void put_next_place(ByteWriter& out, const Vector2& place, PlaceCounts& before) {
  const PlaceCounts counts = counts_of(place);
  put_step(out, counts.x - before.x);
  put_step(out, counts.y - before.y);
  before = counts;
}

Vector2 get_next_place(ByteReader& in, PlaceCounts& before) {
  before.x += get_step(in);
  before.y += get_step(in);
  return place_of(before);
}

std::uint32_t get_count(ByteReader& in) {
  const std::uint64_t count = in.get_varint();
  require_said(count <= std::numeric_limits<std::uint32_t>::max(), "a count is out of range");
  return static_cast<std::uint32_t>(count);
}

void put_turn(ByteWriter& out, const PassingTurn& turn, PlaceCounts& before) {
  out.put(count_of(turn.path.size(), "places"));
  for (const Vector2& place : turn.path) put_next_place(out, place, before);
  out.put(count_of(turn.after.size(), "robots to wait for"));
  for (const PassingProgress& progress : turn.after) {
    out.put_varint(progress.robot);
    out.put_varint(progress.moves);
  }
}

PassingTurn get_turn(ByteReader& in, PlaceCounts& before) {
  PassingTurn turn;
  const std::size_t places = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < places; ++i) turn.path.push_back(get_next_place(in, before));
  const std::size_t others = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < others; ++i) {
    const std::uint32_t robot = get_count(in);
    turn.after.push_back({robot, get_count(in)});
  }
  return turn;
}

}  // namespace

void put_intent(ByteWriter& out, const PassingIntent& intent) {
  const bool follows = intent.follows.number > 0;
  out.put(static_cast<std::uint8_t>((intent.calls ? kCalls : 0) | (intent.goal ? kHasGoal : 0) |
                                    (follows ? kFollows : 0) |
                                    (intent.obstacles.empty() ? 0 : kHasObstacles)));
  out.put(static_cast<std::int32_t>(intent.priority));
  // Rounded up: a robot must not be taken for smaller than it is.
  put_number<std::uint16_t>(out, std::ceil(intent.radius_m * kRadii - 1e-6), 1.0, "the radius");
  PlaceCounts before;
  if (intent.goal) put_next_place(out, *intent.goal, before);
  if (follows) {
    put_name(out, intent.follows.leader);
    out.put_varint(intent.follows.number);
  }
  out.put_varint(intent.moves);
  if (intent.obstacles.empty()) return;
  out.put(count_of(intent.obstacles.size(), "obstacles"));
  for (const Vector2& place : intent.obstacles) put_next_place(out, place, before);
}

PassingIntent get_intent(ByteReader& in, std::string agent, std::uint32_t epoch) {
  PassingIntent intent;
  intent.agent = std::move(agent);
  intent.epoch = epoch;
  const auto said = in.get<std::uint8_t>();
  require_said(said <= (kCalls | kHasGoal | kFollows | kHasObstacles),
               "an intent says what is not known");
  intent.calls = (said & kCalls) != 0;
  intent.priority = in.get<std::int32_t>();
  intent.radius_m = get_number<std::uint16_t>(in, kRadii);
  PlaceCounts before;
  if ((said & kHasGoal) != 0) intent.goal = get_next_place(in, before);
  if ((said & kFollows) != 0) {
    intent.follows.leader = get_name(in);
    intent.follows.number = get_count(in);
  }
  intent.moves = get_count(in);
  const std::size_t obstacles = (said & kHasObstacles) != 0 ? in.get<std::uint8_t>() : 0;
  for (std::size_t i = 0; i < obstacles; ++i)
    intent.obstacles.push_back(get_next_place(in, before));
  validate(intent);
  return intent;
}

void put_instruction(ByteWriter& out, const PassingInstruction& instruction) {
  const std::vector<std::string>& robots = instruction.robots;
  out.put_varint(instruction.id.number);
  out.put(count_of(robots.size(), "robots"));
  for (const std::string& robot : robots) put_name(out, robot);
  const auto self = std::find(robots.begin(), robots.end(), instruction.robot);
  out.put(static_cast<std::uint8_t>(self - robots.begin()));
  out.put_varint(instruction.turns);
  out.put_varint(instruction.alone_from);
  out.put_varint(instruction.first);
  out.put_varint(instruction.part.size());
  PlaceCounts before;
  for (const PassingTurn& turn : instruction.part) put_turn(out, turn, before);
}

PassingInstruction get_instruction(ByteReader& in, std::string leader, std::uint32_t epoch) {
  PassingInstruction instruction;
  instruction.id = {std::move(leader), epoch, get_count(in)};
  const std::size_t robots = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < robots; ++i) instruction.robots.push_back(get_name(in));
  const std::size_t self = in.get<std::uint8_t>();
  require_said(self < robots, "an instruction is for a robot that its order is not for");
  instruction.robot = instruction.robots[self];
  instruction.turns = get_count(in);
  instruction.alone_from = get_count(in);
  instruction.first = get_count(in);
  PlaceCounts before;
  for (std::uint32_t left = get_count(in); left > 0; --left)
    instruction.part.push_back(get_turn(in, before));
  validate(instruction);
  return instruction;
}

}  // namespace mocha
