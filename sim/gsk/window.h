// The answers of the simulated CNC to window requests (man. §9.3, l.8482-8945), from its tables and axes.
#pragma once
#include "rtlib/nc/gsk/window_functions.h"
#include "sim/gsk/machine.h"
#include "sim/gsk/operation.h"

namespace rung::sim::gsk {

struct WindowRequest {
  bool write = false;
  uint32_t function = 0;
  uint32_t length = 0;
  uint32_t number = 0;
  uint32_t attribute = 0;
  int64_t data = 0;
};

struct WindowAnswer {
  nc::gsk::WindowEnd end = nc::gsk::kWindowDone;
  int64_t data = 0;
};

// Highest numbers of this model's tables, which the manual does not specify.
inline constexpr uint32_t kToolOffsets = 400;
inline constexpr uint32_t kMaxParameter = 9999;
inline constexpr uint32_t kMaxPitch = 1023;

// `locked`: tables are protected; every write ends with code 7.
WindowAnswer answerWindow(const WindowRequest& request, Machine& machine, const nc::gsk::SignalsIo& io,
                          uint32_t sequence, bool locked);

// External data input of the simulated CNC: program search, tool and work offsets, part count, from G0-G3 and G13
// (man. §9.1, l.7474-7564).

class ExternalData {
public:
  void step(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation, bool resetting);
  uint32_t parts() const { return parts_; }
  uint32_t partsPreset() const { return preset_; }

private:
  enum class Phase : uint8_t { Idle, Read, Waiting, Done };
  bool carryOut(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation);

  Phase phase_ = Phase::Idle;
  uint8_t address_ = 0; // EA0-EA6
  uint32_t data_ = 0;   // ED0-ED31
  uint32_t parts_ = 0;
  uint32_t preset_ = 0;
};

} // namespace rung::sim::gsk
