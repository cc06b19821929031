#include "planning/executive/heard_intents.h"

namespace mocha {
namespace {

constexpr double kSilence_s = 1.5;
constexpr std::size_t kMostHeard = 256;

}  // namespace

bool is_news(const PassingIntent& before, const PassingIntent& now) {
  return now.calls != before.calls || now.follows != before.follows || now.moves != before.moves ||
         now.obstacles != before.obstacles;
}

HeardIntents::Heard HeardIntents::hear(const PassingIntent& intent, double now_s) {
  for (auto it = said_.begin(); it != said_.end();)
    it = now_s < it->second.time_s + kSilence_s ? std::next(it) : said_.erase(it);
  const auto known = said_.find(intent.agent);
  if (known == said_.end() && said_.size() >= kMostHeard) return Heard::kNoRoom;
  const bool news = known != said_.end() && is_news(known->second.intent, intent);
  said_[intent.agent] = {intent, now_s};
  return news ? Heard::kNews : Heard::kNothingNew;
}

std::vector<PassingIntent> HeardIntents::all(double now_s) const {
  std::vector<PassingIntent> fresh;
  for (const auto& [name, said] : said_) {
    if (now_s < said.time_s + kSilence_s) fresh.push_back(said.intent);
  }
  return fresh;
}

const PassingIntent* HeardIntents::of(const std::string& name, double now_s) const {
  const auto found = said_.find(name);
  const bool is_fresh = found != said_.end() && now_s < found->second.time_s + kSilence_s;
  return is_fresh ? &found->second.intent : nullptr;
}

}  // namespace mocha
