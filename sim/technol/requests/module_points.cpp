// Connects devices with cells of modules.
#include "sim/technol/requests/module_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <string>

#include "rtlib/nc/config_key.h"
#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/number.h"
#include "sim/technol/events.h"

namespace rung::sim::technol {

using Kind = ModulePoint::Kind;

namespace {

// The values received for the elements of a servo, in the order of ServoPart.
struct ServoInputs {
  uint32_t present = 0; // a bit for each element
  std::array<uint32_t, kServoInputs> values = {};

  bool has(ServoPart part) const { return (present & 1u << part) != 0; }
};

void takeServo(const ServoInputs& found, bool isConnected, ServoCells& servo) {
  servo.isConnected = isConnected;
  if (!isConnected || servo.isSimulated) return;
  servo.status = static_cast<uint16_t>(found.values[kServoStatus]);
  if (found.has(kServoError)) servo.error = static_cast<uint16_t>(found.values[kServoError]);
  if (found.has(kServoPosition)) servo.position = static_cast<int32_t>(found.values[kServoPosition]);
}

void takeServos(const ModuleCells& cells, EthercatServos::Cells& servos) {
  std::array<ServoInputs, EthercatServos::kCount> found;
  uint32_t controlled = 0; // a bit for each servo
  for (const ModuleCells::PointCell& at : cells.points()) {
    if (at.point.kind != Kind::Servo) continue;
    if (at.point.part == kServoControl) controlled |= 1u << at.point.number;
    if (at.point.part >= kServoInputs) continue;
    ServoInputs& servo = found[at.point.number];
    servo.present |= 1u << at.point.part;
    servo.values[at.point.part] = static_cast<uint32_t>(cells.at(at.cell).bits);
  }
  for (uint32_t i = 0; i < servos.size(); ++i)
    takeServo(found[i], found[i].has(kServoStatus) && (controlled >> i & 1) != 0, servos[i]);
}

uint64_t bitsOfReal(double value) { return std::bit_cast<uint64_t>(value); }

double positionAt(const ModulePoint& point, const AxisOutputs& axes) {
  constexpr uint32_t kSpaceWithShift = 6;
  const double shift = axes.shiftMm[point.number];
  if (point.kind == Kind::Shift) return shift;
  return axes.position[point.number] + (point.part == kSpaceWithShift ? shift : 0);
}

// The path speed in mm/min of the first three axes, which are the geometric ones.
double pathSpeed(const AxisOutputs& axes, bool withShift) {
  const auto of = [&](uint32_t axis) { return axes.speed[axis] + (withShift ? axes.shiftSpeed[axis] : 0); };
  return std::hypot(of(0), of(1), of(2));
}

double incrementAt(const ModulePoint& point, const AxisOutputs& axes) {
  constexpr double kTicksPerMinute = 60'000;
  const double speed = axes.speed[point.number];
  switch (static_cast<AxisIncrement>(point.part)) {
  case kPerTick: return speed / kTicksPerMinute;
  case kPerMinute: return speed;
  case kByHand: return has(axes.movedByHand, point.number) ? speed : 0;
  case kPath5PerTick: return pathSpeed(axes, false) / kTicksPerMinute;
  case kPath6PerTick: return pathSpeed(axes, true) / kTicksPerMinute;
  case kPath5PerMinute: return pathSpeed(axes, false);
  case kPath6PerMinute: return pathSpeed(axes, true);
  }
  return 0;
}

// The value of an element of a servo, in the width of its cell; measures have 32 bits.
std::optional<uint64_t> servoGives(uint32_t part, const ServoCells& servo) {
  const auto word = [](int32_t value) { return uint64_t{static_cast<uint32_t>(value)}; };
  const auto um = [&](int32_t increments) { return word(servo.micrometres(increments)); };
  const auto mm = [&](int32_t increments) { return bitsOfReal(increments / servo.incrementsPerUm / 1000); };
  switch (static_cast<ServoPart>(part)) {
  case kServoStatus:
  case kServoError:
  case kServoPosition: return std::nullopt;
  case kServoControl: return servo.control;
  case kServoRequestedPosition: return word(servo.requestedPosition);
  case kServoRequestedVelocity: return word(servo.requestedVelocity);
  case kServoState: return static_cast<uint64_t>(servo.state);
  case kServoBlocksMotion: return servo.blocksMotion ? 1 : 0;
  case kServoFaulty: return servo.isFaulty ? 1 : 0;
  case kFollowingErrorMm: return mm(servo.followingError());
  case kFollowingErrorUm: return um(servo.followingError());
  case kMeasuredMm: return mm(servo.position);
  case kMeasuredUm: return um(servo.position);
  case kMeasuredIncrements: return word(servo.position);
  case kRequestedMm: return mm(servo.requestedPosition);
  case kRequestedUm: return um(servo.requestedPosition);
  }
  return std::nullopt;
}

} // namespace

std::optional<uint64_t> givenAt(const ModulePoint& point, const AxisOutputs& axes, uint32_t axisCount,
                                const EthercatServos::Cells& servos) {
  switch (point.kind) {
  case Kind::Position:
  case Kind::Shift: return point.number < axisCount ? std::optional(bitsOfReal(positionAt(point, axes))) : std::nullopt;
  case Kind::Increment:
    return point.number < axisCount ? std::optional(bitsOfReal(incrementAt(point, axes))) : std::nullopt;
  case Kind::Servo: return servos[point.number].exists() ? servoGives(point.part, servos[point.number]) : std::nullopt;
  case Kind::ProcessData:
  case Kind::Shared:
  case Kind::Key:
  case Kind::None: return std::nullopt;
  }
  return std::nullopt;
}

void takeOutputs(const ModuleCells& cells, EthercatImage& image, EthercatServos::Cells& servos) {
  if (cells.points().empty()) return;
  for (const ModuleCells::PointCell& at : cells.points())
    if (at.point.kind == Kind::ProcessData) image.write(at.point.number, cells.at(at.cell).bits);
  takeServos(cells, servos);
}

void giveInputs(ModuleCells& cells, const EthercatImage& image, const EthercatServos::Cells& servos,
                const AxisOutputs& axes, uint32_t axisCount) {
  for (const ModuleCells::PointCell& at : cells.points()) {
    uint64_t& bits = cells.at(at.cell).bits;
    const bool isProcessData = at.point.kind == Kind::ProcessData;
    if (isProcessData && image[at.point.number].isInput) bits = image.read(at.point.number);
    if (const auto given = givenAt(at.point, axes, axisCount, servos)) bits = *given;
  }
}

// Cells of the program as elements of the real-time manager.

namespace {

constexpr bool isShared(const ModulePoint& point) { return point.kind == ModulePoint::Kind::Shared; }

// SHIFT_ENABLE has a bit for each of the first eight axes (l.11120).
core::Place bitOfAxis(const rung_program& program, std::string_view cell, uint32_t axis) {
  const auto whole = nc::technol::signalPlace(program, cell);
  const auto bit = whole ? runtime::bitOf(*whole, axis) : std::nullopt;
  return bit ? runtime::locate({program, nullptr}, *bit) : core::Place();
}

} // namespace

SharedPoints::SharedPoints(const rung_program& program) {
  for (uint32_t row = 0; row < places_.size(); ++row) {
    const SharedElement& shared = kSharedElements[row];
    const bool isBitOfAxis = shared.cell == "SHIFT_ENABLE";
    const std::string cell(shared.cell);
    for (uint32_t i = 0; i < kMembers; ++i)
      places_[row][i] =
          isBitOfAxis ? bitOfAxis(program, cell, i)
                      : nc::technol::locateSignal(program, shared.area == "RTM.Axis" ? cell : cell + std::to_string(i));
  }
}

void SharedPoints::take(const core::Memory& memory, const ModuleCells& cells) const {
  for (const ModuleCells::PointCell& at : cells.points()) {
    const ModuleCell& cell = cells.at(at.cell);
    if (isShared(at.point) && cell.bits != cell.given) memory.write(placeOf(at.point), cell.bits);
  }
}

void SharedPoints::give(const core::Memory& memory, ModuleCells& cells) const {
  for (const ModuleCells::PointCell& at : cells.points()) {
    if (!isShared(at.point)) continue;
    ModuleCell& cell = cells.at(at.cell);
    cell.bits = cell.given = memory.read(placeOf(at.point));
  }
}

// Keyboards in a program.

namespace {

constexpr const char* kStructures[] = {"TL1W", "TL2W", "TL3W", "TL4W", "TL1K", "TL2K", "TL1P"};
constexpr const char* kNames[] = {"TL_Function", "TL_FunctionReq", "TL_Fun1State", "TL_Fun2State", "TL_Fun3State"};

} // namespace

KeyboardPlaces::KeyboardPlaces(const rung_program& program) : onCommand_(program, "_ON_CMD") {
  static_assert(std::size(kStructures) == kShown && std::size(kNames) == kMembers);
  for (uint32_t keyboard = 0; keyboard < kShown; ++keyboard)
    for (uint32_t i = 0; i < kMembers; ++i)
      cells_[keyboard][i] = nc::technol::locateSignal(program, std::string(kStructures[keyboard]) + "." + kNames[i]);
}

void KeyboardPlaces::write(const core::Memory& memory, const Keyboards& keyboards) const {
  for (uint32_t keyboard = 0; keyboard < kShown; ++keyboard) {
    const KeyboardState& state = keyboards.state(keyboard);
    const uint8_t values[] = {state.function, state.requested, state.states[0], state.states[1], state.states[2]};
    for (uint32_t i = 0; i < kMembers; ++i) memory.write(cells_[keyboard][i], values[i]);
  }
}

void KeyboardPlaces::runCommand(runtime::Instance& instance, int64_t code, bool pressed) const {
  if (!instance.stopped()) onCommand_.run(instance, commandRegister(code), pressed);
}

// Inputs that follow axes and bits.

namespace {

struct NamedBit {
  std::string_view cell;
  std::optional<uint32_t> number; // bit number in a cell
};
NamedBit parts(std::string_view name) {
  const size_t dot = std::min(name.find('.'), name.size());
  if (dot == name.size()) return {name, std::nullopt};
  return {name.substr(0, dot), text::numberIn<uint32_t>(name.substr(dot + 1))};
}

bool isBit(std::string_view name) {
  const auto [cell, number] = parts(name);
  const nc::Signal* signal = nc::findSignal(nc::technolSignals(), cell, "I");
  if (signal == nullptr) return false;
  if (cell.size() == name.size()) return signal->type == nc::SignalType::Bit;
  return number && *number < 8 * nc::elementBytes(signal->type);
}

core::Place placeOf(const rung_program& program, std::string_view name) {
  const auto [cell, number] = parts(name);
  auto place = nc::technol::signalPlace(program, cell);
  if (place && number) place = runtime::bitOf(*place, *number);
  return runtime::locate({program, nullptr}, place.value_or(runtime::Ref{}));
}

} // namespace

std::optional<std::string> InputWiring::configure(std::string_view key, std::string_view value, Axes& axes) {
  constexpr std::string_view kSwitch = "switch.", kFollow = "follow.";
  if (key.starts_with(kFollow)) return follow(key, key.substr(kFollow.size()), value);
  if (!key.starts_with(kSwitch)) return std::nullopt;
  const std::string_view bit = key.substr(kSwitch.size());
  if (!isBit(bit)) return std::string(key) + ": expected the bit of a signal after 'switch.'";
  const auto same = std::ranges::find(switches_, bit, &Bit::name);
  const auto handle = static_cast<uint64_t>(same - switches_.begin());
  if (same == switches_.end()) switches_.push_back({.name = std::string(bit), .place = {}});
  return axes.addSwitch(handle, value);
}

std::string InputWiring::follow(std::string_view key, std::string_view input, std::string_view value) {
  const size_t at = std::min(value.find('@'), value.size());
  Wire wire{.inverted = value.starts_with('/')};
  const std::string_view source = value.substr(wire.inverted ? 1 : 0, at - (wire.inverted ? 1 : 0));
  wire.delayUs = at == value.size() ? 0 : nc::durationUs(value.substr(at + 1));
  if (!isBit(input)) return std::string(key) + ": expected the bit of a signal after 'follow.'";
  if (!isBit(source) || wire.delayUs < 0)
    return std::string(key) + ": expected a bit such as P0OUT.3, /P0OUT.3 or P0OUT.3@100ms, found '" +
           std::string(value) + "'";
  wire.input.name = input;
  wire.source.name = source;
  wires_.push_back(std::move(wire));
  return {};
}

void InputWiring::locate(const rung_program& program) {
  for (Bit& bit : switches_) bit.place = placeOf(program, bit.name);
  for (Wire& wire : wires_) {
    wire.input.place = placeOf(program, wire.input.name);
    wire.source.place = placeOf(program, wire.source.name);
  }
}

void InputWiring::powerOn(const core::Memory& memory) {
  nowUs_ = 0;
  for (Wire& wire : wires_) {
    wire.level = memory.read(wire.source.place) != 0;
    wire.sinceUs = -wire.delayUs;
  }
}

void InputWiring::pass(const core::Memory& memory, const Axes& axes, int64_t us) {
  nowUs_ += us;
  for (const Bit& bit : switches_) memory.write(bit.place, 0);
  for (const Axes::Switch& contact : axes.switches())
    if (axes.isClosed(contact)) memory.write(switches_[contact.bit].place, 1);
  for (Wire& wire : wires_) {
    const bool level = memory.read(wire.source.place) != 0;
    if (level != wire.level) {
      wire.level = level;
      wire.sinceUs = nowUs_;
    }
    if (nowUs_ - wire.sinceUs >= wire.delayUs) memory.write(wire.input.place, level != wire.inverted ? 1 : 0);
  }
}

} // namespace rung::sim::technol
