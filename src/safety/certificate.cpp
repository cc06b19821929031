#include "safety/certificate.h"

#include <cmath>
#include <cstdio>

namespace mocha {
namespace {

struct Wording {
  const char* quantity;
  const char* unit;
  bool is_minimum;
};

Wording wording(ViolatedTerm term) {
  switch (term) {
    case ViolatedTerm::kClearance:
      return {"clearance to obstacles", "m", true};
    case ViolatedTerm::kSpeed:
      return {"speed", "m/s", false};
    case ViolatedTerm::kAcceleration:
      return {"acceleration", "m/s^2", false};
    case ViolatedTerm::kYawRate:
      return {"yaw rate", "rad/s", false};
    case ViolatedTerm::kSeparation:
      return {"distance", "m", true};
    case ViolatedTerm::kUnseenSpace:
      return {"clearance to space not seen free", "m", true};
    case ViolatedTerm::kNothing:
      break;
  }
  return {"nothing", "", false};
}

}  // namespace

std::string describe(const Violation& violation) {
  if (!violation) return "no violation";
  const Wording words = wording(violation.term);
  std::string quantity = words.quantity;
  if (!violation.peer.empty()) quantity += " to " + violation.peer;
  if (std::isinf(violation.value)) quantity = "heading flips, " + quantity;
  char text[256];
  std::snprintf(text, sizeof(text), " %.3f %s, %s %.3f, from t = %.3f s at (%.2f, %.2f)",
                violation.value, words.unit, words.is_minimum ? "needs" : "limit", violation.limit,
                violation.time_s, violation.place.x(), violation.place.y());
  return quantity + text;
}

}  // namespace mocha
