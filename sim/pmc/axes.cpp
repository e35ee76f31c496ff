// The axes of the simulated CNC.
#include "sim/pmc/axes.h"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "sim/pmc/operation.h"

namespace rung::sim::pmc {

void Axes::beginSlot(const nc::pmc::SignalsIo& io, const Tables& tables, Alarms& alarms) {
  const Parameters& numbers = cnc_->parameters;
  const bool allStop = !io.g(8, 0) && !tables.parameterBit(numbers.noInterlock); // *IT l.3650
  const bool byAxis = !tables.parameterBit(numbers.noAxisInterlock);
  const bool byDirection = !tables.parameterBit(numbers.noDirectionInterlock);
  locked_ = io.g(44, 1); // MLK l.5309
  interlocked_ = allStop ? UINT8_MAX : byAxis ? static_cast<uint8_t>(~io.gByte(130)) : uint8_t{0};
  noPositive_ = byDirection ? io.gByte(132) : uint8_t{0}; // +MIT l.3667
  noNegative_ = byDirection ? io.gByte(134) : uint8_t{0}; // -MIT
  if (!limitSwitches) return;
  for (uint32_t i = 0; i < count(); ++i) {
    const bool positive = !io.g(114, i); // l.3599
    const bool negative = !io.g(116, i);
    if (positive) raiseOverTravel(alarms, cnc_->alarms.overTravelPositive, i);
    if (negative) raiseOverTravel(alarms, cnc_->alarms.overTravelNegative, i);
    axes_[i].blockedPositive |= positive;
    axes_[i].blockedNegative |= negative;
  }
}

void Axes::raiseOverTravel(Alarms& alarms, uint32_t number, uint32_t axis) const {
  alarms.raise(number + (cnc_->alarms.overTravelOfAxis ? axis + 1 : 0));
}

void Axes::clearOverTravel() {
  for (Axis& axis : axes_) axis.blockedPositive = axis.blockedNegative = false;
}

bool Axes::mayMove(uint32_t axis, bool negative) const {
  if ((interlocked_ >> axis & 1) != 0 || (((negative ? noNegative_ : noPositive_) >> axis) & 1) != 0) return false;
  return !(negative ? axes_[axis].blockedNegative : axes_[axis].blockedPositive);
}

void Axes::startMotion(uint32_t axis, bool negative) {
  axes_[axis].moving = true;
  axes_[axis].negative = negative;
}

void Axes::move(uint32_t axis, int64_t delta) {
  if (delta == 0) return;
  Axis& a = axes_[axis];
  a.commanded += delta;
  a.relative += delta;
  if (locked_) return;
  a.machine += delta;
  a.atReference = {};
}

bool Axes::moveTowards(uint32_t axis, int64_t target, double units) {
  Axis& a = axes_[axis];
  const int64_t distance = target - a.commanded;
  if (distance != 0) {
    startMotion(axis, distance < 0);
    if (!mayMove(axis, distance < 0)) return false;
    const double want = a.rest + units;
    int64_t step = static_cast<int64_t>(std::floor(want));
    a.rest = want - static_cast<double>(step);
    step = std::min<int64_t>(step, std::llabs(distance));
    move(axis, distance < 0 ? -step : step);
  }
  if (a.commanded != target) return false;
  a.moving = false;
  a.rest = 0;
  return true;
}

void Axes::place(uint32_t axis, int64_t machine) {
  Axis& a = axes_[axis];
  a.machine = a.commanded = machine;
  a.rest = 0;
  a.atReference = {};
}

int64_t Axes::reference(const Tables& tables, uint32_t axis, uint32_t point) {
  return point == 1 ? 0
                    : std::llround(tables.parameterReal(tables.numbers().reference2 + point - 2, axis) * kUnitsPerMm);
}

void Axes::arriveAtReference(uint32_t axis, uint32_t point) {
  Axis& a = axes_[axis];
  a.atReference[point - 1] = true;
  if (point == 1) a.referenced = true;
}

void Axes::writeSignals(const nc::pmc::SignalsIo& io, const Tables& tables, bool rapid) const {
  io.setF(2, 1, rapid); // RPDO l.5595
  const auto show = [&](uint32_t byte, auto is) {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kAxes; ++i) bits |= uint32_t{is(axes_[i])} << i;
    io.setFByte(byte, static_cast<uint8_t>(bits));
  };
  for (uint32_t point = 0; point < 4; ++point) // l.5028, 5099
    show(94 + 2 * point, [&](const Axis& axis) { return axis.atReference[point]; });
  show(102, [](const Axis& axis) { return axis.moving; });     // MV l.4114
  show(106, [](const Axis& axis) { return axis.negative; });   // MVD l.4144
  show(120, [](const Axis& axis) { return axis.referenced; }); // ZRF l.5058
  show(124, [](const Axis& axis) { return axis.blockedPositive; });
  show(126, [](const Axis& axis) { return axis.blockedNegative; });
  const uint32_t switched = switches(tables);
  for (uint32_t i = 0; i < cnc_->switchCount / 8; ++i) io.setFByte(70 + i, static_cast<uint8_t>(switched >> 8 * i));
}

