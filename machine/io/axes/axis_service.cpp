// See axis_service.h.
#include "machine/io/axes/axis_service.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::io {

namespace {

constexpr auto kFirstKind = static_cast<uint32_t>(ServiceKind::AnalogPort);

} // namespace

OutputPlaces::OutputPlaces(const rung_program& program) {
  nc::technol::locateElements(program, "SU_OUT_PLC", outputs_);
}

void OutputPlaces::zero(const core::Memory& memory) const {
  for (const core::Place& place : outputs_) memory.write(place, 0);
}

void AxisService::powerOn() noexcept {
  outputs_.reset();
  spindles_ = 0;
  positioned_.powerOn();
}

bool AxisService::answer(DeviceCall& call, const AxisCells& cells) {
  const uint32_t bit = 1u << (static_cast<uint32_t>(call.kind()) - kFirstKind);
  if (outOfRange(call.request())) {
    outOfRange_.fetch_or(bit, std::memory_order_relaxed);
    answerNothing(call);
    return true;
  }
  if (answerAnalog(*this, call)) return true;
  if (const auto axis = positionedAxis(call.request()); axis && positioned_.has(*axis))
    return answerPosition(positioned_, cells, call);
  refused_.fetch_or(bit, std::memory_order_relaxed);
  return false;
}

void AxisService::fault(const core::Memory& memory, const OutputPlaces& places) noexcept {
  outputs_.zeroOutputs();
  places.zero(memory);
  positioned_.brake();
}

// ---- analogue outputs ----------------------------------------------------------------------------------------------

void AxisService::analogPort(int64_t port) { outputs_.selectPort(static_cast<uint32_t>(port)); }

AnalogOutput AxisService::analogOnSpindle(int64_t value, int64_t axis, int64_t spi) {
  return outputs_.putOnSpindle(value, static_cast<uint32_t>(axis), static_cast<uint32_t>(spi));
}

AnalogOutput AxisService::analogSpi(int64_t value, int64_t axis) {
  return outputs_.putOn(static_cast<uint32_t>(axis), value);
}

AnalogOutput AxisService::axSpi(int64_t axis, SpindleRole role) {
  spindles_ |= 1u << (axis - 1);
  positioned_.becomeSpindle(static_cast<uint32_t>(axis));
  return outputs_.switchTo(static_cast<uint32_t>(axis), role);
}

// An axis that is not a spindle yet becomes one (inventory of the services, 4).
void AxisService::spiMain(int64_t axis) {
  if ((spindles_ >> (axis - 1) & 1) == 0) axSpi(axis, SpindleRole::Keep);
  outputs_.makeMain(static_cast<uint32_t>(axis));
}

// ---- reports -------------------------------------------------------------------------------------------------------

void AxisService::report(std::vector<std::string>& lines) {
  const auto nameOf = [](uint32_t bit) {
    return std::string(nc::technol::deviceService(static_cast<ServiceKind>(kFirstKind + bit)).service.name);
  };
  const auto add = [&](const std::atomic<uint32_t>& kinds, uint32_t& reported, const char* sentence) {
    const uint32_t all = kinds.load(std::memory_order_relaxed);
    const uint32_t fresh = all & ~std::exchange(reported, all);
    for (uint32_t i = 0; i < 32; ++i)
      if ((fresh >> i & 1) != 0) lines.push_back(nameOf(i) + sentence);
  };
  add(refused_, refusedReported_,
      positioned_.added() == 0 ? ": this host cannot move axes for the program; the instruction is refused"
                               : ": this host cannot move this axis for the program; the instruction is refused");
  positioned_.report(lines);
  add(outOfRange_, outOfRangeReported_, ": an axis, port or role is out of range; nothing is done");
}

// Pins of axes.

namespace {

using host::Direction, host::PinType;

struct AxisPin {
  std::string_view name;
  PinType type;
  Direction direction;
};
enum : uint32_t { kPosition, kHomed, kEnabled, kFault, kCommand, kEnable }; // indices into kPins
constexpr AxisPin kPins[] = {
    {"position-feedback", PinType::Float, Direction::In},
    {"homed", PinType::Bit, Direction::In},
    {"enabled", PinType::Bit, Direction::In},
    {"fault", PinType::Bit, Direction::In},
    {"position-command", PinType::Float, Direction::Out},
    {"enable", PinType::Bit, Direction::Out},
};

} // namespace

std::string AxisPins::add(host::File& map, uint32_t axis, const std::string& prefix) {
  const auto first = static_cast<uint32_t>(map.pins.size());
  for (const AxisPin& pin : kPins) {
    const std::string name = prefix + "." + std::string(pin.name);
    if (const auto same = std::ranges::find(map.pins, name, &host::Pin::name); same != map.pins.end())
      return "found a pin " + name + (same->ofHost ? "" : " in line " + std::to_string(same->at.line)) +
             " already, which axis " + std::to_string(axis) + " is to have; give one of them another name";
    map.pins.push_back({.name = name, .type = pin.type, .direction = pin.direction, .ofHost = true});
  }
  pins_.push_back({axis, first});
  return {};
}

