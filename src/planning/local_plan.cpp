#include "planning/local_plan.h"

#include <cmath>

namespace mocha {

std::vector<MovingThing> foreseen(std::vector<MovingThing> things) {
  for (MovingThing& thing : things) {
    if (std::isinf(thing.obstacle->rest_time())) thing.until_s = thing.obstacle->rest_time();
  }
  return things;
}

}  // namespace mocha
