// Requests and acknowledgements of the axes, and their positions as signals (see axes.h; man. 7.10, 7.13).
#include <cmath>

#include "sim/nct/axes.h"

namespace rung::sim::nct {

// Acknowledgements come only when nothing of the axis is under way: the block buffer is empty.
bool Axes::free(uint32_t axis) const {
  const Axis& state = axes_[axis];
  return state.program.kind == AxisCommand::Kind::None && state.velocity == 0;
}

void Axes::acknowledge(uint32_t axis) {
  Axis& state = axes_[axis];
  if (!free(axis)) return;
  const SignalMemory& signals = links().signals;
  const uint32_t asked = signals.wordOf(signals_.detachRequest, axis);
  const bool detach = signals_.detachRequest.in(asked);
  if (detach != state.detached) {
    state.detached = detach;
    state.referenced = !detach && absolute_; // l.8450
    set(signals_.detached, axis, detach);
  }
  if (state.detached) return;
  const uint32_t answers = signals.wordOf(signals_.open, axis);
  const bool plcRequest = signals_.plcRequest.in(asked);
  if (signals_.plcOwns.in(answers) && !plcRequest) reset(axis);
  signals.setBits(signals_.open, axis, signals_.acknowledges,
                  signals_.open.as(signals_.openRequest.in(asked) || signals_.slaveOpenRequest.in(asked)) |
                      signals_.mirrored.as(signals_.mirrorRequest.in(asked)) | signals_.plcOwns.as(plcRequest));
  acknowledge(axis, asked, answers,
              {signals_.syncRequest, signals_.syncSlave, signals_.syncMaster, parameters_.syncMaster});
  acknowledge(axis, asked, answers,
              {signals_.exchangeRequest, signals_.exchangeSlave, signals_.exchangeMaster, parameters_.exchangeMaster});
  acknowledge(axis, asked, answers,
              {signals_.superRequest, signals_.superSlave, signals_.superMaster, parameters_.superMaster});
  // Only an axis of a synchronous control can be parked (l.8608).
  const bool coupled = signals_.syncSlave.in(answers) || get(signals_.syncMaster, axis);
  set(signals_.parked, axis, coupled && signals_.parkRequest.in(asked));
}

// The slave asks; the parameter names the number of its master, 0: it is not a slave (l.8625-8627).
void Axes::acknowledge(uint32_t axis, uint32_t asked, uint32_t answers, const Coupling& coupling) {
  const bool asks = coupling.request.in(asked);
  const bool slave = coupling.slave.in(answers);
  if (!asks && !slave) return;
  const int32_t number = parameter(coupling.masterNumber, axis);
  const bool on = asks && number >= 1 && number <= static_cast<int32_t>(nc::nct::kAxes) &&
                  static_cast<uint32_t>(number) != axis + 1 && exists(static_cast<uint32_t>(number) - 1);
  if (on == slave) return;
  set(coupling.slave, axis, on);
  if (number < 1 || number > static_cast<int32_t>(nc::nct::kAxes)) return;
  set(coupling.master, static_cast<uint32_t>(number) - 1, on);
}

void Axes::writePositionSignals(uint32_t axis) {
  const SignalMemory& signals = links().signals;
  if (!exists(axis)) return signals.setBits(signals_.inPosition, axis, signals_.position, 0);
  Axis& state = axes_[axis];
  const uint32_t asked = signals.wordOf(signals_.driveReference, axis);
  const double window = real(parameters_.inPosition, axis);
  const double measured = state.locked ? state.lockedAt : measuredPosition(axis);
  const bool byDrive = option(parameters_.referenceType, 3, axis) && option(parameters_.referenceType, 4, axis);
  const double distance = real(parameters_.indexDistance, axis);
  const bool indexed = option(parameters_.properties, 3, axis) && distance > 0;
  const double way = real(parameters_.lubricationDistance, axis);
  const bool lubricate = way > 0 && state.lubrication > way;
  if (lubricate) state.lubrication = 0;
  uint32_t bits = signals_.inPosition.as(std::abs(lag(axis)) < window) | signals_.alarm.as(state.alarm) |
                  signals_.referenced.as(byDrive ? signals_.driveReference.in(asked) : state.referenced) |
                  signals_.referenceEnd.as(state.referenceEnd) |
                  signals_.atIndex.as(indexed && std::abs(std::remainder(measured, distance)) < window) |
                  signals_.overPositive.as(signals_.switchPositive.in(asked) || atStrokeLimit(axis, true)) |
                  signals_.overNegative.as(signals_.switchNegative.in(asked) || atStrokeLimit(axis, false)) |
                  signals_.lubrication.as(lubricate);
  for (uint32_t i = 0; i < 4; ++i)
    bits |= signals_.atReference[i].as(std::abs(real(parameters_.reference[i], axis) - measured) < window);
  signals.setBits(signals_.inPosition, axis, signals_.position, bits);
}

bool Axes::atStrokeLimit(uint32_t axis, bool positive) const {
  const double limit = strokeLimit(axis, positive);
  return positive ? axes_[axis].position >= limit : axes_[axis].position <= limit;
}

// Before every PLC cycle (l.7713); a switch exists if its axis does.
void Axes::writeSwitches() {
  const SignalMemory& signals = links().signals;
  const Parameters& parameters = *links().parameters;
  for (uint32_t i = 0; i < switchAxis_.size(); ++i) {
    uint32_t bits = 0;
    const bool given = (switches_ >> i & 1) != 0;
    const uint32_t axis = given ? static_cast<uint32_t>(parameters.dword(switchAxis_[i])) - 1 : 0;
    if (given && exists(axis)) {
      const double position = measuredPosition(axis);
      const double low = parameters.real(switchLow_[i]);
      const double high = parameters.real(switchHigh_[i]);
      bits = signals_.onSwitch.as(low < position && position < high) | signals_.belowSwitch.as(position < low) |
             signals_.aboveSwitch.as(position > high);
    }
    signals.setBits(signals_.onSwitch, i, signals_.switches, bits);
  }
}

} // namespace rung::sim::nct
