// A robot on a network that sends it everything: datagrams of the right form, broken in all places,
// sealed again where there is a key, in all orders. Built with the sanitizers; whatever they or the
// checks below find ends the program with a status that is not 0.
//
//   fuzz_datagrams COUNT SEED

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "fleet/protocol/commitment_protocol.h"
#include "fleet/protocol/motions.h"
#include "fleet/protocol/shipped_options.h"
#include "fleet/wire/datagram_link.h"
#include "fleet/wire/passing_parts.h"
#include "fuzz/oddities.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

using Bytes = DatagramLink::Bytes;

constexpr double kNow_s = 1.7e9;
constexpr std::size_t kSealAt = 10;  // of a datagram
constexpr std::size_t kSizeAt = 26;
constexpr std::size_t kBodyAt = 28;
constexpr std::size_t kEpochAt = kBodyAt + 6;  // where the name has four letters
constexpr std::size_t kNumberAt = kBodyAt + 10;
constexpr int kLifetime =
    2000;  // datagrams, after which a robot that hears no peer any more is replaced

class Fuzzer {
 public:
  Fuzzer(unsigned seed, bool keyed)
      : random_(seed),
        key_(FleetKey::Secret{7}),
        keyed_(keyed),
        robot_(test::shipped_options("ugv1")),
        link_("ugv1", keyed ? std::optional<FleetKey>(key_) : std::nullopt) {
    robot_.brake({1, 0.3, test::kRoverBraking, test::shared(test::stand(now_s_, {0.0, 0.0}))},
                 now_s_);
    for (int i = 0; i < 40; ++i) corpus_.push_back(sound());
  }

  void run(int count) {
    for (int i = 0; i < count; ++i) {
      step(mutant());
      if (i % 50 == 0) advance();
    }
    require(robot_.peers().peers().size() <= PeerTable::kMostPeers, "there are too many peers");
  }

  const DatagramLink::Counts& counts() const { return link_.counts(); }
  double slowest_s() const { return slowest_s_; }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  FleetMessage any_message() {
    const std::string agent = "ugv" + std::to_string(1 + below(5));
    const auto epoch = static_cast<std::uint32_t>(1 + below(3));
    if (below(3) == 0) {
      Heartbeat heartbeat{agent, epoch, now_s_ - 0.01 * below(100), {}, {}};
      for (int i = below(4); i > 0; --i) {
        const auto state = static_cast<TrajectoryState>(1 + below(4));
        heartbeat.acknowledgements.push_back(
            {"ugv" + std::to_string(1 + below(5)), {epoch, 1U + below(9)}, state});
        heartbeat.echoes.push_back(
            {"ugv" + std::to_string(1 + below(3)), now_s_ - 0.1, 0.01 * below(9)});
      }
      return heartbeat;
    }
    if (below(4) == 0) return any_intent(agent, epoch);
    if (below(4) == 0) return any_instruction(agent, epoch);
    if (below(4) == 0) {
      FleetStops stops{agent, epoch, {}};
      for (int i = below(4); i > 0; --i) {
        const auto ordered = static_cast<std::uint64_t>(1 + below(9));
        stops.stops.push_back({"ugv" + std::to_string(1 + below(5)), ordered,
                               ordered - static_cast<std::uint64_t>(below(2)), now_s_, "told"});
      }
      return stops;
    }
    CommittedTrajectory trajectory{agent,
                                   {epoch, 1U + below(9)},
                                   static_cast<TrajectoryState>(1 + below(4)),
                                   below(3),
                                   0.3,
                                   Braking(0.5 * (1 + below(4))),
                                   nullptr};
    if (trajectory.state != TrajectoryState::kWithdrawn)
      trajectory.motion =
          test::shared(test::random_drive(random_, now_s_ + 0.1 * below(20), 2 + below(8), 4.0));
    return trajectory;
  }

