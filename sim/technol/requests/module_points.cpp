// Devices at the cells of modules (see module_points.h).
#include "sim/technol/requests/module_points.h"

#include <bit>
#include <cmath>

namespace rung::sim::technol {

using Kind = ModulePoint::Kind;

namespace {

// What has come to the elements of a servo, in the order of ServoPart.
struct ServoInputs {
  uint32_t present = 0; // a bit each
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
  uint32_t controlled = 0; // a bit a servo
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

// mm/min of the first three axes, which are the geometric ones.
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

// What a servo gives has the width of its cell; its measures are 32 bits.
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

} // namespace rung::sim::technol
