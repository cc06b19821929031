#include "ros_bridge/runtime/live_parameters.h"

#include <ros/console.h>

#include <exception>
#include <utility>

#include "ros_bridge/messages/parameter_conversions.h"

namespace mocha {

LiveParameters::LiveParameters(ParameterTable& values,
                               std::function<void(const ParameterTable&)> apply)
    : values_(values),
      apply_(std::move(apply)),
      node_("~"),
      descriptions_(node_.advertise<dynamic_reconfigure::ConfigDescription>(
          "parameter_descriptions", 1, true)),
      updates_(node_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true)),
      requests_(node_.advertiseService("set_parameters", &LiveParameters::on_request, this)) {
  descriptions_.publish(to_description(values_));
  updates_.publish(to_config(values_));
}

bool LiveParameters::on_request(dynamic_reconfigure::Reconfigure::Request& request,
                                dynamic_reconfigure::Reconfigure::Response& response) {
  const auto changes = from_message(request.config);
  ParameterTable changed = values_;
  try {
    const std::vector<std::string> notes = changed.change(changes);
    apply_(changed);
    for (const std::string& note : notes) ROS_WARN("%s", note.c_str());
  } catch (const std::exception& error) {
    ++refused_;
    refusal_ = error.what();
    ROS_ERROR("Refused new parameters: %s", error.what());
    return false;
  }
  values_ = std::move(changed);
  for (const auto& change : changes) store(change.first);
  response.config = to_config(values_);
  updates_.publish(response.config);
  return true;
}

void LiveParameters::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("parameter changes refused", refused_);
  if (refused_ > 0) status.add("last refused change", refusal_);
}

void LiveParameters::store(const std::string& name) const {
  std::visit([&](const auto& value) { node_.setParam(name, value); },
             values_.parameters().at(name).value);
}

}  // namespace mocha
