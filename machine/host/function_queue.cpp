// See function_queue.h.
#include "machine/host/function_queue.h"

#include <algorithm>

namespace rung::host {

FunctionQueue::FunctionQueue(const File& map, rung_instance* instance)
    : instance_(instance), sends_(map.sends), wasTriggered_(sends_.size()), owed_(sends_.size()), aborts_(map.aborts),
      wasAborted_(aborts_.size()), timeoutNs_(map.timeoutNs), calls_(kRoom) {
  for (const Send& send : sends_) channels_ = std::max(channels_, send.channel + 1);
  restart();
}

void FunctionQueue::restart() noexcept {
  count_ = 0;
  late_ = false;
  std::fill(owed_.begin(), owed_.end(), false);
  for (size_t i = 0; i < sends_.size(); ++i) wasTriggered_[i] = !sends_[i].edge.rising;
  for (size_t i = 0; i < aborts_.size(); ++i) wasAborted_[i] = !aborts_[i].rising;
}

FunctionState FunctionQueue::state() const noexcept {
  FunctionState state{.oldest = {}, .count = count_, .lost = lost_};
  for (uint32_t i = 0; i < std::min(count_, FunctionState::kMost); ++i) {
    const Call& call = calls_[i];
    const Send& send = sends_[call.send];
    state.oldest[i] = {.kind = send.kind,
                       .channel = send.channel,
                       .code = call.code,
                       .ageNs = call.ageNs,
                       .begun = call.handle.has_value(),
                       .late = isLate(call)};
  }
  return state;
}

void FunctionQueue::age(int64_t ns) noexcept {
  late_ = false;
  for (uint32_t i = 0; i < count_; ++i) {
    calls_[i].ageNs += ns;
    late_ = late_ || isLate(calls_[i]);
  }
}

void FunctionQueue::sample(Pins& pins, int64_t ns) noexcept {
  age(ns);
  // Aborts first, so that a function sent by the same event, such as a spindle stop, reaches the program at once.
  for (uint32_t i = 0; i < aborts_.size(); ++i) {
    const bool now = triggered(aborts_[i], pins);
    if (now && !wasAborted_[i]) abort();
    wasAborted_[i] = now;
  }
  for (uint32_t i = 0; i < sends_.size(); ++i) {
    const Send& send = sends_[i];
    const bool now = triggered(send.edge, pins);
    if (!now) withdraw(i, pins);
    owed_[i] = now && (wasTriggered_[i] ? owed_[i] : !queue(callOf(i, pins)));
    wasTriggered_[i] = now;
  }
}

FunctionQueue::Call FunctionQueue::callOf(uint32_t send, const Pins& pins) const noexcept {
  const auto& codePin = sends_[send].codePin;
  return {.send = send, .code = static_cast<uint32_t>(codePin ? pins[*codePin].s32 : sends_[send].code)};
}

bool FunctionQueue::queue(Call call) noexcept {
  const Send& send = sends_[call.send];
  const bool isCarried = rung_instance_supports_function(instance_, send.channel, send.kind, call.code) == RUNG_OK;
  const bool hasRoom = count_ < kRoom;
  if (hasRoom && isCarried)
    calls_[count_++] = call;
  else
    ++lost_;
  return hasRoom || !isCarried;
}

// The function itself is still completed.
void FunctionQueue::withdraw(uint32_t send, Pins& pins) noexcept {
  for (uint32_t i = 0; i < count_; ++i)
    if (calls_[i].send == send) calls_[i].wanted = false;
  if (const auto& done = sends_[send].donePin) pins.set(*done, {.bit = false});
}

void FunctionQueue::abort() noexcept {
  count_ = 0;
  std::fill(owed_.begin(), owed_.end(), false);
  late_ = false;
  for (uint32_t channel = 0; channel < channels_; ++channel) rung_instance_abort_functions(instance_, channel);
}

void FunctionQueue::advance(Pins& pins) noexcept {
  if (count_ == 0) return;
  const auto first = calls_.begin();
  const auto kept = std::remove_if(first, first + count_, [&](const Call& call) { return finish(call, pins); });
  count_ = static_cast<uint32_t>(kept - first);
  for (uint32_t i = 0; i < sends_.size() && count_ < kRoom; ++i)
    if (owed_[i]) owed_[i] = !queue(callOf(i, pins));
  for (uint32_t i = 0; i < count_; ++i) start(i);
}

// Begins a function, unless an older one of its kind and channel waits.
void FunctionQueue::start(uint32_t index) noexcept {
  Call& call = calls_[index];
  const Send& send = sends_[call.send];
  const auto overtakes = [&](const Call& older) {
    const Send& before = sends_[older.send];
    return !older.handle && before.kind == send.kind && before.channel == send.channel;
  };
  if (call.handle || std::any_of(calls_.begin(), calls_.begin() + index, overtakes)) return;
  uint32_t handle = 0;
  if (rung_instance_begin_function(instance_, send.channel, send.kind, call.code, &handle) == RUNG_OK)
    call.handle = handle;
}

// The acknowledge is only set if the cause is still present, not for a later cause on the same pin.
bool FunctionQueue::finish(const Call& call, Pins& pins) const noexcept {
  const Send& send = sends_[call.send];
  if (!call.handle || rung_instance_function_done(instance_, send.channel, *call.handle) != RUNG_OK) return false;
  if (send.donePin && call.wanted) pins.set(*send.donePin, {.bit = true});
  return true;
}

} // namespace rung::host
