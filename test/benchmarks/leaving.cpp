// A robot leaves where it stands close to walls, through its whole stack. Prints JSON. Arguments: a
// model, a place (wall, corner, dead_end), the gap to the walls in m, and how many headings to try,
// evenly spread (of a dead end: nose in and nose out).

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <string>

#include "benchmarks/leaving_oracle.h"
#include "benchmarks/leaving_run.h"
#include "benchmarks/leaving_scene.h"

namespace mocha {
namespace {

const std::map<std::string, TightKind> kKinds = {
    {"wall", TightKind::kWall}, {"corner", TightKind::kCorner}, {"dead_end", TightKind::kDeadEnd}};

const char* text(bool value) { return value ? "true" : "false"; }

std::string quoted(const std::string& words) {
  std::string text = "\"";
  for (const char c : words)
    text += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
  return text + "\"";
}

double yaw_rad(TightKind kind, int i, int headings) {
  if (kind == TightKind::kDeadEnd) return i == 0 ? -0.5 * M_PI : 0.5 * M_PI;
  return 2.0 * M_PI * i / headings;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// An exception of the stack is a failure like any other: its node would die.
LeavingRun run_or_words(const World& world, std::uint64_t seed) {
  try {
    return run_leaving(world, seed);
  } catch (const std::exception& error) {
    LeavingRun run;
    run.words = std::string("an exception: ") + error.what();
    return run;
  }
}

void print_row(const RobotModel& robot, const TightStart& start, std::uint64_t seed) {
  const World world = leaving_world(robot, start);
  auto begin = std::chrono::steady_clock::now();
  const Leavable can = leavable(world);
  const double search_s = seconds_since(begin);
  std::printf("{\"heading_deg\": %.1f, \"can_leave\": %s, \"touches\": %s, \"search_s\": %.3f",
              start.yaw_rad * 180.0 / M_PI, text(can == Leavable::kYes),
              text(can == Leavable::kTouches), search_s);
  if (can != Leavable::kTouches) {
    begin = std::chrono::steady_clock::now();
    const LeavingRun run = run_or_words(world, seed);
    std::printf(", \"left\": %s, \"contact\": %s, \"left_s\": %s, \"took_s\": %.2f",
                text(run.arrived), text(run.contact),
                run.left_s ? std::to_string(*run.left_s).c_str() : "null", run.took_s);
    std::printf(", \"clearance_m\": %.4f, \"slowest_plan_s\": %.3f, \"run_s\": %.2f, \"words\": %s",
                run.clearance_m, run.slowest_plan_s, seconds_since(begin),
                quoted(run.words).c_str());
  }
  std::printf("}");
  std::fflush(stdout);
}

void print_rows(const std::string& model, TightKind kind, double gap_m, int headings) {
  const RobotModel robot = leaving_model(model);
  const int count = kind == TightKind::kDeadEnd ? 2 : headings;
  std::printf("{\"rows\": [");
  for (int i = 0; i < count; ++i) {
    if (i > 0) std::printf(",\n  ");
    print_row(robot, {kind, gap_m, yaw_rad(kind, i, headings)}, i + 1);
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 5 || mocha::kKinds.count(argv[2]) == 0) return 2;
  mocha::print_rows(argv[1], mocha::kKinds.at(argv[2]), std::atof(argv[3]), std::atoi(argv[4]));
}
