// Requests and acknowledgements of the axes, and their positions as signals (see axes.h; man. 7.10, 7.13).
#include <cmath>

#include "tools/sim/nct/axes.h"

namespace rung::sim::nct {

// Acknowledgements come only when nothing of the axis is under way: the block buffer is empty.
bool Axes::free(uint32_t axis) const {
  const Axis& state = axes_[axis];
  return state.program.kind == AxisCommand::Kind::None && state.velocity == 0;
}

void Axes::acknowledge(uint32_t axis) {
  Axis& state = axes_[axis];
  if (!free(axis)) return;
  const bool detach = get(signals_.detachRequest, axis);
  if (detach != state.detached) {
    state.detached = detach;
    state.referenced = !detach && absolute_; // l.8450
    set(signals_.detached, axis, detach);
  }
  if (state.detached) return;
  const bool slave = get(signals_.syncSlave, axis);
  set(signals_.open, axis, get(signals_.openRequest, axis) || get(signals_.slaveOpenRequest, axis));
  set(signals_.mirrored, axis, get(signals_.mirrorRequest, axis));
  if (get(signals_.plcOwns, axis) && !get(signals_.plcRequest, axis)) reset(axis);
  set(signals_.plcOwns, axis, get(signals_.plcRequest, axis));
  acknowledge(axis, {signals_.syncRequest, signals_.syncSlave, signals_.syncMaster, parameters_.syncMaster});
  acknowledge(axis,
              {signals_.exchangeRequest, signals_.exchangeSlave, signals_.exchangeMaster, parameters_.exchangeMaster});
  acknowledge(axis, {signals_.superRequest, signals_.superSlave, signals_.superMaster, parameters_.superMaster});
  // Only an axis of a synchronous control can be parked (l.8608).
  const bool coupled = slave || get(signals_.syncMaster, axis);
  set(signals_.parked, axis, coupled && get(signals_.parkRequest, axis));
}

// The slave asks; the parameter names the number of its master, 0: it is no slave (l.8625-8627).
void Axes::acknowledge(uint32_t axis, const Coupling& coupling) {
  const int32_t number = parameter(coupling.masterNumber, axis);
  const bool on = get(coupling.request, axis) && number >= 1 && number <= static_cast<int32_t>(nc::nct::kAxes) &&
                  static_cast<uint32_t>(number) != axis + 1 && exists(static_cast<uint32_t>(number) - 1);
  if (on == get(coupling.slave, axis)) return;
  set(coupling.slave, axis, on);
  if (number < 1 || number > static_cast<int32_t>(nc::nct::kAxes)) return;
  set(coupling.master, static_cast<uint32_t>(number) - 1, on);
}

void Axes::writePositionSignals(uint32_t axis) {
  Axis& state = axes_[axis];
  const double window = real(parameters_.inPosition, axis);
  const double measured = state.locked ? state.lockedAt : measuredPosition(axis);
  const bool there = exists(axis);
  set(signals_.inPosition, axis, there && std::abs(lag(axis)) < window);
  set(signals_.alarm, axis, there && state.alarm);
  const bool byDrive = option(parameters_.referenceType, 3, axis) && option(parameters_.referenceType, 4, axis);
  set(signals_.referenced, axis, there && (byDrive ? get(signals_.driveReference, axis) : state.referenced));
  set(signals_.referenceEnd, axis, there && state.referenceEnd);
  for (uint32_t i = 0; i < 4; ++i)
    set(signals_.atReference[i], axis, there && std::abs(real(parameters_.reference[i], axis) - measured) < window);
  const double distance = real(parameters_.indexDistance, axis);
  const bool indexed = there && option(parameters_.properties, 3, axis) && distance > 0;
  set(signals_.atIndex, axis, indexed && std::abs(std::remainder(measured, distance)) < window);
  set(signals_.overPositive, axis, there && (atStrokeLimit(axis, true) || get(signals_.switchPositive, axis)));
  set(signals_.overNegative, axis, there && (atStrokeLimit(axis, false) || get(signals_.switchNegative, axis)));
  const double way = real(parameters_.lubricationDistance, axis);
  const bool lubricate = there && way > 0 && state.lubrication > way;
  if (lubricate) state.lubrication = 0;
  set(signals_.lubrication, axis, lubricate);
}

bool Axes::atStrokeLimit(uint32_t axis, bool positive) const {
  const double limit = strokeLimit(axis, positive);
  return positive ? axes_[axis].position >= limit : axes_[axis].position <= limit;
}

// Before every PLC cycle (l.7713); a switch exists if its axis does.
void Axes::writeSwitches() {
  const Parameters& parameters = *links().parameters;
  for (uint32_t i = 0; i < switchAxis_.size(); ++i) {
    const int32_t number = parameters.dword(switchAxis_[i]);
    const bool there =
        number >= 1 && number <= static_cast<int32_t>(nc::nct::kAxes) && exists(static_cast<uint32_t>(number) - 1);
    const double position = there ? measuredPosition(static_cast<uint32_t>(number) - 1) : 0;
    const double low = parameters.real(switchLow_[i]);
    const double high = parameters.real(switchHigh_[i]);
    set(signals_.onSwitch, i, there && low < position && position < high);
    set(signals_.belowSwitch, i, there && position < low);
    set(signals_.aboveSwitch, i, there && position > high);
  }
}

} // namespace rung::sim::nct