  PassingIntent any_intent(const std::string& agent, std::uint32_t epoch) {
    PassingIntent intent;
    intent.agent = agent;
    intent.epoch = epoch;
    intent.priority = below(3);
    intent.calls = below(2) == 0;
    intent.radius_m = 0.3;
    if (below(3) != 0) intent.goal = Vector2(below(40), below(40));
    if (below(3) != 0) intent.follows = {"ugv" + std::to_string(1 + below(5)), 0, 1U + below(9)};
    intent.moves = below(40);
    for (int left = below(4); left > 0; --left) intent.obstacles.emplace_back(below(40), below(40));
    return intent;
  }

  PassingInstruction any_instruction(const std::string& agent, std::uint32_t epoch) {
    PassingInstruction whole;
    whole.id = {agent, epoch, 1U + below(9)};
    for (int i = 1; i <= 5; ++i) whole.robots.push_back("ugv" + std::to_string(i));
    whole.robot = whole.robots[below(5)];
    whole.turns = below(below(20) == 0 ? 400 : 20);
    whole.alone_from = below(static_cast<int>(whole.turns) + 1);
    Vector2 place(below(40), below(40));
    for (std::uint32_t i = 0; i < whole.turns; ++i) {
      const Vector2 end = place + 0.01 * Vector2(below(99), below(99));
      whole.part.push_back({{place, end}, {}});
      const auto other = static_cast<std::uint32_t>(below(5));
      if (whole.robots[other] != whole.robot)
        whole.part.back().after.push_back({other, static_cast<std::uint32_t>(below(40))});
      place = end;
    }
    return fitting_part(whole, below(2) * whole.turns / 3);
  }

  Bytes sound() { return encode({0, any_message()}, keyed_ ? &key_ : nullptr); }

  std::uint8_t strange() {
    constexpr std::uint8_t kEdges[] = {0x00, 0x01, 0x7f, 0x80, 0xff};
    return below(2) == 0 ? kEdges[below(5)] : static_cast<std::uint8_t>(below(256));
  }

  Bytes mutant() {
    Bytes bytes = corpus_[below(static_cast<int>(corpus_.size()))];
    const int changes = below(5);
    for (int i = 0; i < changes; ++i) change(bytes);
    if (below(4) != 0 && bytes.size() >= kBodyAt) repair(bytes);
    return bytes;
  }

  void change(Bytes& bytes) {
    if (bytes.empty()) return;
    const int at = below(static_cast<int>(bytes.size()));
    const int span = std::min(below(9), static_cast<int>(bytes.size()) - at);
    switch (below(6)) {
      case 0:
        bytes[at] ^= static_cast<std::uint8_t>(1 << below(8));
        break;
      case 1:
        for (int i = 0; i < span; ++i) bytes[at + i] = strange();
        break;
      case 2:
        bytes.erase(bytes.begin() + at, bytes.begin() + at + span);
        break;
      case 3:
        bytes.insert(bytes.begin() + at, span, strange());
        break;
      case 4: {  // the end of another one
        const Bytes& other = corpus_[below(static_cast<int>(corpus_.size()))];
        const auto from = std::min<std::size_t>(at, other.size());
        bytes.resize(at);
        bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
        break;
      }
      default:
        bytes.resize(below(1600), strange());
    }
  }

  /// Gives it the frame of a datagram again, a new number, and the seal: so what is wrong inside is
  /// met.
  void repair(Bytes& bytes) {
    const Bytes& frame = corpus_[0];
    std::copy_n(frame.begin(), kSealAt, bytes.begin());
    std::fill_n(bytes.begin() + kSealAt, FleetKey::kSealBytes, std::uint8_t{0});
    bytes[kSizeAt] = static_cast<std::uint8_t>((bytes.size() - kBodyAt) >> 8);
    bytes[kSizeAt + 1] = static_cast<std::uint8_t>(bytes.size() - kBodyAt);
    const bool next_epoch = below(500) == 0;
    epoch_ += next_epoch;
    put(epoch_, kEpochAt, bytes);
    put(++number_, kNumberAt, bytes);
    if (!keyed_) return;
    const FleetKey::Seal seal = key_.seal(bytes.data(), bytes.size());
    std::copy(seal.begin(), seal.end(), bytes.begin() + kSealAt);
  }

  static void put(std::uint32_t value, std::size_t at, Bytes& bytes) {
    for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
      bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }

