// The GSK25i among the simulated CNCs of the PMC family (sim/pmc).
#include "rtlib/nc/gsk/model.h"
#include "rtlib/nc/gsk/window_functions.h"
#include "sim/gsk/window.h"
#include "sim/pmc/simulated_pmc.h"

namespace rung::sim {
namespace {

using namespace pmc;

// Parameters that the manual names by number.
constexpr Parameters kParameters = {
    .guard = {2402, 0},          // RLK l.3716
    .highSpeed = {2402, 7},      // l.6045
    .manyM = {1803, 6},          // l.5980
    .cancelExternal = {1971, 7}, // ESCAN l.7537
    .switches = {2401, 3},       // SWI
    .gearsOfT = {5001, 6},       // GTT l.6373
    .noInterlock = {},
    .noAxisInterlock = {.otherwise = true},
    .noDirectionInterlock = {},
    .dryRun = 1210,       // l.5339
    .rapid = 1225,        // l.5585
    .rapidF0 = 1231,      // l.5591
    .manualReturn = 1235, // l.5018
    .safeFeed = 1260,     // l.5727
    .jog = 0,             // the manual names none
    .reference2 = 1051,   // then 1052, 1053, l.5109
    .switchAxis = 2500,   // to 2531, l.4226
    .switchHigh = 2532,   // to 2563
    .switchLow = 2564,    // to 2595
    .gearSpeed = 5110,    // l.6406
    .maxSpindle = 5115,   // l.7393
    .gearMax = 5120,      // to 5123, l.6436
    .gearSwitch = 5130,   // to 5132, l.6388
    .plcGroup = 7010,     // l.8260
    .plcMaxSpeed = 7122,  // l.8277
};
constexpr ParameterDefault kDefaults[] = {{1210, 3000}, {1225, 12000}, {1231, 600},  {1235, 6000},
                                          {1260, 3000}, {5110, 50},    {5115, 6000}, {7122, 12000}};

// G43 (l.3755-3765).
Mode modeOf(const nc::pmc::SignalsIo& io, const Tables&) {
  switch (io.gByte(43) & 0x17) { // INC, MD3, MD2, MD1
  case 0x00: return Mode::Mdi;
  case 0x01: return Mode::Auto;
  case 0x02: return Mode::Edit;
  case 0x03: return Mode::Handle;
  case 0x04: return Mode::Jog;
  case 0x05: return Mode::Zero;
  case 0x06: return Mode::Dnc;
  case 0x14: return Mode::Step;
  default: return Mode::None;
  }
}

void confirm(const nc::pmc::SignalsIo& io, Mode mode) {
  constexpr Mode kBits[] = {Mode::Step, Mode::Handle, Mode::Jog,  Mode::Mdi,
                            Mode::Dnc,  Mode::Auto,   Mode::Edit, Mode::Zero}; // F3 l.3783
  uint8_t bits = 0;
  for (uint32_t i = 0; i < 8; ++i) bits = static_cast<uint8_t>(bits | (kBits[i] == mode ? 1 << i : 0));
  io.setFByte(3, bits);
}

// l.7423: no load is modelled.
void writeOwn(const nc::pmc::SignalsIo& io, const Machine& machine) {
  const bool turns = machine.spindle.actual() != 0;
  io.setFByte(68, io.g(16, 0) && turns ? uint8_t{20} : uint8_t{0});
}

// *SSTP (l.6272) and SGN (l.6294); SSND2 and SGN2.
SpindleOrder spindle(const nc::pmc::SignalsIo& io, uint32_t number) {
  return number == 0 ? SpindleOrder{io.g(29, 6), io.g(33, 5)} : SpindleOrder{io.g(35, 7), io.g(35, 5)};
}

const Cnc& gskCnc() {
  static const Cnc made{
      .model = &nc::gsk::model(),
      .configKeys = &nc::gskConfigKeys,
      .exampleParameter = "param.7010",
      .parameters = kParameters,
      .defaults = kDefaults,
      // The manual has no list of alarms; those from 900 on are the model's own.
      .alarms = {.plcAxis = 311, // l.7817
                 .noFeed = 901,
                 .notReferenced = 902, // l.7787
                 .overTravelPositive = 910,
                 .overTravelNegative = 920,
                 .overTravelOfAxis = true},
      .modeOf = &modeOf,
      .confirm = &confirm,
      .writeOwn = &writeOwn,
      .spindle = &spindle,
      .mostM = 3,
      .stopsByM0 = true,
      .resetsByRewind = false,
      .positionsSpindle = true,
      .cancelsOverride = false,
      .tenthOfStep = true,
      .secondWheel = 87, // l.4632
      .switchCount = 32,
      .gears = 4,
      .spindleSteps = 4096, // l.7393
      .inputs = {.bits = {54, 55, 56, 57}, .fields = {54, 226, 230, 234}, .fieldCount = 4},
      .outputs = {.bits = {54, 55, 56, 57}, .fields = {54, 226, 230, 234}, .fieldCount = 4},
      .externalBytes = 4,
      .externalAddress = 13,
      .externalUnits = 1,
      .externalMdi = {85, 0},
      .axisUnits = 1, // 0.1 um (P54)
      .perTurnSteps = 10000,
      .axisSkip = {13, 6}, // l.8186
      .rapidByFeed = true, // l.8156
      .rapidOfParameter = false,
      .windowsOfPath = 0,
      .windowFunctions = &nc::gsk::windowFunctions,
      .answer = &gsk::answerWindow,
  };
  return made;
}

} // namespace

std::unique_ptr<SimulatedNc> makeSimulatedGsk() { return makeSimulatedPmc(gskCnc()); }

} // namespace rung::sim
