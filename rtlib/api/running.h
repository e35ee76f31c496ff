// Runs the parts of a scan that a host requests, with the work before and after them: functions, bound variables,
// saving, messages, measured times. Scan thread; nothing here allocates, locks or throws.
#pragma once
#include "rtlib/api/instance.h"
#include "rtlib/run/realtime.h"

namespace rung::api {

// `kind` and `number` as in runtime::OutsideWatch.
void beforePart(rung_instance& instance, runtime::PartKind kind, uint32_t number) noexcept;
void afterPart(rung_instance& instance) noexcept;
// Sets bound variables and blocks to 0, because the outputs of the program are no longer valid.
void clearOutputs(rung_instance& instance) noexcept;

// `part` runs a slice, a slot, a scan or the fast task.
template <class Part>
void runPart(rung_instance& instance, runtime::PartKind kind, Part part, uint32_t number = RUNG_NONE) noexcept {
  const bool measures = (instance.options.flags & RUNG_MEASURE) != 0;
  beforePart(instance, kind, number);
  const int64_t begin = measures ? runtime::monotonicNs() : 0;
  part();
  if (measures) instance.passNs += runtime::monotonicNs() - begin;
  afterPart(instance);
}

// After a fault: puts the former program back, if there is one, with its state. It stays stopped.
void putFormerBack(rung_instance& instance) noexcept;
// Updates the handle of the forces in effect, because a fault or a power-on may have ended them.
void settleForces(rung_instance& instance) noexcept;
// Reports a fault to the host's callback, once.
void reportFault(rung_instance& instance) noexcept;
inline int32_t statusOf(const rung_instance& instance) noexcept {
  return instance.running.faulted() ? RUNG_FAULTED : RUNG_OK;
}

// The state of the instance with that of its control: with or without the requests that the host has not taken, which
// it may be taking meanwhile only if they are left out. False: within a scan.
enum class Waiting : uint8_t { Included, LeftOut };
bool saveState(const rung_instance& instance, core::Saver& saver, Waiting waiting) noexcept;
// As rung_instance_load.
int32_t loadState(rung_instance& instance, core::Loader& loader);

// Checks a memory block for a program; null: the library allocates one.
int32_t checkMemory(const rung_program& program, const void* memory, size_t bytes) noexcept;

rung_request shown(const core::ServiceRequest& request, const nc::Control& control) noexcept;
// Queues a message for the host. If the queue is full, the message is lost, and counted.
void say(rung_instance& instance, const rung_message& message) noexcept;
core::ServiceReply taken(const rung_reply& reply) noexcept;

} // namespace rung::api