void AxisPins::connect(const host::PinCell* cells, const host::PinAccess& access) noexcept {
  cells_ = cells;
  access_ = &access;
}

void AxisPins::read(PositionedAxes& axes) const noexcept {
  if (cells_ == nullptr) return;
  for (const Pins& pins : pins_) {
    const host::PinCell* cells = cells_ + pins.first;
    axes.inputs(pins.axis) = {.position = access_->read(PinType::Float, cells[kPosition]).real,
                              .homed = access_->read(PinType::Bit, cells[kHomed]).bit,
                              .enabled = access_->read(PinType::Bit, cells[kEnabled]).bit,
                              .fault = access_->read(PinType::Bit, cells[kFault]).bit};
  }
}

void AxisPins::write(const PositionedAxes& axes) const noexcept {
  if (cells_ == nullptr) return;
  for (const Pins& pins : pins_) {
    const DriveOutputs outputs = axes.outputs(pins.axis);
    access_->write(PinType::Float, cells_[pins.first + kCommand], {.real = outputs.position});
    access_->write(PinType::Bit, cells_[pins.first + kEnable], {.bit = outputs.enable});
  }
}

// Axes that positioning units move.

namespace {

// Attributes of NCAxis that determine ramps and speeds; the others concern motions of the control itself.
constexpr std::string_view kDynamics[] = {"Acceleration", "AccelerationEmergency", "FeedRT"};

std::string setLength(double& length, std::string_view attribute, std::string_view value) {
  const auto number = text::realIn(value);
  if (!number || *number < 0 || *number > kFarthest)
    return std::string(attribute) + " takes 0 to 1e9 mm, not '" + std::string(value) + "'";
  length = *number;
  return {};
}

} // namespace

// ---- settings ------------------------------------------------------------------------------------------------------

void PositionedAxes::add(uint32_t axis) { setBit(added_, index(axis)); }

bool PositionedAxes::takes(std::string_view attribute) {
  const auto is = [&](std::string_view name) { return text::equalsIgnoringCase(attribute, name); };
  return is("MaxDifference") || is("FollowingErrorLimit") || std::ranges::any_of(kDynamics, is);
}

std::string PositionedAxes::set(uint32_t number, std::string_view attribute, std::string_view value) {
  Axis& axis = axes_[index(number)];
  const auto is = [&](std::string_view name) { return text::equalsIgnoringCase(attribute, name); };
  if (is("MaxDifference")) return setLength(axis.maxDifference, attribute, value);
  if (is("FollowingErrorLimit")) return setLength(axis.followingErrorLimit, attribute, value);
  if (takes(attribute)) return axis.attributes.set(attribute, value);
  return "'" + std::string(attribute) + "' is not an attribute of an axis here; there are Acceleration, " +
         "AccelerationEmergency, FeedRT, MaxDifference and FollowingErrorLimit";
}

// ---- a step --------------------------------------------------------------------------------------------------------

void PositionedAxes::powerOn() noexcept {
  units_.reset();
  permits_ = {};
  for (Axis& axis : axes_) {
    axis.leave(axis.attributes.accelerationEmergency);
    axis.requested = axis.negative = axis.spindle = false;
  }
}

PositionedAxes::Obstacle PositionedAxes::obstacleOf(const Axis& axis) {
  const DriveInputs& in = axis.in;
  if (!in.homed) return Obstacle::NotHomed;
  if (!in.enabled || !std::isfinite(in.position)) return Obstacle::NotEnabled;
  if (in.fault) return Obstacle::Fault;
  const double error = std::fabs(in.position - axis.motion.position());
  return axis.followingErrorLimit > 0 && error > axis.followingErrorLimit ? Obstacle::TooFar : Obstacle::None;
}

void PositionedAxes::step(int64_t ns) noexcept {
  for (uint32_t i = 0; i < kMaxAxes; ++i)
    if (io::has(added_, i)) step(axes_[i], i + 1, ns);
}

// In the first step, and while the drive does not follow, the command is the actual position, so the axis starts
// without a jump.
void PositionedAxes::step(Axis& axis, uint32_t number, int64_t ns) noexcept {
  const bool isPlace = std::isfinite(axis.in.position);
  if (isPlace && !std::exchange(axis.begun, true)) axis.motion.place(axis.in.position);
  const Obstacle obstacle = obstacleOf(axis);
  if (obstacle != Obstacle::None && units_.holds(number)) {
    units_.lose(axis, number);
    note(lost_, obstacle, number);
  }
  if (obstacle == Obstacle::None)
    units_.drive(axis, number, permits_);
  else if (follows(obstacle))
    axis.motion.stop(axis.attributes.accelerationEmergency);
  else if (isPlace)
    axis.motion.place(axis.in.position);
  axis.motion.advance(ns);
  axis.settled = std::fabs(axis.in.position - axis.motion.position()) <= axis.maxDifference;
  units_.look(axis, number);
  if (axis.mover == Mover::None && axis.motion.isAtRest()) axis.requested = false;
}

