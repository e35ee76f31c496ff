// The cells of modules at which simulated devices work (module_cells.h): process data of EtherCAT slaves, servos with
// EtherCAT drives, positions and increments of axes.
#pragma once
#include <optional>

#include "sim/technol/devices/axis_cells.h"
#include "sim/technol/devices/ethercat_image.h"
#include "sim/technol/devices/ethercat_servo.h"
#include "sim/technol/module_cells.h"

namespace rung::sim::technol {

// What axes 1 to `axisCount` and servos with a drive give at a point, as the bits of its type. Nothing: they do not
// give it.
std::optional<uint64_t> givenAt(const ModulePoint& point, const AxisOutputs& axes, uint32_t axisCount,
                                const EthercatServos::Cells& servos);

// Before the ticks of a scan: outputs of the net. A servo is connected whose status word and control word are ends of
// connections; then its status, its error and its position are what has come there.
void takeOutputs(const ModuleCells& cells, EthercatImage& image, EthercatServos::Cells& servos);
// After them: inputs of the net, and what axes and servos give.
void giveInputs(ModuleCells& cells, const EthercatImage& image, const EthercatServos::Cells& servos,
                const AxisOutputs& axes, uint32_t axisCount);

} // namespace rung::sim::technol
