#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace mocha {

/// Numbers of places, 0 or above: a bit each, as searches ask millions of times.
class PlaceSet {
 public:
  PlaceSet() = default;
  PlaceSet(std::initializer_list<int> places) {
    for (const int place : places) insert(place);
  }

  void insert(int place) {
    const std::size_t word = static_cast<std::size_t>(place) / kBits;
    if (word >= words_.size()) words_.resize(word + 1, 0);
    words_[word] |= std::uint64_t{1} << place % kBits;
  }

  bool contains(int place) const {
    const std::size_t word = static_cast<std::size_t>(place) / kBits;
    return word < words_.size() && (words_[word] >> place % kBits & 1U) != 0;
  }

 private:
  static constexpr int kBits = 64;

  std::vector<std::uint64_t> words_;
};

}  // namespace mocha
