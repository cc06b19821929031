#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace mocha {

/// The channel on which robots hear each other over LCM's UDP multicast. A thread of its own waits
/// for datagrams; they are handled in the node's thread, by its callback queue. A flood fills a
/// queue of fixed length, and no more.
class LcmChannel {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// `url` as LCM takes it, such as "udpm://239.255.76.67:7667?ttl=1". Throws std::runtime_error,
  /// saying what may be wrong, where LCM cannot use it.
  LcmChannel(const std::string& url, std::function<void(const Bytes&)> handle);
  ~LcmChannel();
  LcmChannel(const LcmChannel&) = delete;
  LcmChannel& operator=(const LcmChannel&) = delete;

  /// False where the network does not take it.
  bool send(const Bytes& bytes);

  /// Datagrams that came faster than they could be handled.
  int dropped() const { return dropped_; }

 private:
  class Arrivals;

  void on_datagram(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  lcm::LCM lcm_;
  std::shared_ptr<Arrivals> arrivals_;
  std::atomic<int> dropped_{0};
  std::atomic<bool> ends_{false};
  std::thread receiver_;
};

}  // namespace mocha
