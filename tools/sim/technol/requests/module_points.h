// The cells of modules at which simulated devices work (module_cells.h): process data of EtherCAT slaves, words of
// servos with EtherCAT drives, positions of axes.
#pragma once
#include "tools/sim/technol/devices/axis_cells.h"
#include "tools/sim/technol/devices/ethercat_image.h"
#include "tools/sim/technol/devices/ethercat_servo.h"
#include "tools/sim/technol/module_cells.h"

namespace rung::sim::technol {

// mm, in the space of the point.
double positionAt(const ModulePoint& point, const AxisOutputs& axes);

// Before the ticks of a scan: outputs of the net. A servo is connected whose status word and control word are ends of
// connections; then its status and its error are what has come there.
void takeOutputs(const ModuleCells& cells, EthercatImage& image, EthercatServos::Cells& servos);
// After them: inputs of the net, control words, positions of axes 1 to `axisCount`.
void giveInputs(ModuleCells& cells, const EthercatImage& image, const EthercatServos::Cells& servos,
                const AxisOutputs& axes, uint32_t axisCount);

} // namespace rung::sim::technol
