// The answer where no CNC is there to give one: a program must not wait for ever.
#pragma once
#include "rtlib/core/queues.h"

namespace rung::nc {

// GSK's window requests end with code 6, "not provided" (man. l.8668-8676); all others with an error, of which NCT's MR
// and MW make execution code 1 and MACR, MACW, SCP and MOVCMND the flag FL_ER. Allocates nothing.
core::ServiceReply refuse(const rung_program& program, const core::ServiceRequest& request) noexcept;

} // namespace rung::nc
