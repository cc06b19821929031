#include "safety/violation.h"

#include <cmath>
#include <cstdio>

namespace mocha {
namespace {

struct Wording {
  const char* quantity;
  const char* unit;
  bool is_minimum;
  const char* jump;
};

Wording wording(ViolatedTerm term) {
  switch (term) {
    case ViolatedTerm::kClearance:
      return {"clearance to obstacles", "m", true, ""};
    case ViolatedTerm::kSpeed:
      return {"speed", "m/s", false, "place jumps, "};
    case ViolatedTerm::kAcceleration:
      return {"acceleration", "m/s^2", false, "velocity jumps, "};
    case ViolatedTerm::kYawRate:
      return {"yaw rate", "rad/s", false, "heading flips, "};
    case ViolatedTerm::kSeparation:
      return {"distance", "m", true, ""};
    case ViolatedTerm::kUnseenSpace:
      return {"clearance to space not seen free", "m", true, ""};
    case ViolatedTerm::kWheelSpeed:
      return {"wheel speed", "m/s", false, ""};
    case ViolatedTerm::kSpeedBackward:
      return {"speed backward", "m/s", false, ""};
    case ViolatedTerm::kZoneSpeed:
      return {"speed in zone", "m/s", false, ""};
    case ViolatedTerm::kNothing:
      break;
  }
  return {"nothing", "", false, ""};
}

/// Three, or as many as tell the numbers apart; six at most.
int decimals(double a, double b) {
  int count = 3;
  for (double scale = 1e3; count < 6 && std::round(scale * a) == std::round(scale * b); ++count)
    scale *= 10.0;
  return count;
}

template <int D>
std::string in_words(const BasicViolation<D>& violation) {
  if (!violation) return "no violation";
  const Wording words = wording(violation.term);
  std::string quantity = words.quantity;
  if (violation.term == ViolatedTerm::kZoneSpeed)
    quantity += " `" + violation.peer + "`";
  else if (!violation.peer.empty())
    quantity += " to " + violation.peer;
  if (std::isinf(violation.value)) quantity = words.jump + quantity;
  const int digits = decimals(violation.value, violation.limit);
  char text[256];
  std::snprintf(text, sizeof(text), " %.*f %s, %s %.*f, at ", digits, violation.value, words.unit,
                words.is_minimum ? "needs" : "limit", digits, violation.limit);
  std::string sentence = quantity + text;
  for (int axis = 0; axis < D; ++axis) {
    std::snprintf(text, sizeof(text), "%s%.2f", axis == 0 ? "(" : ", ", violation.place[axis]);
    sentence += text;
  }
  return sentence + ")";
}

}  // namespace

std::string describe(const BasicViolation<2>& violation) { return in_words(violation); }
std::string describe(const BasicViolation<3>& violation) { return in_words(violation); }

}  // namespace mocha
