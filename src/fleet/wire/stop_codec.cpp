#include "fleet/wire/stop_codec.h"

#include <utility>

#include "fleet/wire/message_fields.h"

namespace mocha {

void put_stops(ByteWriter& out, const std::vector<FleetStop>& stops) {
  out.put(count_of(stops.size(), "emergency stops"));
  for (const FleetStop& stop : stops) {
    put_name(out, stop.agent);
    out.put(stop.ordered);
    out.put(stop.released);
    put_number<std::int64_t>(out, stop.since_s, kTimes, "the time of an emergency stop");
    out.put_text(stop.reason);
  }
}

std::vector<FleetStop> get_stops(ByteReader& in) {
  std::vector<FleetStop> stops;
  const std::size_t count = in.get<std::uint8_t>();
  for (std::size_t i = 0; i < count; ++i) {
    FleetStop stop;
    stop.agent = get_name(in);
    stop.ordered = in.get<std::uint64_t>();
    stop.released = in.get<std::uint64_t>();
    stop.since_s = get_time(in);
    stop.reason = in.get_text();
    stops.push_back(std::move(stop));
  }
  return stops;
}

}  // namespace mocha
