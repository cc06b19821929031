// All that can happen to two and three robots of the commitment protocol, to the depth of
// long_scenarios(). Prints JSON. Arguments: number of a scenario from 0 on, states at most.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "fleet/model/explorer.h"
#include "fleet/model/scenarios.h"

namespace mocha {
namespace {

using test::Exploration;
using test::Harm;
using test::Scenario;

void print_harm(const Harm& harm) {
  const auto& [losses, delays, duplicates, restarts, cuts, brakes] = harm;
  std::printf("\"losses\": %d, \"delays\": %d, \"duplicates\": %d, ", losses, delays, duplicates);
  std::printf("\"restarts\": %d, \"cuts\": %d, \"brakes\": %d, ", restarts, cuts, brakes);
}

void print_counterexample(const Exploration& found) {
  std::printf("\"violation\": \"%s\", \"counterexample\": [", found.violation.c_str());
  const char* separator = "";
  for (const std::string& line : found.counterexample) {
    std::printf("%s\n\"%s\"", separator, line.c_str());
    separator = ",";
  }
  std::printf("]");
}

void print_row(const Scenario& scenario, std::size_t most_states) {
  const auto begin = std::chrono::steady_clock::now();
  const Exploration found = test::explore(scenario, most_states);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  std::printf("{\"scenario\": \"%s\", \"robots\": %d, ", scenario.name.c_str(), scenario.size());
  print_harm(scenario.harm);
  std::printf("\"states\": %zu, \"transitions\": %zu, \"depth\": %d, ", found.states,
              found.transitions, found.depth);
  std::printf("\"complete\": %s, \"seconds\": %.3f, ", found.complete ? "true" : "false",
              taken.count());
  print_counterexample(found);
  std::printf("}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  const std::vector<mocha::test::Scenario> scenarios = mocha::test::long_scenarios();
  const std::size_t number = argc == 3 ? std::strtoul(argv[1], nullptr, 10) : scenarios.size();
  if (number >= scenarios.size()) {
    std::fprintf(stderr, "usage: benchmark_protocol SCENARIO STATES, of %zu scenarios\n",
                 scenarios.size());
    return 1;
  }
  mocha::print_row(scenarios[number], std::strtoul(argv[2], nullptr, 10));
}
