#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "config/parameter_table.h"

namespace mocha {

/// Lets dynamic_reconfigure (rqt_reconfigure, dynparam, its Python client) change the parameters
/// that the schema marks as live: `~set_parameters`, `~parameter_descriptions` and
/// `~parameter_updates`.
///
/// A request is done as a whole or not at all. Values out of range are clamped, and the log says
/// so. Unknown names, parameters that are not live, wrong types, NaN and what the node refuses fail
/// the request; they are counted, and log and diagnostics say why. New values are also set as the
/// node's private parameters, so that it has them again when it is started again.
class LiveParameters {
 public:
  /// `apply` makes the node work with new values; what it throws refuses them. Only then `values`
  /// has them, which must outlive this.
  explicit LiveParameters(
      ParameterTable& values,
      std::function<void(const ParameterTable&)> apply = [](const ParameterTable&) {});

  /// Requests refused so far, and why the last one was.
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  bool on_request(dynamic_reconfigure::Reconfigure::Request& request,
                  dynamic_reconfigure::Reconfigure::Response& response);
  void store(const std::string& name) const;

  ParameterTable& values_;
  std::function<void(const ParameterTable&)> apply_;
  int refused_ = 0;
  std::string refusal_;
  ros::NodeHandle node_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer requests_;
};

}  // namespace mocha
