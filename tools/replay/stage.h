// A program of a recording with what plays it: fast, and rung by rung. Both are at a place of the recording of their
// own.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/engines.h"
#include "compiler/recompiler.h"
#include "rtlib/change/forcing.h"
#include "rtlib/record/player.h"
#include "rtlib/run/instance.h"
#include "tools/replay/flow.h"
#include "tools/replay/recording.h"

namespace rung::replay {

// A moment between two parts, from which playing can go on. It belongs to one program.
struct Moment {
  uint32_t program = 0;
  uint32_t segment = 0;
  size_t position = 0; // of the next event
  uint64_t part = 0;   // parts before it
  // How often the last part still follows as it was.
  uint64_t repeats = 0;
  runtime::PartKind kind = runtime::PartKind::Scan; // of the last part
  uint32_t number = 0;
  std::vector<uint8_t> events; // what a player plays to have the state
};

class Stage final : public runtime::PlayerOwner {
public:
  static Result<std::unique_ptr<Stage>> make(const compiler::Compiled& compiled, compiler::EngineKind kind);

  const compiler::Compiled& compiled() const { return compiled_; }
  runtime::Instance& instance() { return *instance_; }
  const runtime::Instance& instance() const { return *instance_; }
  runtime::Player& player() { return *player_; }
  const runtime::Player& player() const { return *player_; }

  // The events by which another player gets the present state; nothing within a scan.
  std::optional<std::vector<uint8_t>> state() const;

  FlowEngine& flowEngine();
  // The instance that runs rung by rung: after flow(), as that part left it.
  runtime::Instance& flowInstance() { return *flowInstance_; }
  // Plays one part from the moment, rung by rung; `events` is the rest of its segment. Null if there is no part.
  const Flow* flow(const Moment& from, std::span<const uint8_t> events, const FlowEngine::AfterRun& afterRun = {});

private:
  Stage(const compiler::Compiled& compiled, compiler::EngineKind kind) : compiled_(compiled), kind_(kind) {}
  bool force(runtime::Instance& instance, std::span<const core::ForcedBits> bits) override;

  const compiler::Compiled& compiled_;
  compiler::EngineKind kind_;
  compiler::EngineOptions options_;
  std::unique_ptr<runtime::Engine> engine_;
  std::unique_ptr<runtime::Instance> instance_;
  std::unique_ptr<runtime::Player> player_;
  std::unique_ptr<FlowEngine> flowEngine_;
  std::unique_ptr<runtime::Instance> flowInstance_;
  std::unique_ptr<runtime::Player> flowPlayer_;
  // Of the instances: those in effect.
  struct InEffect {
    std::unique_ptr<runtime::Forcing> forcing;
    std::unique_ptr<compiler::ForcedCode> code;
  };
  InEffect fast_, slow_;
};

} // namespace rung::replay
