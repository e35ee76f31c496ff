// The queue of auxiliary functions and their handshake.
#include "tools/rung-hal/aux_functions.h"

namespace rung::hal {

AuxFunctions::AuxFunctions(std::vector<MapSend> sends, std::vector<Channel> channels)
    : sends_(std::move(sends)), channels_(std::move(channels)), requests_(kQueue) {
  // At the start all pins count as 0: what is on already is an edge.
  for (const MapSend& send : sends_) wasTriggered_.push_back(!send.rising);
}

void AuxFunctions::queue(Request request) noexcept {
  if (count_ == kQueue) {
    ++lost_;
    return;
  }
  requests_[(first_ + count_) % kQueue] = request;
  ++count_;
}

void AuxFunctions::sample(const PinCell* pins) noexcept {
  for (uint32_t i = 0; i < sends_.size(); ++i) {
    const MapSend& send = sends_[i];
    const bool now = triggered(send, pins);
    if (now && !wasTriggered_[i]) queue({i, send.codePin ? *pins[*send.codePin].s32 : send.code});
    if (!now && send.donePin) *pins[*send.donePin].bit = false;
    wasTriggered_[i] = now;
  }
}

void AuxFunctions::advance(const rt::Memory& memory, const PinCell* pins) noexcept {
  switch (phase_) {
  case Phase::Idle: {
    if (count_ == 0) return;
    current_ = requests_[first_];
    first_ = (first_ + 1) % kQueue;
    --count_;
    const Channel& channel = channels_[sends_[current_.send].channel];
    host::writeRaw(memory, channel.code, static_cast<uint64_t>(int64_t{current_.code}));
    host::writeRaw(memory, channel.strobe, 1);
    phase_ = Phase::Strobe;
    return;
  }
  case Phase::Strobe: {
    const Channel& channel = channels_[sends_[current_.send].channel];
    if (host::readRaw(memory, channel.done) == 0) return;
    host::writeRaw(memory, channel.strobe, 0);
    phase_ = Phase::Release;
    return;
  }
  case Phase::Release: {
    const MapSend& send = sends_[current_.send];
    const Channel& channel = channels_[send.channel];
    if (host::readRaw(memory, channel.done) != 0) return;
    if (!channel.keepCode) host::writeRaw(memory, channel.code, 0);
    if (send.donePin && triggered(send, pins)) *pins[*send.donePin].bit = true;
    phase_ = Phase::Idle;
    return;
  }
  }
}

} // namespace rung::hal
