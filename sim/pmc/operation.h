// The auxiliary functions M, S, T, B of a part program's block (GSK's man. §7, l.5732-6131).
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "rtlib/nc/control/pmc/pmc_functions.h"
#include "sim/part_program.h"
#include "sim/pmc/machine.h"
#include "sim/pmc/part_program.h"

namespace rung::sim::pmc {

struct AuxiliaryCodes {
  std::vector<uint32_t> m; // at most nc::pmc::kMostM
  std::optional<uint32_t> s, t, b;
  bool external = false; // EF of G81 (l.9450)
  // AFL suppresses all codes except M00, M01, M02, M30 (l.5947-5952).
  void lock();
  bool any() const { return !m.empty() || s || t || b || external; }
  // Starts all functions in one slot, when no other function is in progress. Those beside the external one use the
  // common answer.
  void start(nc::PmcFunctions& functions, const nc::pmc::SignalsIo& io, bool highSpeed) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(m, s, t, b, external);
    archive.require(m.size() <= nc::pmc::kMostM);
  }
};

// Modes and the automatic operation of the simulated CNC: cycle start, feed hold, single block, the blocks of a part
// program with their motions and auxiliary functions (man. chapters 1.5, V, VI).

enum class RunState : uint8_t { Reset, Start, Hold, Suspended };

// One straight motion of all axes of a block.
struct PathMove {
  std::array<int64_t, kAxes> start = {};
  std::array<int64_t, kAxes> target = {};
  bool rapid = true;
  uint32_t reference = 0; // reference point 1-4, reached by the axes in `arrives`
  uint8_t arrives = 0;
  double done = 0; // 0-1
  bool begun = false;

  template <class Archive>
  void state(Archive& archive) {
    archive(start, target, rapid, reference, arrives, done, begun);
    archive.require(reference <= 4 && (reference != 0 || arrives == 0));
  }
};

struct Modal {
  PathModes path;
  bool cutting = false;    // G1
  bool external = false;   // from G81 until G80 or a code of group 01
  uint32_t workOffset = 1; // G54
  uint32_t h = 0, d = 0;
  int lengthSign = 0; // 1: G43; 0: off

  template <class Archive>
  void state(Archive& archive) {
    archive(path, cutting, external, workOffset, h, d, lengthSign);
  }
};

class Operation {
public:
  // The table of the CNC outlives it.
  explicit Operation(const Cnc& cnc) : cnc_(&cnc), functions_(*cnc.model, nc::PmcFunctions::Answer::ByLevel) {
    codes_.m.reserve(nc::pmc::kMostM);
  }
  void load(PartProgram program);
  void loadMdi(PartProgram program);
  bool select(uint32_t number, bool mdi); // selects a program that was loaded before
  void step(const nc::pmc::SignalsIo& io, Machine& machine);
  void idle(const nc::pmc::SignalsIo& io, const Tables& tables); // a slot during reset: only modes and confirmations
  void reset(const nc::pmc::SignalsIo& io, Machine& machine);
  void powerOff(); // programs are kept, nothing runs

  Mode mode() const { return mode_; }
  RunState state() const { return state_; }
  uint32_t programNumber() const { return program_.number; }
  uint32_t sequence() const { return sequence_; }
  double speed() const { return speed_; }                            // mm/min along the path, in the last slot
  double absolute(const Machine& machine, uint32_t axis) const;      // mm, workpiece coordinates
  int64_t distanceToGo(const Machine& machine, uint32_t axis) const; // units, of the block in progress

  template <class Archive>
  void state(Archive& archive) {
    archive(program_, mdi_, stored_, mode_, runMode_, state_, startWasOn_, stopAfterBlock_, sequence_, inBlock_, modal_,
            codes_, moves_, dwellMs_, externalPending_, functions_, speed_);
    archive.atMost(next_, UINT32_MAX);
    archive.atMost(moveCount_, moves_.size());
    archive.atMost(move_, moves_.size());
  }

private:
  struct Run; // the parameters of one step
  void followMode(Run& run);
  void followButtons(Run& run);
  void progress(Run& run);
  bool beginBlock(Run& run);
  void prepare(Run& run, const Block& block);
  void modalCode(Run& run, int tenths, double p);
  void prepareMotion(Run& run, const std::array<std::optional<double>, kAxes>& words, int special, uint32_t p);
  void advance(Run& run);
  bool blockDone(Run& run);
  void finishBlock(Run& run);
  void end();
  bool moving() const { return move_ < moveCount_; }
  double pathStep(Run& run, const PathMove& move);
  int64_t shift(const Machine& machine, uint32_t axis) const;
  void writeSignals(const nc::pmc::SignalsIo& io) const;

  const Cnc* cnc_;
  PartProgram program_;
  PartProgram mdi_;
  std::map<uint32_t, PartProgram> stored_; // by O number
  const PartProgram* running() const { return runMode_ == Mode::Mdi ? &mdi_ : &program_; }

  Mode mode_ = Mode::None;
  Mode runMode_ = Mode::Auto;
  RunState state_ = RunState::Reset;
  bool startWasOn_ = false;
  bool stopAfterBlock_ = false;
  size_t next_ = 0;
  uint32_t sequence_ = 0;

  // The block in progress.
  bool inBlock_ = false;
  Modal modal_;
  AuxiliaryCodes codes_;
  std::array<PathMove, 2> moves_; // of a block: via an intermediate point to a reference point
  size_t moveCount_ = 0;
  size_t move_ = 0; // index of the move in progress
  double dwellMs_ = 0;
  bool externalPending_ = false;
  nc::PmcFunctions functions_;
  double speed_ = 0;
};

// Shared by the source files of Operation.

struct Operation::Run {
  const nc::pmc::SignalsIo& io;
  Machine& machine;
};

// Manual motion of the simulated CNC: jog, single step, handwheels, return to the reference point (man. chapters III,
// IV).

class Manual {
public:
  double jogSpeed = 2000; // mm/min at 100 %, where no parameter has it

  // Adds pulses of handwheel 1 or 2, signed; they move the axis in handwheel mode and are lost in other modes.
  void turnWheel(uint32_t wheel, int64_t pulses) { pulses_[wheel - 1] += pulses; }
  void step(const nc::pmc::SignalsIo& io, Machine& machine, Mode mode);
  void stop(Machine& machine);

  template <class Archive>
  void state(Archive& archive) {
    archive(pulses_, target_, pending_, positiveWas_, negativeWas_, driven_, mode_);
  }

private:
  void jog(const nc::pmc::SignalsIo& io, Machine& machine, uint32_t axis, bool negative);
  void wheel(const nc::pmc::SignalsIo& io, Machine& machine, uint32_t number);
  void returnToReference(const nc::pmc::SignalsIo& io, Machine& machine, uint32_t axis);

  std::array<int64_t, 2> pulses_ = {};
  std::array<int64_t, kAxes> target_ = {}; // of steps and wheels; valid where `pending_`
  std::array<bool, kAxes> pending_ = {};
  uint8_t positiveWas_ = 0;
  uint8_t negativeWas_ = 0;
  uint8_t driven_ = 0; // axes moved by this class
  Mode mode_ = Mode::None;
};

} // namespace rung::sim::pmc
