// Devices at the cells of modules (see module_points.h).
#include "tools/sim/technol/requests/module_points.h"

#include <bit>

namespace rung::sim::technol {

using Kind = ModulePoint::Kind;

namespace {

// What has come to the words of a servo, in the order of ServoPart.
struct ServoWords {
  uint8_t present = 0; // a bit each
  std::array<uint16_t, 3> words = {};

  bool isConnected() const { return (present & 1u << kServoStatus) != 0 && (present & 1u << kServoControl) != 0; }
  bool hasError() const { return (present & 1u << kServoError) != 0; }
};

void takeServos(const ModuleCells& cells, EthercatServos::Cells& servos) {
  std::array<ServoWords, EthercatServos::kCount> found;
  for (const ModuleCells::PointCell& at : cells.points()) {
    if (at.point.kind != Kind::Servo) continue;
    ServoWords& servo = found[at.point.number];
    servo.present |= static_cast<uint8_t>(1u << at.point.part);
    servo.words[at.point.part] = static_cast<uint16_t>(cells.at(at.cell).bits);
  }
  for (uint32_t i = 0; i < servos.size(); ++i) {
    servos[i].isConnected = found[i].isConnected();
    if (!servos[i].isConnected || servos[i].isSimulated) continue;
    servos[i].status = found[i].words[kServoStatus];
    if (found[i].hasError()) servos[i].error = found[i].words[kServoError];
  }
}

} // namespace

double positionAt(const ModulePoint& point, const AxisOutputs& axes) {
  constexpr uint32_t kSpaceWithShift = 6;
  const double shift = axes.shiftMm[point.number];
  if (point.kind == Kind::Shift) return shift;
  return axes.position[point.number] + (point.part == kSpaceWithShift ? shift : 0);
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
    const uint32_t number = at.point.number;
    switch (at.point.kind) {
    case Kind::ProcessData:
      if (image[number].isInput) bits = image.read(number);
      break;
    case Kind::Position:
    case Kind::Shift:
      if (number < axisCount) bits = std::bit_cast<uint64_t>(positionAt(at.point, axes));
      break;
    case Kind::Servo:
      if (at.point.part == kServoControl && servos[number].isConnected) bits = servos[number].control;
      break;
    case Kind::Key:
    case Kind::None: break;
    }
  }
}

} // namespace rung::sim::technol