  void step(const Bytes& bytes) {
    const auto begin = std::chrono::steady_clock::now();
    if (const auto message = link_.unpack(bytes.data(), bytes.size())) {
      now_s_ += 1e-4;
      take(*message);
    }
    const auto took = std::chrono::steady_clock::now() - begin;
    slowest_s_ = std::max(slowest_s_, std::chrono::duration<double>(took).count());
  }

  void take(const FleetMessage& message) {
    if (const auto* trajectory = std::get_if<CommittedTrajectory>(&message)) {
      answer(robot_.receive(*trajectory, now_s_));
    } else if (const auto* heartbeat = std::get_if<Heartbeat>(&message)) {
      answer(robot_.receive(*heartbeat, now_s_));
    } else if (const auto* stops = std::get_if<FleetStops>(&message)) {
      validate(*stops);
      stop_.receive(*stops, now_s_);
      require(stop_.record().fleet.size() <= EmergencyStop::kMostAgents,
              "too many stops are known");
    } else if (const auto* intent = std::get_if<PassingIntent>(&message)) {
      validate(*intent);
    } else {
      take(std::get<PassingInstruction>(message));
    }
  }

  /// What was heard can be said on, in parts.
  static void take(const PassingInstruction& instruction) {
    validate(instruction);
    const PassingInstruction part = fitting_part(quantised(instruction), instruction.first);
    require(part.part.empty() || fits(part), "a part does not fit into a datagram");
  }

  /// Its own words are those of a sound robot, whatever it hears.
  void answer(const CommitmentActions& actions) {
    for (const CommittedTrajectory& trajectory : actions.trajectories) link_.pack(trajectory);
    if (actions.heartbeat) link_.pack(*actions.heartbeat);
  }

  void advance() {
    now_s_ += 0.02;
    answer(robot_.tick(now_s_));
    for (const FleetStops& stops : stop_.tick(now_s_)) link_.pack(stops);
    if (below(100) == 0) stop_.stop_fleet(now_s_, "fuzz");
    if (below(10) == 0) corpus_[below(static_cast<int>(corpus_.size()))] = sound();
    if (below(20) != 0) return;
    const Vector2 here = robot_.binding().position(now_s_ + 0.5);
    const Vector2 there = 0.01 * Vector2(below(400) - 200, below(400) - 200);
    if ((there - here).norm() < 0.1) return;
    answer(robot_.propose({2, 0.3, test::kRoverBraking,
                           test::shared(quantised(test::drive(now_s_ + 0.5, {here, there}, 1.0)))},
                          now_s_));
  }

  std::mt19937 random_;
  const FleetKey key_;
  const bool keyed_;
  double now_s_ = kNow_s;
  CommitmentProtocol robot_;
  EmergencyStop stop_{"ugv1", 1, {}};
  DatagramLink link_;
  std::vector<Bytes> corpus_;
  std::uint32_t epoch_ = 1;
  std::uint32_t number_ = 0;
  double slowest_s_ = 0.0;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: fuzz_datagrams COUNT SEED\n");
    return 2;
  }
  const int lives = std::atoi(argv[1]) / 2 / mocha::kLifetime;
  for (const bool keyed : {false, true}) {
    int taken = 0;
    int malformed = 0;
    double slowest_s = 0.0;
    for (int life = 0; life < lives; ++life) {
      mocha::Fuzzer fuzzer(static_cast<unsigned>(std::atoi(argv[2]) + life), keyed);
      fuzzer.run(mocha::kLifetime);
      taken += fuzzer.counts().taken;
      malformed += fuzzer.counts().malformed;
      slowest_s = std::max(slowest_s, fuzzer.slowest_s());
    }
    const int sent = lives * mocha::kLifetime;
    std::printf("%s: %d datagrams, %d taken, %d malformed, the slowest took %.4f s\n",
                keyed ? "with a key" : "without a key", sent, taken, malformed, slowest_s);
    mocha::require(taken > sent / 20, "hardly anything was taken: mutants are too wild");
    mocha::require(malformed > sent / 20, "hardly anything was refused: mutants are too tame");
  }
  return 0;
}
