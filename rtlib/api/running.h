// The parts of a scan as an instance's host asks for them, and what is around each: functions, bound variables, saving,
// messages, times. Nothing here allocates, locks or throws.
#pragma once
#include "rtlib/api/instance.h"
#include "rtlib/run/realtime.h"

namespace rung::api {

void beforePart(rung_instance& instance) noexcept;
void afterPart(rung_instance& instance) noexcept;
// What the program has written means nothing any more: bound variables and blocks become 0.
void clearOutputs(rung_instance& instance) noexcept;

// `part` runs a slice, a slot, a scan or the fast task.
template <class Part>
void runPart(rung_instance& instance, Part part) noexcept {
  const bool measures = (instance.options.flags & RUNG_MEASURE) != 0;
  beforePart(instance);
  const int64_t begin = measures ? runtime::monotonicNs() : 0;
  part();
  if (measures) instance.passNs += runtime::monotonicNs() - begin;
  afterPart(instance);
}

// After a fault: the program before this one, where there is one, with its state. It stays stopped.
void putFormerBack(rung_instance& instance) noexcept;
// Forces may have ended by themselves.
void settleForces(rung_instance& instance) noexcept;
// A fault goes to the host's callback, once.
void reportFault(rung_instance& instance) noexcept;
inline int32_t statusOf(const rung_instance& instance) noexcept {
  return instance.running.faulted() ? RUNG_FAULTED : RUNG_OK;
}

// Whether a program can have this memory block; null: the library allocates one.
int32_t checkMemory(const rung_program& program, const void* memory, size_t bytes) noexcept;

rung_request shown(const core::ServiceRequest& request, const nc::Control& control) noexcept;
// Queues a message for the host. A message that finds no room is lost, and counted.
void say(rung_instance& instance, const rung_message& message) noexcept;
core::ServiceReply taken(const rung_reply& reply) noexcept;

} // namespace rung::api
