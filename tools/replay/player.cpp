// See player.h.
#include "tools/replay/player.h"

#include "rtlib/api/host_player.h"
#include "rung/runtime.hpp"

namespace rung::replay {
namespace {

using runtime::Event;
using runtime::EventWriter;

// What both players have.
template <class Of>
class Wrapped : public AnyPlayer {
public:
  void setEvents(std::span<const uint8_t> events) override { of().setEvents(events); }
  size_t position() const override { return of().position(); }
  runtime::Played play() override { return of().play(); }
  const std::optional<runtime::PlayedDifference>& difference() const override { return of().difference(); }
  uint64_t repeatsLeft() const override { return of().repeatsLeft(); }
  runtime::PartKind lastKind() const override { return of().lastKind(); }
  uint32_t lastNumber() const override { return of().lastNumber(); }

protected:
  virtual Of& of() = 0;
  const Of& of() const { return const_cast<Wrapped*>(this)->of(); }
};

class BytesPlayer final : public Wrapped<runtime::Player> {
public:
  BytesPlayer(runtime::Engine& engine, runtime::PlayerOwner& owner) : instance_(engine), player_(instance_, owner) {}
  runtime::Instance& instance() override { return instance_; }
  const nc::Control* control() const override { return nullptr; }
  void compareOutputs(bool compares) override { player_.compareOutputs(compares); }
  std::vector<uint8_t> state() override {
    core::Saver counted({});
    if (!instance_.save(counted)) return {};
    const std::span<const core::ForcedBits> forced = instance_.forcedBits();
    constexpr size_t kNumber = 10; // bytes of one, at most
    std::vector<uint8_t> events((8 + 3 * forced.size()) * kNumber + counted.size());
    EventWriter writer(events);
    const runtime::Surroundings around = instance_.surroundings();
    writer.put(Event::Surroundings, around.works, around.latches, around.neededOnly);
    writer.put(Event::Forces, forced.size());
    for (const core::ForcedBits& bits : forced)
      writer.putNumber(bits.offset), writer.putNumber(bits.mask), writer.putNumber(bits.value);
    writer.put(Event::State, counted.size());
    core::Saver saver(writer.rest());
    (void)instance_.save(saver);
    events.resize(writer.size() + counted.size());
    return events;
  }

private:
  runtime::Player& of() override { return player_; }
  runtime::Instance instance_;
  runtime::Player player_;
};

class ControlPlayer final : public Wrapped<api::HostPlayer> {
public:
  ControlPlayer(runtime::Engine& engine, runtime::PlayerOwner& owner)
      : image_(rung::Image::adopt(engine.program(), engine.context())), player_(image_.handle(), owner) {}
  runtime::Instance& instance() override { return player_.running(); }
  const nc::Control* control() const override { return &player_.control(); }
  void compareOutputs(bool compares) override { player_.compareStates(compares); } // it has no outputs
  std::vector<uint8_t> state() override { return player_.state(); }

private:
  api::HostPlayer& of() override { return player_; }
  rung::Image image_;
  api::HostPlayer player_;
};

} // namespace

std::unique_ptr<AnyPlayer> makePlayer(runtime::RecordingMode mode, runtime::Engine& engine,
                                      runtime::PlayerOwner& owner) {
  if (mode == runtime::RecordingMode::Control) return std::make_unique<ControlPlayer>(engine, owner);
  return std::make_unique<BytesPlayer>(engine, owner);
}

} // namespace rung::replay
