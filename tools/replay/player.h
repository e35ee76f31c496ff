// Plays either kind of recording (runtime::RecordingMode).
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rtlib/load/engine.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/record/player.h"
#include "rtlib/record/recording_file.h"
#include "rtlib/run/instance.h"

namespace rung::replay {

class AnyPlayer {
public:
  virtual ~AnyPlayer() = default;
  virtual runtime::Instance& instance() = 0;
  // Of the dialect; null if it does not run again.
  virtual const nc::Control* control() const = 0;
  // As in runtime::Player.
  virtual void setEvents(std::span<const uint8_t> events) = 0;
  virtual size_t position() const = 0;
  virtual runtime::Played play() = 0;
  virtual const std::optional<runtime::PlayedDifference>& difference() const = 0;
  virtual void compareOutputs(bool compares) = 0;
  virtual uint64_t repeatsLeft() const = 0;
  virtual runtime::PartKind lastKind() const = 0;
  virtual uint32_t lastNumber() const = 0;
  // Events by which another player gets the present state, up to their end. Empty within a scan.
  virtual std::vector<uint8_t> state() = 0;
};

// Both arguments outlive the player.
std::unique_ptr<AnyPlayer> makePlayer(runtime::RecordingMode mode, runtime::Engine& engine,
                                      runtime::PlayerOwner& owner);

} // namespace rung::replay