DriveOutputs PositionedAxes::outputs(uint32_t axis) const {
  return {.position = axes_[index(axis)].motion.position(), .enable = io::has(loops_, index(axis))};
}

bool PositionedAxes::atRest() const noexcept {
  return std::ranges::all_of(axes_, [](const Axis& axis) { return axis.motion.isAtRest(); });
}

void PositionedAxes::take(const core::Memory& memory, const AxisCells& cells) noexcept {
  if (added_ == 0) return;
  cells.read(memory, permits_);
  loops_ = cells.loops().read(memory);
}

void PositionedAxes::show(const core::Memory& memory, const AxisCells& cells) noexcept {
  if (added_ == 0) return;
  report_.motion = report_.negative = 0;
  for (uint32_t i = 0; i < kMaxAxes; ++i) {
    if (!io::has(added_, i)) continue;
    const Axis& axis = axes_[i];
    if (axis.requested) setBit(report_.motion, i);
    if (axis.negative) setBit(report_.negative, i);
    if (std::isfinite(axis.in.position)) report_.place(i, axis.in.position);
  }
  cells.write(memory, added_, report_);
}

// ---- instructions --------------------------------------------------------------------------------------------------

void PositionedAxes::becomeSpindle(uint32_t axis) noexcept {
  axes_[index(axis)].spindle = true;
  units_.lose(axes_[index(axis)], axis);
}

void PositionedAxes::posInit(int64_t number, int64_t, bool loopClosed) {
  Axis& axis = axes_[index(number)];
  const auto own = static_cast<uint32_t>(number);
  Obstacle obstacle = obstacleOf(axis);
  if (axis.spindle) obstacle = Obstacle::Spindle;
  if (!loopClosed) obstacle = Obstacle::Open;
  units_.init(axis, own, obstacle == Obstacle::None);
  if (obstacle == Obstacle::None && !units_.holds(own)) obstacle = Obstacle::NoUnit;
  obstacle == Obstacle::None ? forget(own) : note(refused_, obstacle, own);
}

PositioningUnits::Mode PositionedAxes::posMode(int64_t axis, int32_t length, uint16_t acceleration) {
  return units_.program(axes_[index(axis)], static_cast<uint32_t>(axis), length, acceleration);
}

PositioningUnits::State PositionedAxes::posControl(int64_t axis, uint32_t feed, bool mp) {
  return units_.control(axes_[index(axis)], static_cast<uint32_t>(axis), feed, mp);
}

void PositionedAxes::posReset(int64_t axis) { units_.release(axes_[index(axis)], static_cast<uint32_t>(axis)); }

// ---- reports -------------------------------------------------------------------------------------------------------

void PositionedAxes::note(Masks& masks, Obstacle obstacle, uint32_t number) noexcept {
  masks[static_cast<size_t>(obstacle)].fetch_or(bitOf(number - 1), std::memory_order_relaxed);
}

void PositionedAxes::forget(uint32_t number) noexcept {
  const auto others = static_cast<AxisMask>(~bitOf(number - 1));
  for (Masks* masks : {&refused_, &lost_})
    for (std::atomic<AxisMask>& mask : *masks) mask.fetch_and(others, std::memory_order_relaxed);
}

void PositionedAxes::reportNew(const Masks& masks, std::array<AxisMask, kObstacles>& reported, std::string_view what,
                               std::vector<std::string>& lines) {
  constexpr std::string_view kReasons[] = {
      "",                          // None
      "the axis has no reference", // NotHomed
      "its drive is not enabled",  // NotEnabled
      "its drive has a fault",     // Fault
      "its following error exceeds FollowingErrorLimit",
      "its position loop is open (VAZBA_x)",
      "the axis is a spindle",
      "all six units have an axis", // l.12040
  };
  static_assert(std::size(kReasons) == kObstacles);
  for (size_t reason = 0; reason < kObstacles; ++reason) {
    const AxisMask all = masks[reason].load(std::memory_order_relaxed);
    const int fresh = all & ~std::exchange(reported[reason], all);
    for (uint32_t i = 0; i < kMaxAxes; ++i)
      if ((fresh >> i & 1) != 0)
        lines.push_back("axis " + std::to_string(i + 1) + ": " + std::string(what) + std::string(kReasons[reason]));
  }
}

void PositionedAxes::report(std::vector<std::string>& lines) {
  reportNew(refused_, refusedReported_, "POS_INIT is refused: ", lines);
  reportNew(lost_, lostReported_, "the positioning unit has lost the axis: ", lines);
}

} // namespace rung::io
