#include "simulation/contact_watch.h"

namespace mocha {
namespace {

constexpr double kApart_m = 0.01;

}  // namespace

bool ContactWatch::begins(const std::string& first, const std::string& second, double distance_m,
                          bool moving) {
  if (distance_m > kApart_m) touching_.erase({first, second});
  return distance_m < 0.0 && moving && touching_.insert({first, second}).second;
}

}  // namespace mocha
