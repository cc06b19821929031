#include "ros_bridge/runtime/callback_queue.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <utility>

namespace mocha {
namespace {

class Call : public ros::CallbackInterface {
 public:
  explicit Call(std::function<void()> call) : call_(std::move(call)) {}
  CallResult call() override {
    call_();
    return Success;
  }

 private:
  std::function<void()> call_;
};

}  // namespace

void call_soon(std::function<void()> call) {
  ros::getGlobalCallbackQueue()->addCallback(boost::make_shared<Call>(std::move(call)));
}

}  // namespace mocha
