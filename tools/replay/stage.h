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
#include "tools/replay/flow.h"
#include "tools/replay/player.h"
#include "tools/replay/recording.h"

namespace rung::replay {

// A moment between two parts, from which playing can continue. It belongs to one program.
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

// Takes the number of repetitions at `position` of the events, which are of a part that the player has not run itself.
uint64_t takeRepeats(std::span<const uint8_t> events, size_t& position);

// Whether the player has the state of these events now.
bool playState(runtime::Player& player, std::span<const uint8_t> events);

class Stage {
public:
  static Result<std::unique_ptr<Stage>> make(const compiler::Compiled& compiled, compiler::EngineKind kind,
                                             runtime::RecordingMode mode);

  const compiler::Compiled& compiled() const { return compiled_; }
  runtime::Player& player() { return *player_; }

  FlowEngine& flowEngine();
  // The instance that runs rung by rung: after flow(), as that part left it.
  runtime::Instance& flowInstance() { return flowPlayer_->instance(); }
  // Plays so many parts, rung by rung, after `skipped` others from a state (Moment::events). Null if there are not so
  // many.
  const Flow* flow(std::span<const uint8_t> state, std::span<const uint8_t> events, uint64_t skipped, uint64_t parts,
                   const FlowEngine::AfterRun& afterRun);

private:
  // Code for forces.
  struct FastOwner final : runtime::PlayerOwner {
    explicit FastOwner(Stage& of) : stage(of) {}
    std::optional<core::Code> codeFor(const runtime::Forcing& forcing) override;
    Stage& stage;
    std::unique_ptr<compiler::ForcedCode> code;
  };
  // The program's own: the observer holds the bits.
  struct SlowOwner final : runtime::PlayerOwner {
    explicit SlowOwner(Stage& of) : stage(of) {}
    std::optional<core::Code> codeFor(const runtime::Forcing& forcing) override;
    Stage& stage;
  };

  Stage(const compiler::Compiled& compiled, compiler::EngineKind kind, runtime::RecordingMode mode)
      : compiled_(compiled), kind_(kind), mode_(mode) {}

  const compiler::Compiled& compiled_;
  compiler::EngineKind kind_;
  runtime::RecordingMode mode_;
  compiler::EngineOptions options_;
  std::unique_ptr<runtime::Engine> engine_;
  FastOwner fastOwner_{*this};
  std::unique_ptr<runtime::Player> player_;
  std::unique_ptr<FlowEngine> flowEngine_;
  SlowOwner slowOwner_{*this};
  std::unique_ptr<runtime::Player> flowPlayer_;
};

} // namespace rung::replay
