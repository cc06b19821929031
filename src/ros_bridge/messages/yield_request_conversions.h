#pragma once

#include <mocha_ugv/YieldRequest.h>

#include <string>

#include "fleet/protocol/yield_request.h"

namespace mocha {

mocha_ugv::YieldRequest to_message(const YieldRequest& request, const std::string& frame,
                                   ros::Time stamp);

/// Throws std::invalid_argument, saying what is wrong, for messages in another frame than `frame`
/// and for what no robot can have meant (validate()).
YieldRequest yield_request_from_message(const mocha_ugv::YieldRequest& message,
                                        const std::string& frame);

}  // namespace mocha
