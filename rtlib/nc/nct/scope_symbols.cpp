// The list of scope symbols (see scope_symbols.h).
#include "rtlib/nc/nct/scope_symbols.h"

#include <iterator>

#include "rtlib/text/letters.h"

namespace rung::nc::nct {
namespace {

constexpr ScopeParameter kZero = {"0", 0, 0, ScopeLimit::Fixed};
constexpr ScopeParameter kAny = {"not described", INT32_MIN, INT32_MAX, ScopeLimit::Fixed};
constexpr ScopeParameter kWord = {"word", 0, 9999, ScopeLimit::Fixed};
constexpr ScopeParameter kWordPair = {"first word", 0, 9998, ScopeLimit::Fixed};
constexpr ScopeParameter kNcWord = {"word", 0, 1, ScopeLimit::PlcNvram};
constexpr ScopeParameter kNcWordPair = {"first word", 0, 2, ScopeLimit::PlcNvram};
constexpr ScopeParameter kBit = {"bit", 0, 31, ScopeLimit::Fixed};
constexpr ScopeParameter kAxis = {"axis number", 1, 32, ScopeLimit::Fixed};
constexpr ScopeParameter kSpindle = {"spindle number", 1, 16, ScopeLimit::Fixed};
constexpr ScopeParameter kSlaveSpindle = {"number of the slave spindle", 1, 16, ScopeLimit::Fixed};
// Printed as "the slave spindle number" with the limits of an axis (l.3342).
constexpr ScopeParameter kSlaveAxis = {"number of the slave", 1, 32, ScopeLimit::Fixed};
constexpr ScopeParameter kChannel = {"channel number", 1, 8, ScopeLimit::Fixed};
constexpr ScopeParameter kDrive = {"servo drive number", 1, 48, ScopeLimit::Fixed};
constexpr ScopeParameter kDatum = {
    "0 speed [rev/min], 1 current [A], 2 relative current [%], 3 bus voltage [V], 4 temperature [C], 5 power [kW]", 0,
    5, ScopeLimit::Fixed};

constexpr ScopeSymbol kSymbols[] = {
    {"PlcBit", "bit of the PLC memory", kWord, kBit, ScopeSource::PlcBit, 3326},
    {"PlcInt", "word of the PLC memory, signed", kWord, kZero, ScopeSource::PlcInt, 3327},
    {"PlcDouble", "double of the PLC memory", kWordPair, kZero, ScopeSource::PlcDouble, 3328},
    {"DirectPlcBit", "bit of the TimeSlice memory", kNcWord, kBit, ScopeSource::DirectPlcBit, 3329},
    {"DirectPlcInt", "word of the TimeSlice memory, signed", kNcWord, kZero, ScopeSource::DirectPlcInt, 3330},
    {"DirectPlcDouble", "double of the TimeSlice memory", kNcWordPair, kZero, ScopeSource::DirectPlcDouble, 3331},
    {"ComPosAx", "position command to the position loop [mm, degree, inch]", kAxis, kZero, ScopeSource::Nc, 3332},
    {"ComVelAx", "velocity command to the position loop [mm/s, degree/s, inch/s]", kAxis, kZero, ScopeSource::Nc, 3335},
    {"FolErrAx", "following error [mm, degree, inch]", kAxis, kZero, ScopeSource::Nc, 3336},
    {"CommandAx", "command to the servo drive [mm/s, degree/s, inch/s]", kAxis, kZero, ScopeSource::Nc, 3337},
    {"ActPosAx", "actual position from the encoder [mm, degree, inch]", kAxis, kZero, ScopeSource::Nc, 3338},
    {"PosErrAx", "predicted minus measured position [mm, degree, inch]", kAxis, kZero, ScopeSource::Nc, 3339},
    {"TachAx", "speed from the encoder [mm/s, degree/s, inch/s]", kAxis, kZero, ScopeSource::Nc, 3340},
    {"TachRealAx", "pulses from the encoder in a TimeSlice", kAxis, kZero, ScopeSource::Nc, 3341},
    {"EGBvTarAx", "speed of the EGB master axis [mm/s, degree/s, inch/s]", kSlaveAxis, kZero, ScopeSource::Nc, 3342},
    {"EGBcCurrAx", "speed of the EGB slave axis [mm/s, degree/s, inch/s]", kAxis, kZero, ScopeSource::Nc, 3345},
    {"SyncErrAx", "position difference of master and slave, EGB or gantry [mm, degree, inch]", kAxis, kZero,
     ScopeSource::Nc, 3346},
    {"PitchAx", "pitch error compensation now [mm, degree, inch]", kAxis, kZero, ScopeSource::Nc, 3347},
    {"StraightnessAx", "straightness compensation now [mm, degree, inch]", kAxis, kZero, ScopeSource::Nc, 3348},
    {"CompenValAx", "sum of the compensations now [mm, degree, inch]", kAxis, kZero, ScopeSource::Nc, 3349},
    {"ComPosSp", "position command to the position loop, closed loop [rev]", kSpindle, kZero, ScopeSource::Nc, 3350},
    {"ComVelSp", "velocity command to the position loop, closed loop [rev/s]", kSpindle, kZero, ScopeSource::Nc, 3351},
    {"FolErrSp", "following error, closed loop [rev]", kSpindle, kZero, ScopeSource::Nc, 3352},
    {"CommandSp", "command to the drive, closed loop [rev/s]", kSpindle, kZero, ScopeSource::Nc, 3355},
    {"ActPosSp", "actual position [rev]", kSpindle, kZero, ScopeSource::Nc, 3356},
    {"PosErrSp", "predicted minus measured position, closed loop [rev]", kSpindle, kZero, ScopeSource::Nc, 3357},
    {"TachSp", "speed from the encoder [rev/s]", kSpindle, kZero, ScopeSource::Nc, 3358},
    {"NActSp", "speed from the encoder [rev/min]", kSpindle, kZero, ScopeSource::Nc, 3359},
    {"NSetSp", "speed command after override, at the input of the spindle handler [rev/min]", kSpindle, kZero,
     ScopeSource::Nc, 3360},
    {"NCommandSp", "command to the drive, at the output of the spindle handler [rev/min]", kSpindle, kZero,
     ScopeSource::Nc, 3361},
    {"SyncVTargetSp", "speed of the master spindle, synchronised [rev/s]", kSlaveSpindle, kZero, ScopeSource::Nc, 3362},
    {"SyncVSlaveSp", "speed of the slave spindle, synchronised [rev/s]", kSpindle, kZero, ScopeSource::Nc, 3365},
    {"SyncErrSp", "slave minus master position, synchronised [rev]", kSpindle, kZero, ScopeSource::Nc, 3366},
    {"Measured", "for internal use", kAny, kAny, ScopeSource::Nc, 3367},
    {"RealTime", "time of the real-time thread [us]", kZero, kZero, ScopeSource::Nc, 3368},
    {"HardwareTime", "time of the refresh of inputs and outputs [us]", kZero, kZero, ScopeSource::Nc, 3369},
    {"ChannelsTime", "time of channel control [us]", kZero, kZero, ScopeSource::Nc, 3370},
    {"AxesTime", "time of axis control [us]", kZero, kZero, ScopeSource::Nc, 3371},
    {"PlcTime", "time of the module INT0 [us]", kZero, kZero, ScopeSource::Nc, 3372},
    {"PlcCycle", "time of the module MAIN with its interruptions [us]", kZero, kZero, ScopeSource::Nc, 3373},
    {"CANErr", "for internal use", kAny, kAny, ScopeSource::Nc, 3374},
    {"TSliceErr", "for internal use", kAny, kAny, ScopeSource::Nc, 3375},
    {"CNCBufferCount", "records in the buffer", kChannel, kZero, ScopeSource::Nc, 3376},
    {"RotaryAx", "cyclic position of a rotary axis [degree]", kAxis, kZero, ScopeSource::Nc, 3377},
    {"TachRealSp", "pulses from the encoder in a TimeSlice", kSpindle, kZero, ScopeSource::Nc, 3382},
    {"NCTDriveMess", "datum of an NCT servo drive", kDrive, kDatum, ScopeSource::Nc, 3383},
};

} // namespace

std::span<const ScopeSymbol> scopeSymbols() { return kSymbols; }

std::optional<uint32_t> findScopeSymbol(std::string_view name) {
  for (uint32_t i = 0; i < std::size(kSymbols); ++i)
    if (text::equalsIgnoringCase(kSymbols[i].name, name)) return i;
  return std::nullopt;
}

} // namespace rung::nc::nct
