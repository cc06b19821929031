#pragma once

#include <map>
#include <string>
#include <vector>

#include "fleet/protocol/passing_messages.h"

namespace mocha {

/// The last words of team-mates about passing. Words lapse: a robot that stops talking is through,
/// or gone.
class HeardIntents {
 public:
  enum class Heard {
    kNews,
    kNothingNew,
    kNoRoom,  ///< for another name: it is not heeded
  };
  Heard hear(const PassingIntent& intent, double now_s);
  /// Those that have not lapsed.
  std::vector<PassingIntent> all(double now_s) const;
  /// The same of one robot; null where there is none.
  const PassingIntent* of(const std::string& name, double now_s) const;

 private:
  struct Said {
    PassingIntent intent;
    double time_s;
  };
  std::map<std::string, Said> said_;
};

/// Whether it says anything that matters and was not said before.
bool is_news(const PassingIntent& before, const PassingIntent& now);

}  // namespace mocha
