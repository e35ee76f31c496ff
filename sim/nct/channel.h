// One channel of the simulated NCT control (man. 7.15): its mode and the operator's conditions, start and stop, and the
// execution of part programs: automatic mode, MDI mode, and single blocks in the manual modes. It works once per PLC
// cycle, before the PLC.
//
// A block is done when its motion has ended and CP_FIN=1, which is checked one PLC cycle after the strobes.
#pragma once
#include "sim/nct/channel_functions.h"
#include "sim/nct/channel_motion.h"

namespace rung::sim::nct {

class Channel {
public:
  // In the order of ChannelSignals::mode.
  enum class Mode : uint8_t { Jog, Incremental, Handwheel, Reference, Edit, Automatic, Mdi };

  Channel(Links& links, uint32_t number, const ChannelSignals& signals, const ChannelParameters& parameters);
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  void powerOn();
  void cycle(const ChannelProgram* selected, int64_t us);
  void timeSlice() const { run().motion.timeSlice(start_); }
  void reset(); // the RESET key

  bool running() const { return start_ || stop_; }
  bool busy() const { return running() || interrupted_; }
  // The synchronisation M code for which the channel waits; negative: none. `release` ends the wait.
  int32_t waiting() const { return run().waiting; }
  void release() { run().waiting = -1; }
  bool waitsForOthers() const;

  // These functions return "", or the error.
  std::string enter(std::string_view blocks); // for MDI mode, or a single block in a manual mode
  std::string check(const ChannelProgram& program) const;
  void forgetInterruption(); // another program has been selected
  void setTurning(bool turning) { turning_ = turning; }

  uint32_t blocksAhead() const;                   // of the program in progress: the records in its buffer
  uint32_t sequence() const { return sequence_; } // N of the block in progress
  int32_t parts = 0;                              // number of parts machined
  int32_t partsWanted = 0;

  // The selected program belongs to the memory of all channels.
  const ChannelProgram* selected() const { return selected_; }
  void setSelected(const ChannelProgram* selected) { selected_ = selected; }
  template <class Archive>
  void state(Archive& archive) {
    archive(parts, partsWanted, handover_, automaticRun_, otherRun_, entered_, hasEntered_, toggles_, askedBefore_,
            optionsBefore_, machineOn_, start_, stop_, interrupted_, restart_, return_, fresh_, sequence_);
    archive.atMost(mode_, kModes - 1);
    archive.atMost(wanted_, kModes - 1);
  }

private:
  // A program in progress. Automatic mode keeps its own while it is interrupted.
  struct Run {
    explicit Run(ChannelMotion motionOfChannel) : motion(motionOfChannel) {}
    ChannelMotion motion;
    uint32_t next = 0; // block
    BlockFunctions functions;
    uint32_t issued = 0; // mask of functions
    uint32_t open = 0;   // functions not acknowledged when the program was interrupted
    int32_t waiting = -1;
    bool active = false; // a block is in progress
    bool stopAfter = false;
    bool endAfter = false;
    template <class Archive>
    void state(Archive& archive) {
      archive(motion, next, functions, issued, open, waiting, active, stopAfter, endAfter);
    }
  };

  bool automatic() const { return mode_ == Mode::Automatic; }
  bool manual() const { return mode_ <= Mode::Handwheel; }
  Run& run() { return automatic() ? automaticRun_ : otherRun_; }
  const Run& run() const { return automatic() ? automaticRun_ : otherRun_; }
  bool get(const BitSignal& signal) const { return links_.signals.get(signal, channel_); }
  void set(const BitSignal& signal, bool value) const { links_.signals.set(signal, channel_, value); }
  bool on(uint32_t toggle) const { return toggles_[toggle]; }
  bool locked() const { return on(0) || on(1); } // test, machine lock
  bool functionsLocked() const { return locked() || on(3); }

  // Evaluate the words of the requests: `asked` has CP_START, `options` has CP_SGLBK.
  void followMachine();
  void followModes(uint32_t asked);
  void changeMode(Mode mode);
  void followToggles(uint32_t asked);
  void followConditions(uint32_t asked, uint32_t options);
  void followStop(uint32_t asked);
  void followStart(uint32_t asked);
  const ChannelProgram* program() const;
  void goOn();  // after an interruption
  void leave(); // ends the running program because of a change of mode or an emergency stop
  void clear(Run& run);

  void advance();
  bool beginBlock(const ChannelProgram& program);
  bool skipped(const ProgramBlock& block) const;
  bool jumps(const ProgramBlock& block, const ChannelProgram& program);
  int32_t waitingCode(const ProgramBlock& block) const;
  BlockFunctions collect(const ProgramBlock& block) const;
  uint32_t spindleOf(const ProgramBlock& block, const ProgramWord& word) const;
  void issue(uint32_t mask);
  bool blockDone() const;
  void endBlock(const ChannelProgram& program);
  void finish();
  void showState();
  void countTime(int64_t us) const;

  Links& links_;
  uint32_t channel_;
  const ChannelSignals& signals_;
  const ChannelParameters& parameters_;
  ChannelFunctions handover_;
  Run automaticRun_;
  Run otherRun_;

  const ChannelProgram* selected_ = nullptr;
  ChannelProgram entered_; // its memory is kept until the next one is entered
  bool hasEntered_ = false;
  Mode mode_ = Mode::Jog;
  Mode wanted_ = Mode::Jog;
  std::array<bool, kToggles> toggles_{};
  uint32_t askedBefore_ = 0, optionsBefore_ = 0; // words of requests in the previous cycle
  bool machineOn_ = false;
  bool start_ = false, stop_ = false, interrupted_ = false;
  bool restart_ = false, return_ = false;
  bool turning_ = false; // a lathe channel
  bool fresh_ = false;   // the program has not yet seen the strobes of this cycle
  uint32_t sequence_ = 0;
};

} // namespace rung::sim::nct
