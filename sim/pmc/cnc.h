// What differs between the simulated CNCs of the PMC family: a table for each dialect (sim/DIALECT). Places of signals
// are those of F and G where nothing else is said; lines (l.) are those of GSK's manual.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "rtlib/core/queues.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/control/pmc/signals_io.h"
#include "rtlib/nc/pmc/model.h"
#include "rtlib/nc/pmc/window_functions.h"

namespace rung::sim::pmc {

inline constexpr uint32_t kAxes = 8;
inline constexpr uint32_t kSlotMs = 8;
inline constexpr double kUnitsPerMm = 10000; // of positions and distances

enum class Mode : uint8_t { None, Mdi, Auto, Edit, Handle, Jog, Zero, Dnc, Step };
inline bool runsPrograms(Mode mode) { return mode == Mode::Mdi || mode == Mode::Auto || mode == Mode::Dnc; }

class Tables;
struct Window;

struct ParameterBit {
  uint32_t number = 0; // 0: the CNC has no such parameter, and `otherwise` holds
  uint8_t bit = 0;
  bool otherwise = false;
};

// Numbers of parameters; 0: the CNC has no such parameter, and it counts as 0.
struct Parameters {
  ParameterBit guard;                                     // *BSL and *CSL are valid
  ParameterBit highSpeed;                                 // M, S, T, B in high-speed mode
  ParameterBit manyM;                                     // several M codes in a block
  ParameterBit cancelExternal;                            // a reset cancels the external data input
  ParameterBit switches;                                  // position switches are valid
  ParameterBit gearsOfT;                                  // gears are selected as in the T type
  ParameterBit noInterlock;                               // *IT is not valid
  ParameterBit noAxisInterlock;                           // *IT of each axis is not valid
  ParameterBit noDirectionInterlock;                      // ±MIT is not valid
  uint32_t dryRun = 0;                                    // mm/min, like the next ones
  uint32_t rapid = 0;                                     // of each axis
  uint32_t rapidF0 = 0;                                   // of each axis
  uint32_t manualReturn = 0;                              // of each axis
  uint32_t safeFeed = 0;                                  // of each axis; limits FVL (G19.6)
  uint32_t jog = 0;                                       // of each axis; 0: from the configuration
  uint32_t reference2 = 0;                                // reference points 2 to 4, of each axis, mm
  uint32_t switchAxis = 0, switchHigh = 0, switchLow = 0; // the first of each
  uint32_t gearSpeed = 0;                                 // for SOR, r/min, like the next ones
  uint32_t maxSpindle = 0;
  uint32_t gearMax = 0;     // the first gear, T type
  uint32_t gearSwitch = 0;  // from the first to the second gear, M type
  uint32_t plcGroup = 0;    // of each axis; an axis without a value has none
  uint32_t plcMaxSpeed = 0; // of each axis, mm/min
};

struct ParameterDefault {
  uint32_t number = 0;
  int64_t value = 0;
};

struct AlarmNumbers {
  uint32_t plcAxis = 0;       // an axis was given to the program, or taken, at the wrong time
  uint32_t noFeed = 0;        // a cutting block without F
  uint32_t notReferenced = 0; // G28, G30 or a command of the program before the return to the reference point
  uint32_t overTravelPositive = 0, overTravelNegative = 0;
  bool overTravelOfAxis = false; // the number of the axis is added to the last two
};

// Macro variables that are signals: bits from 1000 (G) and 1100 (F) on, 32 of them, then fields of 32 bits.
struct InterfaceVariables {
  std::array<uint16_t, 4> bits = {};   // bytes with 8 bits each
  std::array<uint16_t, 4> fields = {}; // their first bytes
  uint32_t fieldCount = 0;
};

// Speed and direction of a spindle, as the program commands them.
struct SpindleOrder {
  bool enabled = false;
  bool negative = false;
};

struct Cnc {
  const nc::pmc::Model* model = nullptr;
  std::span<const nc::ConfigKey> (*configKeys)() = nullptr;
  std::string_view exampleParameter; // "param.7010"
  Parameters parameters;
  std::span<const ParameterDefault> defaults;
  AlarmNumbers alarms;

  Mode (*modeOf)(const nc::pmc::SignalsIo& io, const Tables& tables) = nullptr;
  void (*confirm)(const nc::pmc::SignalsIo& io, Mode mode) = nullptr; // of the mode
  // Signals that only this CNC gives; `axes` is their number.
  void (*writeOwn)(const nc::pmc::SignalsIo& io, const struct Machine& machine) = nullptr;
  SpindleOrder (*spindle)(const nc::pmc::SignalsIo& io, uint32_t spindle) = nullptr; // from 0

  uint32_t mostM = 3;            // M codes of a block
  bool stopsByM0 = false;        // the CNC stops at M0, and at M1 with SOP (G8.2); else the program stops it
  bool resetsByRewind = false;   // RRW (G8.6) resets, as ERS does
  bool positionsSpindle = false; // M18 and M23
  bool cancelsOverride = false;  // OVC (G6.4)
  bool tenthOfStep = false;      // MPSELT (G19.3)
  uint16_t secondWheel = 19;     // byte with the step of the second hand wheel
  uint32_t switchCount = 16;     // position switches, from F70.0 on
  uint32_t gears = 3;            // of the M type
  double spindleSteps = 4095;    // of the 12 bits that are the highest speed
  InterfaceVariables inputs, outputs;

  // External data input.
  uint32_t externalBytes = 2;    // from G0 on
  uint16_t externalAddress = 2;  // byte with EA0-EA6 and the strobe
  int64_t externalUnits = 1;     // units of a step
  nc::pmc::BitPlace externalMdi; // a program search for MDI; byte 0: none

  // PMC axis control.
  int64_t axisUnits = 1;         // units of a step of data 2
  double perTurnSteps = 10000;   // of the feed per revolution in a mm
  nc::pmc::BitPlace axisSkip;    // X
  bool rapidByFeed = false;      // EROV (G150.7): the rapid override is G151
  bool rapidOfParameter = false; // a rapid command without a speed has that of the parameter

  uint32_t windowsOfPath = 0; // codes of window functions of one path; 0: there is a single path
  std::span<const nc::pmc::WindowFunction> (*windowFunctions)() = nullptr;
  // Answers a window request of the program.
  void (*answer)(const core::ServiceRequest& request, const Window& window, core::ServiceReply& reply) = nullptr;
};

} // namespace rung::sim::pmc
