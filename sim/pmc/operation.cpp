// Automatic run of the simulated CNC (see operation.h). The reading of a block is in axes.cpp.
#include "sim/pmc/operation.h"

#include <cmath>

namespace rung::sim::pmc {

void Operation::load(PartProgram program) {
  stored_.insert_or_assign(program.number, program);
  program_ = std::move(program);
  if (runMode_ != Mode::Mdi) next_ = 0;
}

void Operation::loadMdi(PartProgram program) {
  mdi_ = std::move(program);
  if (runMode_ == Mode::Mdi) next_ = 0;
}

bool Operation::select(uint32_t number, bool mdi) {
  const auto found = stored_.find(number);
  if (found == stored_.end()) return false;
  (mdi ? mdi_ : program_) = found->second;
  next_ = 0;
  return true;
}

void Operation::step(const nc::pmc::SignalsIo& io, Machine& machine) {
  Run run{io, machine};
  speed_ = 0;
  followMode(run);
  followButtons(run);
  functions_.step(io);
  progress(run);
  writeSignals(io);
}

void Operation::idle(const nc::pmc::SignalsIo& io, const Tables& tables) {
  mode_ = cnc_->modeOf(io, tables);
  startWasOn_ = io.g(7, 2);
  speed_ = 0;
  writeSignals(io);
}

void Operation::powerOff() {
  Operation fresh(*cnc_);
  fresh.program_ = std::move(program_);
  fresh.stored_ = std::move(stored_);
  *this = std::move(fresh);
}

// Leaving the automatic modes holds the feed; on a change to another automatic mode the block ends first.
void Operation::followMode(Run& run) {
  mode_ = cnc_->modeOf(run.io, run.machine.tables);
  if (state_ != RunState::Start || mode_ == runMode_) return;
  if (runsPrograms(mode_))
    stopAfterBlock_ = true;
  else
    state_ = RunState::Hold;
}

void Operation::followButtons(Run& run) {
  const bool startOn = run.io.g(7, 2); // ST, effective at its falling edge (l.5181)
  const bool pressed = startWasOn_ && !startOn;
  startWasOn_ = startOn;
  const bool hold = !run.io.g(8, 5); // *SP
  if (state_ == RunState::Start && (hold || run.machine.hasAlarm())) state_ = RunState::Hold;
  if (!pressed || hold || run.machine.hasAlarm() || !runsPrograms(mode_) || state_ == RunState::Start) return;
  if (mode_ != runMode_ && inBlock_) return; // a block of another mode must be reset first
  if (mode_ != runMode_ || (state_ == RunState::Reset && !inBlock_)) next_ = 0;
  runMode_ = mode_;
  if (running()->blocks.empty()) return;
  state_ = RunState::Start;
  stopAfterBlock_ = false;
}

void Operation::progress(Run& run) {
  if (state_ == RunState::Reset || state_ == RunState::Suspended) return;
  const bool moves = state_ == RunState::Start;
  bool moved = false;
  // A block without motion and codes takes no time; a motion takes at least one slot.
  for (size_t blocks = 0; blocks <= running()->blocks.size(); ++blocks) {
    if (!inBlock_ && (!moves || !beginBlock(run))) break;
    if (moves && !moved && (moving() || dwellMs_ > 0)) {
      advance(run);
      moved = true;
    }
    if (!blockDone(run)) return;
    finishBlock(run);
    if (state_ != RunState::Start) return;
  }
  if (!inBlock_ && state_ == RunState::Hold) state_ = RunState::Suspended; // l.5165
}

bool Operation::beginBlock(Run& run) {
  const PartProgram& program = *running();
  while (next_ < program.blocks.size() && program.blocks[next_].skipped && run.io.g(44, 0)) ++next_; // BDT l.5437
  if (next_ >= program.blocks.size()) {
    end();
    return false;
  }
  const bool guarded = run.machine.tables.parameterBit(cnc_->parameters.guard);
  if (guarded && !run.io.g(8, 3)) return false; // *BSL l.5557
  const Modal before = modal_;
  prepare(run, program.blocks[next_]);
  const bool cutting = moveCount_ != 0 && !moves_[0].rapid;
  if (guarded && cutting && !run.io.g(8, 1)) { // *CSL l.5569
    modal_ = before;
    return false;
  }
  if (run.machine.hasAlarm()) {
    modal_ = before;
    state_ = RunState::Hold;
    return false;
  }
  sequence_ = program.blocks[next_].sequence != 0 ? program.blocks[next_].sequence : sequence_;
  ++next_;
  inBlock_ = true;
  move_ = 0;
  if (run.io.g(5, 6)) codes_.lock(); // AFL
  if (codes_.any()) codes_.start(functions_, run.io, run.machine.tables.parameterBit(cnc_->parameters.highSpeed));
  if (codes_.s) run.machine.spindle.command(*codes_.s);
  return true;
}

bool Operation::blockDone(Run& run) {
  if (moving() || dwellMs_ > 0 || functions_.busy()) return false;
  if (!externalPending_) return true;
  externalPending_ = false;
  AuxiliaryCodes external;
  external.external = true;
  external.start(functions_, run.io, false);
  functions_.step(run.io); // EF follows the positioning at once
  return false;
}

void Operation::finishBlock(Run& run) {
  inBlock_ = false;
  Tables& tables = run.machine.tables;
  if (codes_.t) tables.set(Table::Tool, 1, 0, *codes_.t * kTableScale);
  bool stop = stopAfterBlock_ || run.io.g(46, 1); // SBK l.5381
  for (uint32_t m : codes_.m) {
    if (m == 6) tables.set(Table::Tool, 0, 0, tables.get(Table::Tool, 1));
    if (cnc_->stopsByM0 && (m == 0 || (m == 1 && run.io.g(8, 2)))) stop = true;
    if (m == 2 || m == 30) return end();
  }
  if (stop && state_ == RunState::Start) state_ = RunState::Suspended;
  if (next_ >= running()->blocks.size()) end();
}

// The program has ended: returns to its beginning and to the reset state.
void Operation::end() {
  state_ = RunState::Reset;
  next_ = 0;
}

void Operation::reset(const nc::pmc::SignalsIo& io, Machine& machine) {
  functions_.abort(io);
  if (state_ != RunState::Reset || inBlock_)
    for (uint32_t i = 0; i < kAxes; ++i)
      if (!machine.isPlcAxis(i)) machine.axes[i].moving = false;
  modal_ = {.path = {.inch = modal_.path.inch, .feed = modal_.path.feed}};
  moveCount_ = move_ = 0;
  dwellMs_ = 0;
  inBlock_ = externalPending_ = stopAfterBlock_ = false;
  state_ = RunState::Reset;
  next_ = 0;
}

void Operation::writeSignals(const nc::pmc::SignalsIo& io) const {
  io.setF(0, 7, state_ != RunState::Reset); // Table 5-1
  io.setF(0, 5, state_ == RunState::Start);
  io.setF(0, 4, state_ == RunState::Hold);
  io.setF(1, 3, inBlock_ && !moving() && dwellMs_ <= 0 && functions_.busy()); // DEN l.5875
  io.setF(2, 7, io.g(46, 7));                                                 // MDRN l.5367
  io.setF(2, 6, inBlock_ && state_ == RunState::Start && moving() && !moves_[move_].rapid);
  io.setF(2, 0, modal_.path.inch); // l.4106
  io.setF(4, 4, io.g(5, 6));
  io.setF(4, 3, io.g(46, 1));
  io.setF(4, 1, io.g(44, 1));
  io.setF(4, 0, io.g(44, 0));
  cnc_->confirm(io, mode_);
}

// The functions of a block.

namespace {

bool passesLock(uint32_t code) { return code <= 2 || code == 30; }

} // namespace

void AuxiliaryCodes::lock() {
  std::erase_if(m, [](uint32_t code) { return !passesLock(code); });
  s.reset();
  t.reset();
  b.reset();
}

void AuxiliaryCodes::start(nc::PmcFunctions& functions, const nc::pmc::SignalsIo& io, bool highSpeed) const {
  using Line = nc::PmcFunctions::Line;
  constexpr Line kLinesOfM[nc::pmc::kMostM] = {Line::M, Line::M2, Line::M3, Line::M4, Line::M5};
  functions.setHighSpeed(highSpeed && !external);
  for (size_t i = 0; i < m.size() && i < std::size(kLinesOfM); ++i) functions.start(io, kLinesOfM[i], m[i]);
  if (s) functions.start(io, Line::S, *s);
  if (t) functions.start(io, Line::T, *t);
  if (b) functions.start(io, Line::B, *b);
  if (external) functions.start(io, Line::External, 0);
}

// Manual motion.

namespace {

constexpr int64_t kIncrement = 10; // 0.001 mm, in units

// x1 x10 x100 x1000 by MP2 MP1, a tenth with MPSELT (l.4609-4613); the second wheel has separate bits (l.4632).
int64_t increment(const Cnc& cnc, const nc::pmc::SignalsIo& io, uint32_t wheel) {
  constexpr int64_t kPowers[] = {1, 10, 100, 1000};
  const uint8_t bits = io.gByte(wheel == 2 ? cnc.secondWheel : 19);
  const int64_t units = kIncrement * kPowers[(bits >> 4) & 3];
  return wheel == 1 && cnc.tenthOfStep && io.g(19, 3) ? units / 10 : units;
}

// G10-G11 in 0.01 % if it is not 0, else G12, which the text also applies to manual feed (l.5691). Inverted
// signals have no such rule.
double jogOverride(const Cnc& cnc, const nc::pmc::SignalsIo& io) {
  const bool inverted = cnc.model->inverted;
  const auto jv = static_cast<uint16_t>(inverted ? ~io.gWord(10) : io.gWord(10));
  if (jv == 0) return inverted ? 0 : feedOverride(cnc, io);
  return jv == 0xFFFF ? 0 : jv / 10000.0;
}

} // namespace

void Manual::step(const nc::pmc::SignalsIo& io, Machine& machine, Mode mode) {
  if (mode != mode_) {
    stop(machine);
    mode_ = mode;
  }
  const uint8_t positive = io.gByte(100);
  const uint8_t negative = io.gByte(102);
  if (mode == Mode::Handle)
    for (uint32_t number = 1; number <= 2; ++number) wheel(io, machine, number);
  pulses_ = {};
  for (uint32_t i = 0; i < machine.axes.count(); ++i) {
    if (machine.isPlcAxis(i)) continue;
    const int bit = 1 << i;
    const bool plus = (positive & bit) != 0, minus = (negative & bit) != 0;
    const bool one = plus != minus;
    const bool fresh = plus ? (positiveWas_ & bit) == 0 : (negativeWas_ & bit) == 0;
    if (mode == Mode::Jog && one) {
      jog(io, machine, i, minus);
    } else if (mode == Mode::Zero && one) {
      returnToReference(io, machine, i);
    } else if (mode == Mode::Step && one && fresh && !pending_[i]) {
      pending_[i] = true;
      target_[i] = machine.axes[i].commanded + (minus ? -1 : 1) * increment(*machine.cnc, io, 1);
    } else if ((mode == Mode::Jog || mode == Mode::Zero) && (driven_ & bit) != 0) {
      machine.axes[i].moving = false;
      machine.axes[i].rest = 0;
      driven_ = static_cast<uint8_t>(driven_ & ~bit);
    }
    if (!pending_[i]) continue;
    driven_ = static_cast<uint8_t>(driven_ | bit);
    pending_[i] = !machine.axes.moveTowards(
        i, target_[i], unitsPerSlot(machine.tables.parameterReal(machine.cnc->parameters.rapid, i)));
  }
  positiveWas_ = positive;
  negativeWas_ = negative;
}

void Manual::jog(const nc::pmc::SignalsIo& io, Machine& machine, uint32_t axis, bool negative) {
  const bool rapid = io.g(19, 7); // RT l.4527
  const Parameters& numbers = machine.cnc->parameters;
  const double full = numbers.jog == 0 ? jogSpeed : machine.tables.parameterReal(numbers.jog, axis);
  const double speed = rapid ? rapidSpeed(io, machine, axis, numbers.rapid) : full * jogOverride(*machine.cnc, io);
  if ((driven_ >> axis & 1) == 0) machine.rapid = rapid;
  driven_ = static_cast<uint8_t>(driven_ | 1 << axis);
  const int64_t far = static_cast<int64_t>(unitsPerSlot(speed)) + kIncrement;
  machine.axes.moveTowards(axis, machine.axes[axis].commanded + (negative ? -far : far), unitsPerSlot(speed));
}

// Return without deceleration blocks (l.5087): straight to the origin while the key is held, whatever its direction.
void Manual::returnToReference(const nc::pmc::SignalsIo& io, Machine& machine, uint32_t axis) {
  Axis& a = machine.axes[axis];
  if (a.atReference[0]) return;
  if ((driven_ >> axis & 1) == 0) machine.rapid = true;
  driven_ = static_cast<uint8_t>(driven_ | 1 << axis);
  const int64_t target = Axes::reference(machine.tables, axis, 1);
  const double speed = rapidSpeed(io, machine, axis, machine.cnc->parameters.manualReturn);
  if (!machine.axes.moveTowards(axis, target, unitsPerSlot(speed))) return;
  if (a.machine == target) machine.axes.arriveAtReference(axis, 1);
}

void Manual::wheel(const nc::pmc::SignalsIo& io, Machine& machine, uint32_t number) {
  const uint8_t selected = number == 1 ? io.gByte(18) & 0xF : io.gByte(18) >> 4; // l.4545-4583
  const int64_t pulses = pulses_[number - 1];
  if (pulses == 0 || selected == 0 || selected > machine.axes.count() || machine.isPlcAxis(selected - 1u)) return;
  const uint32_t axis = selected - 1u;
  if (!pending_[axis]) target_[axis] = machine.axes[axis].commanded;
  pending_[axis] = true;
  target_[axis] += pulses * increment(*machine.cnc, io, number);
}

void Manual::stop(Machine& machine) {
  for (uint32_t i = 0; i < kAxes; ++i)
    if ((driven_ >> i & 1) != 0) {
      machine.axes[i].moving = false;
      machine.axes[i].rest = 0;
    }
  pending_ = {};
  pulses_ = {};
  driven_ = 0;
}

} // namespace rung::sim::pmc
