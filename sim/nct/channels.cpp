// The channels of the control (see channels.h).
#include "sim/nct/channels.h"

#include <algorithm>
#include <cmath>

namespace rung::sim::nct {
namespace {

constexpr uint32_t kGroups = 16; // groups of M codes that exclude each other
constexpr uint32_t kFirstGroupStart = 1341;
constexpr uint32_t kFirstGroupEnd = 1357;

// The channel of an event, from 0; `otherwise` (from 1) if it has no such key.
std::optional<uint32_t> channelKey(const std::vector<NcArgument>& keys, int64_t otherwise) {
  const int64_t number = integerKey(keys, "channel", otherwise);
  if (number < 1 || number > static_cast<int64_t>(nc::nct::kChannels)) return std::nullopt;
  return static_cast<uint32_t>(number - 1);
}

} // namespace

Channels::Channels(Links& links) : Topic(links) {
  for (uint32_t i = 0; i < nc::nct::kChannels; ++i)
    channels_[i] = std::make_unique<Channel>(links, i, signals_, parameters_);
  for (uint32_t i = 0; i < kGroups; ++i) {
    groupFirst_.emplace_back(kFirstGroupStart + i);
    groupLast_.emplace_back(kFirstGroupEnd + i);
  }
}

const ChannelProgram* Channels::find(int32_t number) const {
  const auto found = std::ranges::find(programs_, number, &ChannelProgram::number);
  return found == programs_.end() ? nullptr : &*found;
}

void Channels::select(uint32_t channel, int32_t number) {
  if (channel >= nc::nct::kChannels) return;
  selected_[channel] = number;
  channels_[channel]->forgetInterruption();
}

Handled Channels::config(std::string_view key, std::string_view value) {
  const auto channel = numbersAfter(key, "turning.");
  if (!channel || channel->size() != 1) return std::nullopt;
  if (channel->front() < 1 || channel->front() > nc::nct::kChannels) return "channels are 1 to 8";
  channels_[channel->front() - 1]->setTurning(value == "on");
  return std::string();
}

// ---- the operator ------------------------------------------------------------------------------------------------

Handled Channels::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (name == "program") return load(keys);
  if (name == "mdi") {
    if (std::string wrong = unknownKey(name, keys, {"channel", "blocks"}); !wrong.empty()) return wrong;
    const std::optional<uint32_t> channel = channelKey(keys, 1);
    const NcArgument* blocks = findKey(keys, "blocks");
    if (!channel || blocks == nullptr) return "event mdi takes channel=1 to 8 and blocks=\"…\"";
    return channels_[*channel]->enter(blocks->text);
  }
  if (std::string wrong = unknownKey(name, keys, {"channel"}); !wrong.empty()) return wrong;
  const bool one = findKey(keys, "channel") != nullptr;
  const std::optional<uint32_t> channel = channelKey(keys, 1);
  if (!channel) return "channels are 1 to 8";
  for (uint32_t i = 0; i < nc::nct::kChannels; ++i)
    if (!one || i == *channel) channels_[i]->reset();
  resetPressed_ = true;
  return std::string();
}

// Loads a program into the memory and, with a channel, selects it there for automatic mode, unless the program forbids
// it (P_RUNAUT, l.8130).
std::string Channels::load(const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey("program", keys, {"channel", "number", "blocks"}); !wrong.empty()) return wrong;
  const int64_t number = integerKey(keys, "number", 0);
  if (number < 1 || number > 99'999'999) return "event program takes number=1 to 99999999";
  const std::optional<uint32_t> channel = channelKey(keys, 1);
  if (!channel) return "channels are 1 to 8";
  ChannelProgram program;
  if (const NcArgument* blocks = findKey(keys, "blocks")) {
    if (std::string wrong = readChannelProgram(blocks->text, program); !wrong.empty()) return wrong;
    if (std::string wrong = channels_[*channel]->check(program); !wrong.empty()) return wrong;
    if (std::string wrong = checkGroups(program, *channel); !wrong.empty()) return wrong;
    program.number = static_cast<int32_t>(number);
    for (uint32_t i = 0; i < nc::nct::kChannels; ++i)
      if (selected_[i] == number && channels_[i]->busy()) return "the program is being executed";
    programs_.remove_if([&](const ChannelProgram& known) { return known.number == program.number; });
    programs_.push_back(std::move(program));
  } else if (!hasProgram(static_cast<int32_t>(number))) {
    return "there is no program of that number; blocks=\"…\" makes one";
  }
  if (findKey(keys, "channel") == nullptr || links().signals.get(signals_.automaticForbidden)) return {};
  if (channels_[*channel]->running()) return "the channel is executing";
  select(*channel, static_cast<int32_t>(number));
  return {};
}