// The position switches, one bit each (l.4226).
uint32_t Axes::switches(const Tables& tables) const {
  const Parameters& numbers = cnc_->parameters;
  if (!tables.parameterBit(numbers.switches)) return 0; // SWI
  uint32_t bits = 0;
  for (uint32_t i = 0; i < cnc_->switchCount; ++i) {
    const int64_t axis = tables.parameter(numbers.switchAxis + i);
    if (axis < 1 || axis > kAxes) continue;
    const double mm = static_cast<double>(axes_[static_cast<uint32_t>(axis - 1)].machine) / kUnitsPerMm;
    const bool inside =
        mm <= tables.parameterReal(numbers.switchHigh + i) && mm >= tables.parameterReal(numbers.switchLow + i);
    bits |= uint32_t{inside} << i;
  }
  return bits;
}

// Blocks of a part program: modal codes, coordinates and the motion along the path.

namespace {

int64_t placeOnPath(const PathMove& move, uint32_t axis) {
  const double way = static_cast<double>(move.target[axis] - move.start[axis]);
  return move.done >= 1 - 1e-12 ? move.target[axis] : move.start[axis] + std::llround(way * move.done);
}

bool displaced(const Machine& machine, const PathMove& move) {
  for (uint32_t i = 0; i < machine.axes.count(); ++i)
    if (move.target[i] != move.start[i] && machine.axes[i].commanded != placeOnPath(move, i)) return true;
  return false;
}

constexpr int kToReference = 280, kToOtherReference = 300, kInMachine = 530, kDwell = 40;

} // namespace

// Workpiece and tool offsets of an axis, in units.
int64_t Operation::shift(const Machine& machine, uint32_t axis) const {
  const Tables& tables = machine.tables;
  int64_t shift = tables.get(Table::WorkOffset, 0, axis) + tables.get(Table::WorkOffset, modal_.workOffset, axis);
  if (modal_.lengthSign != 0 && modal_.h != 0 && machine.axes.names[axis] == 'Z')
    shift += tables.get(Table::ToolOffset, modal_.h - 1, 0) + tables.get(Table::ToolOffset, modal_.h - 1, 1);
  return shift;
}

double Operation::absolute(const Machine& machine, uint32_t axis) const {
  return static_cast<double>(machine.axes[axis].commanded - shift(machine, axis)) / kUnitsPerMm;
}

int64_t Operation::distanceToGo(const Machine& machine, uint32_t axis) const {
  return moving() ? moves_[move_].target[axis] - machine.axes[axis].commanded : 0;
}

void Operation::modalCode(Run&, int tenths, double p) {
  modal_.path.take(tenths);
  switch (tenths) {
  case 0:
  case 10:
    modal_.cutting = tenths == 10;
    modal_.external = false;
    return;
  case 430: modal_.lengthSign = 1; return;
  case 490: modal_.lengthSign = 0; return;
  case 541: modal_.workOffset = 6 + static_cast<uint32_t>(std::max(p, 1.0)); return;
  case 800: modal_.external = false; return;
  case 810:
    modal_.external = true;
    modal_.cutting = false;
    return;
  default:
    if (tenths >= 540 && tenths <= 590) modal_.workOffset = 1 + static_cast<uint32_t>(tenths - 540) / 10;
    return;
  }
}

// Takes the codes first, then the words that depend on them.
void Operation::prepare(Run& run, const Block& block) {
  codes_.m.clear();
  codes_ = {.m = std::move(codes_.m)}; // keeps its memory
  moveCount_ = 0;
  dwellMs_ = 0;
  std::array<std::optional<double>, kAxes> words;
  int special = -1;
  double p = 0, x = 0;
  const auto value = [&](const Word& word) {
    return word.value.variable == 0 ? word.value.number
                                    : static_cast<double>(run.machine.macro(word.value.variable, run.io)) / kTableScale;
  };
  for (const Word& word : block.words)
    if (word.letter == 'P') p = value(word);
  for (const Word& word : block.words) {
    if (word.letter != 'G') continue;
    const int tenths = static_cast<int>(std::lround(value(word) * 10));
    if (tenths == kToReference || tenths == kToOtherReference || tenths == kInMachine || tenths == kDwell)
      special = tenths;
    modalCode(run, tenths, p);
  }
  for (const Word& word : block.words) {
    const double v = value(word);
    const size_t axis = run.machine.axes.names.find(word.letter);
    const auto code = [&] { return static_cast<uint32_t>(std::max(v, 0.0)); };
    if (axis != std::string::npos) {
      if (special == kDwell) x = v;
      words[axis] = v;
    } else if (word.letter == '#') {
      run.machine.setMacro(word.variable, std::llround(v * kTableScale), run.io);
    } else if (word.letter == 'F') {
      modal_.path.feed = modal_.path.length(v);
    } else if (word.letter == 'H') {
      modal_.h = code();
    } else if (word.letter == 'D') {
      modal_.d = code();
    } else if (word.letter == 'M') {
      codes_.m.push_back(code());
    } else if (word.letter == 'S') {
      codes_.s = code();
    } else if (word.letter == 'T') {
      codes_.t = code();
    } else if (word.letter == 'B') {
      codes_.b = code();
    }
  }
  if (special == kDwell)
    dwellMs_ = p > 0 ? p : x * 1000;
  else
    prepareMotion(run, words, special, static_cast<uint32_t>(p));
}

