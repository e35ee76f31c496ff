// FANUC's CNC among the simulated ones of the PMC family (sim/pmc). What no source says is recalled; the page of the
// simulation (docs/dialects/simulated-nc-fanuc.md) lists it.
#include "rtlib/nc/fanuc/model.h"
#include "rtlib/nc/fanuc/window_functions.h"
#include "sim/fanuc/window.h"
#include "sim/pmc/machine.h"
#include "sim/pmc/simulated_pmc.h"

namespace rung::sim {
namespace {

using namespace pmc;

constexpr ParameterBit kHandle = {8131, 0}; // HPG: there are hand wheels

constexpr Parameters kParameters = {
    .guard = {3004, 0},                // BSL
    .highSpeed = {3001, 7},            // MHI
    .manyM = {3404, 7},                // M3B
    .cancelExternal = {},              // never
    .switches = {.otherwise = true},   // always
    .gearsOfT = {3706, 4},             // GTT
    .noInterlock = {3003, 0},          // ITL
    .noAxisInterlock = {3003, 2},      // ITX
    .noDirectionInterlock = {3003, 3}, // DIT
    .dryRun = 1410,
    .rapid = 1420,
    .rapidF0 = 1421,
    .manualReturn = 1428,
    .safeFeed = 0,
    .jog = 1423,
    .reference2 = 1241, // then 1242, 1243
    .switchAxis = 6910, // to 6925
    .switchHigh = 6930, // to 6945
    .switchLow = 6950,  // to 6965
    .gearSpeed = 3732,  // for SOR
    .maxSpindle = 3772,
    .gearMax = 3741,    // to 3744, T type
    .gearSwitch = 3741, // and 3742, M type
    .plcGroup = 8010,
    .plcMaxSpeed = 1430,
};
constexpr ParameterDefault kDefaults[] = {{1410, 3000},  {1420, 12000}, {1421, 600},  {1423, 2000}, {1428, 6000},
                                          {1430, 12000}, {3732, 50},    {3772, 6000}, {8131, 1}};

// G43: MD1, MD2, MD4; DNCI and ZRN. Teach-in has no mode here.
Mode modeOf(const nc::pmc::SignalsIo& io, const Tables& tables) {
  switch (io.gByte(43) & 7) {
  case 0: return Mode::Mdi;
  case 1: return io.g(43, 5) ? Mode::Dnc : Mode::Auto;
  case 3: return Mode::Edit;
  case 4: return tables.parameterBit(kHandle) ? Mode::Handle : Mode::Step;
  case 5: return io.g(43, 7) ? Mode::Zero : Mode::Jog;
  default: return Mode::None;
  }
}

void confirm(const nc::pmc::SignalsIo& io, Mode mode) {
  constexpr Mode kBits[] = {Mode::Step, Mode::Handle, Mode::Jog, Mode::Mdi, Mode::Dnc, Mode::Auto, Mode::Edit}; // F3
  uint8_t bits = 0;
  for (uint32_t i = 0; i < std::size(kBits); ++i) bits = static_cast<uint8_t>(bits | (kBits[i] == mode ? 1 << i : 0));
  io.setFByte(3, bits);
  io.setF(4, 5, mode == Mode::Zero); // MREF
}

// In position, servo ready, commanded speed of the first spindle in 12 bits.
void writeOwn(const nc::pmc::SignalsIo& io, const Machine& machine) {
  uint8_t inPosition = 0, ready = 0;
  for (uint32_t i = 0; i < machine.axes.count(); ++i) {
    inPosition = static_cast<uint8_t>(inPosition | (machine.axes[i].moving ? 0 : 1 << i));
    ready = static_cast<uint8_t>(ready | (io.g(8, 4) ? 1 << i : 0));
  }
  io.setFByte(104, inPosition);
  io.setFByte(186, ready);
  constexpr double kSteps = 4095;
  const double most = machine.tables.parameterReal(kParameters.maxSpindle);
  const double share = most > 0 ? std::min(1.0, machine.spindle.commanded() / most) : 0;
  io.setFWord(36, static_cast<uint16_t>(share * kSteps));
}

// A serial spindle turns while it is ready (MRDY, *ESP), in the direction of SFR or SRV; with SIND and SSIN in that of
// SGN. *SSTP stops the first one, the second one has its speed from the program (SIND2).
SpindleOrder spindle(const nc::pmc::SignalsIo& io, uint32_t number) {
  const uint32_t byte = number == 0 ? 70 : 74;
  const bool forward = io.g(byte, 5), reverse = io.g(byte, 4);
  const bool turns = io.g(byte, 7) && io.g(byte + 1, 1) && forward != reverse;
  if (number != 0) return {turns && io.g(35, 7), reverse};
  return {turns && io.g(29, 6), io.g(33, 7) && io.g(33, 6) ? io.g(33, 5) : reverse};
}

const Cnc& fanucCnc() {
  static const Cnc made{
      .model = &nc::fanuc::model(),
      .configKeys = &nc::fanucConfigKeys,
      .exampleParameter = "param.8010",
      .parameters = kParameters,
      .defaults = kDefaults,
      .alarms =
          {.plcAxis = 130, .noFeed = 11, .notReferenced = 224, .overTravelPositive = 506, .overTravelNegative = 507},
      .modeOf = &modeOf,
      .confirm = &confirm,
      .writeOwn = &writeOwn,
      .spindle = &spindle,
      .mostM = 5,
      .stopsByM0 = false,
      .resetsByRewind = true,
      .positionsSpindle = false,
      .cancelsOverride = true,
      .tenthOfStep = false,
      .secondWheel = 19,
      .switchCount = 16,
      .gears = 3,
      .spindleSteps = 4095,
      .inputs = {.bits = {54, 55, 276, 277}, .fields = {56, 280, 284}, .fieldCount = 3},
      .outputs = {.bits = {54, 55, 276, 277}, .fields = {56, 280, 284}, .fieldCount = 3},
      .externalBytes = 2,
      .externalAddress = 2,
      .externalUnits = 10,
      .externalMdi = {},
      .axisUnits = 10,
      .perTurnSteps = 100,
      .axisSkip = {4, 7},
      .rapidByFeed = false,
      .rapidOfParameter = true,
      .windowsOfPath = nc::fanuc::kWindowsOfPath,
      .windowFunctions = &nc::fanuc::windowFunctions,
      .answer = &fanuc::answerWindow,
  };
  return made;
}

} // namespace

std::unique_ptr<SimulatedNc> makeSimulatedFanuc() { return makeSimulatedPmc(fanucCnc()); }

} // namespace rung::sim
