// The channels of the control: the part programs in memory, the selected program of each channel, and the channels that
// execute them (channel.h), with their synchronisation by M codes (man. l.9570-9576).
#pragma once
#include <array>
#include <list>
#include <memory>

#include "sim/nct/channel.h"

namespace rung::sim::nct {

class Channels final : public Topic {
public:
  explicit Channels(Links& links);

  // Channels count from 0. Whether a program runs or is interrupted: CN_START, CN_STOP or CN_INTD.
  bool busy(uint32_t channel) const { return channels_[channel]->busy(); }
  uint32_t blocksAhead(uint32_t channel) const { return channels_[channel]->blocksAhead(); }
  bool hasProgram(int32_t number) const { return find(number) != nullptr; }
  void select(uint32_t channel, int32_t number);

  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"program", "mdi", "reset"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void cycle() override;
  void timeSlice() override;
  void retain(Retained& retained) override;

  template <class Archive>
  void state(Archive& archive) {
    archivePrograms(archive);
    archive(selected_, cycleUs_, resetPressed_, pulsing_, resetBefore_);
    for (const std::unique_ptr<Channel>& channel : channels_) {
      std::optional<int32_t> running;
      if (const ChannelProgram* program = channel->selected()) running = program->number;
      archive(running, *channel);
      if constexpr (Archive::kLoads) channel->setSelected(running ? find(*running) : nullptr);
    }
  }

private:
  template <class Archive>
  void archivePrograms(Archive& archive) {
    auto count = static_cast<uint32_t>(programs_.size());
    archive(count);
    if constexpr (Archive::kLoads) {
      for (const std::unique_ptr<Channel>& channel : channels_) channel->setSelected(nullptr);
      programs_.clear();
      while (archive.good() && programs_.size() < count) archive(programs_.emplace_back());
    } else {
      for (ChannelProgram& program : programs_) archive(program);
    }
  }
  const ChannelProgram* find(int32_t number) const;
  std::string load(const std::vector<NcArgument>& keys);
  std::string checkGroups(const ChannelProgram& program, uint32_t channel) const;
  void releaseWaiting();
  void followResetKey();

  ChannelSignals signals_;
  ChannelParameters parameters_;
  std::vector<ParameterPlace> groupFirst_, groupLast_; // N1341…, N1357…
  std::list<ChannelProgram> programs_;                 // in memory; a list, because a channel may be executing one
  std::array<int32_t, nc::nct::kChannels> selected_{};
  std::array<std::unique_ptr<Channel>, nc::nct::kChannels> channels_;
  int64_t cycleUs_ = 0; // clock at the last cycle
  BitSignal resetKey_{"NB_RESET"};
  bool resetPressed_ = false; // by an event: the key is on for one cycle
  bool pulsing_ = false;
  bool resetBefore_ = false;
};

} // namespace rung::sim::nct
