// The queue of functions on their way to the program (see function_queue.h).
#include "tools/rung-hal/function_queue.h"

#include <algorithm>
#include <array>

namespace rung::hal {

// At the start all pins count as 0: what is on already is an edge.
FunctionQueue::FunctionQueue(const MapFile& map, nc::Functions* functions)
    : sends_(map.sends), aborts_(map.aborts), functions_(functions), timeoutNs_(map.timeoutNs), calls_(kRoom) {
  for (const MapSend& send : sends_) wasTriggered_.push_back(!send.edge.rising);
  for (const MapEdge& edge : aborts_) wasAborted_.push_back(!edge.rising);
}

void FunctionQueue::sample(host::Instance& instance, const PinCell* pins, int64_t ns) noexcept {
  late_ = false;
  for (uint32_t i = 0; i < count_; ++i) {
    calls_[i].ageNs += ns;
    late_ = late_ || (timeoutNs_ != 0 && calls_[i].ageNs > timeoutNs_);
  }
  // First, so that what the same event sends, a spindle's stop, goes to the program at once.
  for (uint32_t i = 0; i < aborts_.size(); ++i) {
    const bool now = triggered(aborts_[i], pins);
    if (now && !wasAborted_[i]) abort(instance);
    wasAborted_[i] = now;
  }
  for (uint32_t i = 0; i < sends_.size(); ++i) {
    const MapSend& send = sends_[i];
    const bool now = triggered(send.edge, pins);
    const int32_t code = send.codePin ? *pins[*send.codePin].s32 : send.code;
    if (now && !wasTriggered_[i]) queue({.send = i, .code = static_cast<uint32_t>(code)});
    if (!now && send.donePin) *pins[*send.donePin].bit = false;
    wasTriggered_[i] = now;
  }
}

void FunctionQueue::queue(Call call) noexcept {
  if (count_ == kRoom)
    ++lost_;
  else
    calls_[count_++] = call;
}

void FunctionQueue::abort(host::Instance& instance) noexcept {
  count_ = 0;
  late_ = false;
  if (functions_ != nullptr) functions_->abort(instance);
}

void FunctionQueue::advance(host::Instance& instance, const PinCell* pins) noexcept {
  if (count_ == 0) return;
  functions_->step(instance);
  std::array<bool, std::size(nc::kFunctionKinds)> waits = {}; // an older one of the kind is not finished
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    Call call = calls_[i];
    const nc::FunctionKind kind = sends_[call.send].kind;
    if (call.started && finish(call, pins)) continue;
    bool& waiting = waits[static_cast<size_t>(kind)];
    if (!call.started && !waiting) call.started = functions_->start(instance, kind, call.code);
    waiting = true;
    calls_[kept++] = call;
  }
  count_ = kept;
}

// The acknowledge is for a cause that is still there.
bool FunctionQueue::finish(const Call& call, const PinCell* pins) const noexcept {
  const MapSend& send = sends_[call.send];
  if (functions_->busy(send.kind)) return false;
  if (send.donePin && triggered(send.edge, pins)) *pins[*send.donePin].bit = true;
  return true;
}

} // namespace rung::hal
