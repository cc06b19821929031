#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace mocha {

/// Integers and short texts as bytes, least significant first, whatever the machine.
class ByteWriter {
 public:
  template <typename Integer>
  void put(Integer value) {
    const auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      bytes_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(bits) >> (8 * i)));
  }
  /// Throws std::invalid_argument for one of more than 255 characters.
  void put_text(const std::string& text) {
    if (text.size() > 255) throw std::invalid_argument("a name has more than 255 characters");
    put(static_cast<std::uint8_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  /// Seven bits a byte: the smaller the number, the shorter.
  void put_varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) put(static_cast<std::uint8_t>(value | 0x80));
    put(static_cast<std::uint8_t>(value));
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads them back. Throws std::invalid_argument where the bytes end before what is asked for.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  template <typename Integer>
  Integer get() {
    need(sizeof(Integer));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      bits |= static_cast<std::uint64_t>(data_[i]) << (8 * i);
    skip(sizeof(Integer));
    return static_cast<Integer>(bits);
  }
  std::string get_text() {
    const std::size_t size = get<std::uint8_t>();
    need(size);
    std::string text(data_, data_ + size);
    skip(size);
    return text;
  }
  std::uint64_t get_varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const std::uint64_t byte = get<std::uint8_t>();
      value |= (byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    throw std::invalid_argument("a number has too many bytes");
  }
  std::size_t left() const { return left_; }

 private:
  void need(std::size_t size) const {
    if (size > left_) throw std::invalid_argument("the message ends too early");
  }
  void skip(std::size_t size) {
    data_ += size;
    left_ -= size;
  }

  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace mocha
