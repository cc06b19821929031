#pragma once

#include <mocha_ugv/WayRequest.h>

#include <string>

#include "fleet/way_request.h"

namespace mocha {

mocha_ugv::WayRequest to_message(const WayRequest& request, const std::string& frame,
                                 ros::Time stamp);

/// Throws std::invalid_argument, saying what is wrong, for messages in another frame than `frame`
/// and for what no robot can have meant (validate()).
WayRequest way_request_from_message(const mocha_ugv::WayRequest& message, const std::string& frame);

}  // namespace mocha