// Checks for two codes of one group in a block: "Contradictory M-codes" (l.10865).
std::string Channels::checkGroups(const ChannelProgram& program, uint32_t channel) const {
  for (const ProgramBlock& block : program.blocks)
    for (uint32_t group = 0; group < kGroups; ++group) {
      const int32_t first = links().parameters->dword(groupFirst_[group], channel);
      const int32_t last = links().parameters->dword(groupLast_[group], channel);
      const auto in = [&](const ProgramWord& word) {
        return word.letter == 'M' && word.value.variable == 0 && first > 0 && word.value.number >= first &&
               word.value.number <= last;
      };
      if (std::ranges::count_if(block.words, in) > 1) return "contradictory M codes";
    }
  return {};
}

// ---- quantities --------------------------------------------------------------------------------------------------

std::optional<double> Channels::quantity(std::string_view name) const {
  const auto channelAfter = [&](std::string_view prefix) -> std::optional<uint32_t> {
    const auto channel = numbersAfter(name, prefix);
    if (!channel || channel->size() != 1 || channel->front() < 1 || channel->front() > nc::nct::kChannels)
      return std::nullopt;
    return channel->front() - 1;
  };
  if (const auto channel = channelAfter("PROGRAM.")) return selected_[*channel];
  if (const auto channel = channelAfter("SEQUENCE.")) return channels_[*channel]->sequence();
  if (const auto channel = channelAfter("PARTS.")) return channels_[*channel]->parts;
  if (const auto channel = channelAfter("PARTSWANTED.")) return channels_[*channel]->partsWanted;
  return std::nullopt;
}

Handled Channels::setQuantity(std::string_view name, double value) {
  for (const bool wanted : {false, true}) {
    const auto channel = numbersAfter(name, wanted ? "PARTSWANTED." : "PARTS.");
    if (!channel) continue;
    if (channel->size() != 1 || channel->front() < 1 || channel->front() > nc::nct::kChannels)
      return "channels are 1 to 8";
    if (value < 0 || value > INT32_MAX || value != std::floor(value)) return "parts are counted in whole numbers";
    Channel& it = *channels_[channel->front() - 1];
    (wanted ? it.partsWanted : it.parts) = static_cast<int32_t>(value);
    return std::string();
  }
  return std::nullopt;
}

// ---- time --------------------------------------------------------------------------------------------------------

void Channels::powerOn(nc::PowerOn kind) {
  cycleUs_ = links().nowUs;
  resetPressed_ = pulsing_ = resetBefore_ = false;
  for (const auto& channel : channels_) {
    channel->powerOn();
    if (kind == nc::PowerOn::Cold) channel->parts = channel->partsWanted = 0;
  }
  if (kind == nc::PowerOn::Warm) return;
  selected_ = {};
  programs_.clear();
}

void Channels::retain(Retained& retained) {
  retained.value(selected_);
  for (const auto& channel : channels_) {
    retained.value(channel->parts);
    retained.value(channel->partsWanted);
  }
}

// If all executing channels that take part wait at the same code, they continue together.
void Channels::releaseWaiting() {
  for (uint32_t i = 0; i < nc::nct::kChannels; ++i) {
    const int32_t code = channels_[i]->waiting();
    const auto there = [&](const auto& other) { return !other->waitsForOthers() || other->waiting() == code; };
    if (code < 0 || !std::ranges::all_of(channels_, there)) continue;
    for (const auto& channel : channels_)
      if (channel->waiting() == code) channel->release();
  }
}

// The RESET key (l.6558), pressed by an event, or by a write to the signal, which resets all channels.
void Channels::followResetKey() {
  const SignalMemory& signals = links().signals;
  const bool down = signals.get(resetKey_);
  if (down && !resetBefore_)
    for (const auto& channel : channels_) channel->reset();
  const bool release = !resetPressed_ && pulsing_;
  if (resetPressed_) signals.set(resetKey_, true);
  if (release) signals.set(resetKey_, false);
  pulsing_ = resetPressed_;
  resetPressed_ = false;
  resetBefore_ = signals.get(resetKey_);
}

void Channels::cycle() {
  followResetKey();
  const int64_t us = links().nowUs - cycleUs_;
  cycleUs_ = links().nowUs;
  releaseWaiting();
  for (uint32_t i = 0; i < nc::nct::kChannels; ++i) channels_[i]->cycle(find(selected_[i]), us);
}

void Channels::timeSlice() {
  for (const auto& channel : channels_) channel->timeSlice();
}

} // namespace rung::sim::nct
