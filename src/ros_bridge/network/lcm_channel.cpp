#include "ros_bridge/network/lcm_channel.h"

#include <ros/callback_queue.h>
#include <ros/init.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "fleet/wire/wire_format.h"
#include "ros_bridge/runtime/unavailable_error.h"

namespace mocha {
namespace {

const std::string kChannel = "mocha";
constexpr std::size_t kMostWaiting = 200;
constexpr int kWait_ms = 100;

}  // namespace

/// What has come and is not handled yet, between the two threads.
class LcmChannel::Arrivals : public std::enable_shared_from_this<Arrivals> {
 public:
  explicit Arrivals(std::function<void(const Bytes&)> handle) : handle_(std::move(handle)) {}

  /// False where too much waits already.
  bool add(Bytes bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() >= kMostWaiting) return false;
    waiting_.push_back(std::move(bytes));
    if (waiting_.size() == 1)
      ros::getGlobalCallbackQueue()->addCallback(boost::make_shared<Call>(shared_from_this()));
    return true;
  }

  void handle_all() {
    std::vector<Bytes> arrived;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      arrived.swap(waiting_);
    }
    for (const Bytes& bytes : arrived) handle_(bytes);
  }

  /// Nothing is handled any more.
  void end() {
    handle_ = [](const Bytes&) {};
  }

 private:
  class Call : public ros::CallbackInterface {
   public:
    explicit Call(std::shared_ptr<Arrivals> arrivals) : arrivals_(std::move(arrivals)) {}
    CallResult call() override {
      arrivals_->handle_all();
      return Success;
    }

   private:
    std::shared_ptr<Arrivals> arrivals_;
  };

  std::mutex mutex_;
  std::vector<Bytes> waiting_;
  std::function<void(const Bytes&)> handle_;
};

LcmChannel::LcmChannel(const std::string& url, std::function<void(const Bytes&)> handle)
    : lcm_(url), arrivals_(std::make_shared<Arrivals>(std::move(handle))) {
  const auto fail = [&] {
    throw UnavailableError("lcm_url = " + url +
                           ": LCM cannot use it. Is it udpm://GROUP:PORT?ttl=1, and does the "
                           "network have a route for multicast (ip route add 224.0.0.0/4 dev "
                           "wlan0)?");
  };
  if (!lcm_.good()) fail();
  lcm::Subscription* subscription = lcm_.subscribe(kChannel, &LcmChannel::on_datagram, this);
  if (subscription == nullptr) fail();
  subscription->setQueueCapacity(static_cast<int>(kMostWaiting));
  receiver_ = std::thread([this] {
    while (!ends_ && lcm_.handleTimeout(kWait_ms) >= 0) {
    }
  });
}

LcmChannel::~LcmChannel() {
  ends_ = true;
  receiver_.join();
  arrivals_->end();
}

bool LcmChannel::send(const Bytes& bytes) {
  return lcm_.publish(kChannel, bytes.data(), static_cast<unsigned>(bytes.size())) == 0;
}

void LcmChannel::on_datagram(const lcm::ReceiveBuffer* buffer, const std::string& /*channel*/) {
  const auto* data = static_cast<const std::uint8_t*>(buffer->data);
  const bool possible = buffer->data_size <= kMostDatagramBytes;
  if (!possible || !arrivals_->add(Bytes(data, data + buffer->data_size))) ++dropped_;
}

}  // namespace mocha
