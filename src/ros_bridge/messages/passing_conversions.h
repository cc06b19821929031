#pragma once

#include <mocha_ugv/PassingInstruction.h>
#include <mocha_ugv/PassingIntent.h>

#include <string>

#include "fleet/protocol/passing_messages.h"

namespace mocha {

mocha_ugv::PassingIntent to_message(const PassingIntent& intent, const std::string& frame,
                                    ros::Time stamp);
mocha_ugv::PassingInstruction to_message(const PassingInstruction& instruction,
                                         const std::string& frame, ros::Time stamp);

/// Both throw std::invalid_argument, saying what is wrong, for messages in another frame than
/// `frame` and for what no robot can have meant (validate()).
PassingIntent passing_from_message(const mocha_ugv::PassingIntent& message,
                                   const std::string& frame);
PassingInstruction passing_from_message(const mocha_ugv::PassingInstruction& message,
                                        const std::string& frame);

}  // namespace mocha