void Operation::prepareMotion(Run& run, const std::array<std::optional<double>, kAxes>& words, int special,
                              uint32_t p) {
  Machine& m = run.machine;
  PathMove move;
  move.rapid = !modal_.cutting || special >= 0;
  bool any = false;
  for (uint32_t i = 0; i < kAxes; ++i) move.start[i] = move.target[i] = m.axes[i].commanded;
  for (uint32_t i = 0; i < m.axes.count(); ++i) {
    const std::optional<double>& word = words[i];
    if (!word) continue;
    any = true;
    if (m.isPlcAxis(i)) m.alarms.raise(m.cnc->alarms.plcAxis);
    const int64_t units = std::llround(modal_.path.length(*word * kUnitsPerMm));
    move.target[i] = special == kInMachine ? units : modal_.path.target(units, move.start[i], shift(m, i));
  }
  if (!any) return;
  if (!move.rapid && modal_.path.feed <= 0) m.alarms.raise(m.cnc->alarms.noFeed);
  externalPending_ = modal_.external;
  moves_[moveCount_++] = move;
  if (special != kToReference && special != kToOtherReference) return;
  const uint32_t point = special == kToReference ? 1 : std::clamp<uint32_t>(p == 0 ? 2 : p, 2, 4);
  move.start = move.target;
  move.reference = point;
  for (uint32_t i = 0; i < m.axes.count(); ++i) {
    if (!words[i]) continue;
    if (point != 1 && !m.axes[i].referenced) m.alarms.raise(m.cnc->alarms.notReferenced);
    move.target[i] = Axes::reference(m.tables, i, point);
    move.arrives = static_cast<uint8_t>(move.arrives | 1 << i);
  }
  moves_[moveCount_++] = move;
}

// The fraction of the path that this slot covers.
double Operation::pathStep(Run& run, const PathMove& move) {
  const Machine& m = run.machine;
  double length = 0, part = 1;
  for (uint32_t i = 0; i < m.axes.count(); ++i) {
    const double distance = std::fabs(static_cast<double>(move.target[i] - move.start[i]));
    length += distance * distance;
    if (move.rapid && distance > 0)
      part = std::min(part, unitsPerSlot(rapidSpeed(run.io, m, i, m.cnc->parameters.rapid)) / distance);
  }
  length = std::sqrt(length);
  if (length == 0) return 1;
  if (!move.rapid) {
    double feed = modal_.path.feedPerMinute(m.spindle.actual());
    if (run.io.g(46, 7)) feed = m.tables.parameterReal(m.cnc->parameters.dryRun); // l.5339
    feed *= feedOverride(*m.cnc, run.io);
    const uint32_t safe = m.cnc->parameters.safeFeed;
    if (safe != 0 && run.io.g(19, 6)) feed = std::min(feed, m.tables.parameterReal(safe)); // FVL
    part = unitsPerSlot(feed) / length;
  }
  part = std::min(part, 1 - move.done);
  speed_ = part * length * 60000.0 / kSlotMs / kUnitsPerMm;
  return part;
}

void Operation::advance(Run& run) {
  Machine& m = run.machine;
  if (!moving()) {
    dwellMs_ = std::max(0.0, dwellMs_ - kSlotMs);
    return;
  }
  PathMove& move = moves_[move_];
  bool may = !run.io.g(7, 1); // STLK l.5547
  if (may && !move.begun) m.rapid = move.rapid;
  if (!move.begun || displaced(m, move)) { // moved by hand in a feed hold: it continues straight from there
    for (uint32_t i = 0; i < m.axes.count(); ++i) move.start[i] = m.axes[i].commanded;
    for (uint32_t i = 0; i < m.axes.count(); ++i)
      if (m.isPlcAxis(i)) move.target[i] = move.start[i];
    move.done = 0;
    move.begun = true;
  }
  for (uint32_t i = 0; i < m.axes.count(); ++i) {
    if (move.target[i] == move.start[i]) continue;
    const bool negative = move.target[i] < move.start[i];
    m.axes.startMotion(i, negative);
    may = may && m.axes.mayMove(i, negative); // all axes of a linkage stop (l.3680)
  }
  if (!may) return;
  move.done += pathStep(run, move);
  const bool arrived = move.done >= 1 - 1e-12;
  for (uint32_t i = 0; i < m.axes.count(); ++i) {
    const bool travels = move.target[i] != move.start[i];
    if (travels) m.axes.move(i, placeOnPath(move, i) - m.axes[i].commanded);
    if (!arrived) continue;
    if (travels) m.axes[i].moving = false;
    if (((move.arrives >> i) & 1) != 0 && m.axes[i].machine == move.target[i])
      m.axes.arriveAtReference(i, move.reference);
  }
  if (arrived) ++move_;
}

} // namespace rung::sim::pmc
