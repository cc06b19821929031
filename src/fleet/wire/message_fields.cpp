#include "fleet/wire/message_fields.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr char kBeyondMap[] = "a place is out of range";

void check_name(const std::string& name) {
  require_said(!name.empty() && name.size() <= kMostName,
               "a name has no or more than 63 characters");
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '/';
  });
  require_said(plain, "a name has characters that names of robots do not have");
}

}  // namespace

double get_time(ByteReader& in) {
  const auto count = in.get<std::int64_t>();
  require_said(std::abs(static_cast<double>(count)) < kMostCount, "a time is out of range");
  return static_cast<double>(count) / kTimes;
}

PlaceCounts counts_of(const Vector2& place) {
  const Vector2 counts = kPlaces * place;
  require_said(counts.cwiseAbs().maxCoeff() < kMostPlaceCount, kBeyondMap);
  return {std::llround(counts.x()), std::llround(counts.y())};
}

Vector2 place_of(const PlaceCounts& counts) {
  const Vector2 place(static_cast<double>(counts.x), static_cast<double>(counts.y));
  require_said(place.cwiseAbs().maxCoeff() < kMostPlaceCount, kBeyondMap);
  return place / kPlaces;
}

void put_name(ByteWriter& out, const std::string& name) {
  check_name(name);
  out.put_text(name);
}

std::string get_name(ByteReader& in) {
  std::string name = in.get_text();
  check_name(name);
  return name;
}

std::uint8_t count_of(std::size_t size, const char* what) {
  require_said(size <= 255, std::string("more than 255 ") + what);
  return static_cast<std::uint8_t>(size);
}

}  // namespace mocha
