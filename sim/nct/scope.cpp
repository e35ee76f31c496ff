// SCP (see scope.h).
#include "sim/nct/scope.h"

#include <cmath>
#include <cstdlib>

#include "rtlib/nc/nct/scope_symbols.h"
#include "sim/nct/axes.h"
#include "sim/nct/channels.h"
#include "sim/nct/drives.h"
#include "sim/nct/spindles.h"

namespace rung::sim::nct {
namespace {

using Read = Scope::Read;

double slice(const Links& c) { return static_cast<double>(c.sliceUs) * 1e-6; }

constexpr Read kZero = [](const Links&, uint32_t, uint32_t) -> double { return 0; };

// The axes: commanded positions, and those of the encoder, which follow by the lag.
double axisCommand(const Links& c, uint32_t axis, uint32_t) { return c.axes->machinePosition(axis - 1); }
double axisVelocity(const Links& c, uint32_t axis, uint32_t) { return c.axes->velocity(axis - 1); }
double axisLag(const Links& c, uint32_t axis, uint32_t) { return c.axes->lag(axis - 1); }
double axisMeasured(const Links& c, uint32_t axis, uint32_t) { return c.axes->measuredPosition(axis - 1); }
double axisPulses(const Links& c, uint32_t axis, uint32_t) {
  return c.axes->velocity(axis - 1) * slice(c) * kPulsesPerUnit;
}
double axisTurned(const Links& c, uint32_t axis, uint32_t) {
  const double position = std::fmod(c.axes->machinePosition(axis - 1), 360.0);
  return position < 0 ? position + 360 : position;
}

// The spindles; quantities of a closed loop are 0 without one.
double spindlePosition(const Links& c, uint32_t n, uint32_t) { return c.spindles->position(n - 1); }
double spindleTurns(const Links& c, uint32_t n, uint32_t) { return c.spindles->speed(n - 1) / 60; }
double spindleSpeed(const Links& c, uint32_t n, uint32_t) { return c.spindles->speed(n - 1); }
double spindleSet(const Links& c, uint32_t n, uint32_t) { return c.spindles->set(n - 1); }
double spindleCommand(const Links& c, uint32_t n, uint32_t) { return c.spindles->command(n - 1); }
double closedPosition(const Links& c, uint32_t n, uint32_t) {
  return c.spindles->closed(n - 1) ? c.spindles->position(n - 1) : 0;
}
double closedVelocity(const Links& c, uint32_t n, uint32_t) {
  return c.spindles->closed(n - 1) ? c.spindles->command(n - 1) / 60 : 0;
}
double spindlePulses(const Links& c, uint32_t n, uint32_t) {
  return c.spindles->speed(n - 1) / 60 * slice(c) * kPulsesPerTurn;
}
double masterSpeed(const Links& c, uint32_t n, uint32_t) {
  return c.spindles->synchronised(n - 1) ? c.spindles->speed(c.spindles->master(n - 1)) / 60 : 0;
}
double slaveSpeed(const Links& c, uint32_t n, uint32_t) {
  return c.spindles->synchronised(n - 1) ? c.spindles->speed(n - 1) / 60 : 0;
}
double phaseError(const Links& c, uint32_t n, uint32_t) { return c.spindles->synchronousError(n - 1); }

double blocksAhead(const Links& c, uint32_t channel, uint32_t) { return c.channels->blocksAhead(channel - 1); }

double driveDatum(const Links& c, uint32_t drive, uint32_t datum) { return c.drives->datum(drive, datum); }

// The times of the control's threads are not simulated: constants in microseconds, the same on every machine and
// engine.
template <int32_t Us>
double threadTime(const Links&, uint32_t, uint32_t) {
  return Us;
}

double plcBit(const Links& c, uint32_t word, uint32_t bit) { return c.memory.bit(word, bit) ? 1 : 0; }
double plcInt(const Links& c, uint32_t word, uint32_t) { return c.memory.word(word); }
double plcDouble(const Links& c, uint32_t word, uint32_t) { return c.memory.real(word); }
double directBit(const Links& c, uint32_t word, uint32_t bit) {
  return static_cast<double>((static_cast<uint32_t>(c.signals.word(word)) >> bit) & 1);
}
double directInt(const Links& c, uint32_t word, uint32_t) { return c.signals.word(word); }
double directDouble(const Links& c, uint32_t word, uint32_t) { return c.signals.real(word); }

struct Entry {
  std::string_view name;
  Read read;
};
constexpr Entry kReads[] = {
    {"PlcBit", plcBit},
    {"PlcInt", plcInt},
    {"PlcDouble", plcDouble},
    {"DirectPlcBit", directBit},
    {"DirectPlcInt", directInt},
    {"DirectPlcDouble", directDouble},
    {"ComPosAx", axisCommand},
    {"ComVelAx", axisVelocity},
    {"FolErrAx", axisLag},
    {"CommandAx", axisVelocity},
    {"ActPosAx", axisMeasured},
    {"PosErrAx", kZero}, // the prediction is exact
    {"TachAx", axisVelocity},
    {"TachRealAx", axisPulses},
    {"EGBvTarAx", kZero}, // no electronic gear box
    {"EGBcCurrAx", kZero},
    {"SyncErrAx", kZero}, // slaves follow exactly
    {"PitchAx", kZero},   // no compensation
    {"StraightnessAx", kZero},
    {"CompenValAx", kZero},
    {"ComPosSp", closedPosition},
    {"ComVelSp", closedVelocity},
    {"FolErrSp", kZero}, // a closed loop holds exactly
    {"CommandSp", closedVelocity},
    {"ActPosSp", spindlePosition},
    {"PosErrSp", kZero},
    {"TachSp", spindleTurns},
    {"NActSp", spindleSpeed},
    {"NSetSp", spindleSet},
    {"NCommandSp", spindleCommand},
    {"SyncVTargetSp", masterSpeed},
    {"SyncVSlaveSp", slaveSpeed},
    {"SyncErrSp", phaseError},
    {"Measured", kZero}, // for internal use
    {"RealTime", threadTime<500>},
    {"HardwareTime", threadTime<50>},
    {"ChannelsTime", threadTime<150>},
    {"AxesTime", threadTime<100>},
    {"PlcTime", threadTime<20>},
    {"PlcCycle", threadTime<600>},
    {"CANErr", kZero},
    {"TSliceErr", kZero},
    {"CNCBufferCount", blocksAhead},
    {"RotaryAx", axisTurned},
    {"TachRealSp", spindlePulses},
    {"NCTDriveMess", driveDatum},
};

Read readOf(std::string_view name) {
  for (const Entry& entry : kReads)
    if (entry.name == name) return entry.read;
  return nullptr;
}

} // namespace

Scope::Scope(const Links& links) : links_(links) {
  for (const nc::nct::ScopeSymbol& symbol : nc::nct::scopeSymbols()) {
    reads_.push_back(readOf(symbol.name));
    if (reads_.back() == nullptr) std::abort(); // the row has no quantity
  }
}

std::optional<double> Scope::read(int64_t symbol, int64_t parameter1, int64_t parameter2) const {
  if (symbol < 0 || symbol >= static_cast<int64_t>(reads_.size())) return std::nullopt;
  const nc::nct::ScopeSymbol& row = nc::nct::scopeSymbols()[static_cast<size_t>(symbol)];
  const uint32_t words = links_.memory.plcNvram();
  if (parameter1 < row.param1.min || parameter1 > row.param1.maximum(words)) return std::nullopt;
  if (parameter2 < row.param2.min || parameter2 > row.param2.maximum(words)) return std::nullopt;
  return reads_[static_cast<size_t>(symbol)](links_, static_cast<uint32_t>(parameter1),
                                             static_cast<uint32_t>(parameter2));
}

} // namespace rung::sim::nct
