#include "base/line_buffer.h"

#include <utility>

namespace mocha {

std::vector<std::string> LineBuffer::add(std::string_view bytes) {
  std::vector<std::string> lines;
  for (const char byte : bytes) {
    if (byte == '\n') {
      if (!partial_.empty() && partial_.back() == '\r') partial_.pop_back();
      if (!partial_.empty() && !dropping_) lines.push_back(std::move(partial_));
      partial_.clear();
      dropping_ = false;
    } else if (!dropping_ && partial_.size() == max_length_) {
      ++overlong_;
      dropping_ = true;
      partial_.clear();
    } else if (!dropping_) {
      partial_.push_back(byte);
    }
  }
  return lines;
}

bool LineBuffer::drop_partial() {
  const bool any = !partial_.empty() || dropping_;
  partial_.clear();
  dropping_ = false;
  return any;
}

}  // namespace mocha
