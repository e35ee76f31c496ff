// The execution of a part-program block by the supervisor: MODULE_BLOCK_INIT, motion, MODULE_BLOCK_DONE (man.
// l.2682-2711), and the contents of the command block meanwhile (man. l.6746-6968). Scan thread.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/run/instance.h"

namespace rung::nc::technol {

// A cell of the command block by its name. Nothing when the name is unknown.
std::optional<runtime::Ref> commandCell(const runtime::Instance& instance, std::string_view name);

// A value that a block writes to a cell of the command block.
struct CommandValue {
  core::Place place;
  bool isReal = false; // `real` is the value, else `integer`; an integer cell gets a real rounded
  int64_t integer = 0;
  double real = 0;
};

class Blocks {
  // A block module: its task, the cell of the state in which it waits, and the cell that says whether it has finished.
  struct Module {
    uint32_t task = RUNG_NONE;
    core::Place cont, done;
  };

public:
  // The places that the blocks need in one program.
  class Places {
  public:
    Places() = default; // a program without these
    explicit Places(const rung_program& program);

  private:
    friend class Blocks;
    Module init, done;
    core::Place initPending, startDisable, startSuspend, statusRestart, blockInProgress, positionReached, stopDone,
        annulment;
    std::vector<core::Place> lastOneBlock; // cleared at the end of the block
    std::vector<core::Place> motionBits;   // PO_OS...
    std::vector<core::Place> untilNextStart;
    uint32_t queue = RUNG_NONE; // the space of the queue of command blocks
  };

  // At power-on: no block is under way.
  void reset();
  // Sets the places of the running program, which outlive their use.
  void use(const Places& places) { places_ = &places; }

  // Starts a block. False: a block is under way already.
  bool start(runtime::Instance& instance, std::span<const CommandValue> values);
  // Reports that the programmed position has been reached, or, while MODULE_BLOCK_INIT runs, that the block has no
  // motion. False: no block is in motion.
  bool reached(runtime::Instance& instance);
  bool busy() const { return phase_ != Phase::Idle; }
  // MODULE_BLOCK_INIT has finished: the axes may move.
  bool inMotion() const { return phase_ == Phase::Motion; }
  // Central annulment: the block under way is abandoned, and a block in annulment mode, without motion, follows (man.
  // l.6748-6761, 10826). Programs that hold a block wait for it (l.5180-5183, 6444-6447). It ends a stop.
  void annul(runtime::Instance& instance);
  template <class Archive>
  void state(Archive& archive) {
    archive(phase_, reached_, first_);
  }
  // The work of one scan, between MODULE_INPUT and MODULE_MAIN; modules that do not wait follow each other within it.
  void supervise(runtime::Instance& instance);

private:
  enum class Phase : uint8_t { Idle, Starting, Init, Motion, Done };
  bool mayStart(const runtime::Instance& instance) const;
  void enter(runtime::Instance& instance, Phase phase);
  bool pass(runtime::Instance& instance, const Module& module);
  void endMotion(runtime::Instance& instance);
  void finish(runtime::Instance& instance);

  static const Places kNothing;

  const Places* places_ = &kNothing;
  Phase phase_ = Phase::Idle;
  bool reached_ = false;
  bool first_ = false; // the module runs for the first time in this phase
};

} // namespace rung::nc::technol
