// What can be solved in worlds with movers that heed no robot, knowing the future and on sight.
// Prints JSON. Arguments: BEGIN_S, before which the robot does not move, LIMIT_S, both in the time
// of the world, and world files. The first robot of each is asked about.

#include <cstdio>
#include <cstdlib>

#include "benchmarks/sighted_drive.h"

namespace mocha {
namespace {

/// Of the drives on sight; the faster ones search twice as often.
constexpr SightOptions kSights[] = {{0.1, 0.5},  {0.2, 0.5},  {0.3, 0.5},
                                    {0.1, 0.25}, {0.2, 0.25}, {0.3, 0.25}};

void print_time(const char* key, const std::optional<double>& time_s) {
  if (time_s) {
    std::printf("\"%s\": %.2f", key, *time_s);
  } else {
    std::printf("\"%s\": null", key);
  }
}

void print_drive(const SightedDrive& drive, const SightOptions& sight) {
  std::printf("{\"growth_mps\": %g, \"replan_s\": %g, ", sight.growth_mps, sight.replan_s);
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
  for (const SightOptions& sight : kSights) {
    const SightedDrive drive = drive_on_sight(world, begin_s, limit_s, sight);
    if (drive.arrival_s && (!seeing_s || *drive.arrival_s < *seeing_s)) seeing_s = drive.arrival_s;
    if (&sight != kSights) std::printf(", ");
    print_drive(drive, sight);
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
