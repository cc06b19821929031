// What can be solved in worlds with movers that heed no robot, knowing the future and on sight.
// Prints JSON. Arguments: BEGIN_S, before which the robot does not move, LIMIT_S, both in the time
// of the world, and world files. The first robot of each is asked about.

#include <cstdio>
#include <cstdlib>

#include "benchmarks/sighted_drive.h"

namespace mocha {
namespace {

/// What drives on sight keep more for each second of prediction [m/s].
constexpr double kGrowths[] = {0.1, 0.2, 0.3};

void print_time(const char* key, const std::optional<double>& time_s) {
  if (time_s) {
    std::printf("\"%s\": %.2f", key, *time_s);
  } else {
    std::printf("\"%s\": null", key);
  }
}

void print_drive(const SightedDrive& drive, double growth_mps) {
  std::printf("{\"growth_mps\": %g, ", growth_mps);
  print_time("arrival_s", drive.arrival_s);
  std::printf(", \"contacts\": [");
  for (const DriveContact& contact : drive.contacts) {
    std::printf("%s{\"time_s\": %.2f, \"x\": %.2f, \"y\": %.2f, \"blame\": \"%s\", \"known\": %s}",
                &contact == &drive.contacts.front() ? "" : ", ", contact.time_s, contact.place.x(),
                contact.place.y(), contact.blame, contact.was_known ? "true" : "false");
  }
  std::printf("]}");
}

void print_world(const char* path, double begin_s, double limit_s) {
  const World world = load_world(path, "config");
  std::printf("{\"world\": \"%s\", ", path);
  print_time("knowing_s",
             arrival_time_s(problem_of(world, begin_s), solver_options(world, begin_s, limit_s)));
  std::optional<double> seeing_s;
  std::printf(", \"drives\": [");
  for (const double growth_mps : kGrowths) {
    const SightedDrive drive = drive_on_sight(world, begin_s, limit_s, {growth_mps, 0.5});
    if (drive.arrival_s && (!seeing_s || *drive.arrival_s < *seeing_s)) seeing_s = drive.arrival_s;
    if (growth_mps != kGrowths[0]) std::printf(", ");
    print_drive(drive, growth_mps);
  }
  std::printf("], ");
  print_time("seeing_s", seeing_s);
  std::printf("}");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  std::printf("{\"rows\": [");
  for (int i = 3; i < argc; ++i) {
    if (i > 3) std::printf(",\n");
    mocha::print_world(argv[i], std::atof(argv[1]), std::atof(argv[2]));
  }
  std::printf("]}\n");
}
