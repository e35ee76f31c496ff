// Alarms of the simulated CNC, by number (Cnc::alarms).
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rtlib/nc/control/pmc/signals_io.h"
#include "sim/pmc/tables.h"

namespace rung::sim::pmc {

class Alarms {
public:
  Alarms() { active_.reserve(32); } // room for all alarms of the CNC itself
  void raise(uint32_t number) {
    if (std::ranges::find(active_, number) == active_.end()) active_.push_back(number);
  }
  void clear() { active_.clear(); }
  bool any() const { return !active_.empty(); }
  std::span<const uint32_t> active() const { return active_; }
  uint32_t last() const { return active_.empty() ? 0 : active_.back(); }

  template <class Archive>
  void state(Archive& archive) {
    archive(active_);
  }

private:
  std::vector<uint32_t> active_;
};

// The axes of the simulated CNC: positions in 0.0001 mm (or degrees), reference points, travel limits and the signals
// of motion. Code that moves an axis calls `move`; `beginSlot` and `writeSignals` bracket a slot.

// Distance in units that a speed in mm/min covers in one slot.
constexpr double unitsPerSlot(double mmPerMin) { return mmPerMin * kUnitsPerMm * kSlotMs / 60000.0; }

struct Axis {
  int64_t machine = 0;
  int64_t commanded = 0; // continues while the machine is locked (l.5305)
  int64_t relative = 0;
  double rest = 0;       // fraction of a unit left over from the current motion
  bool moving = false;   // a command is being executed, even while interlock holds the axis (l.4127)
  bool negative = false; // direction of the last motion (l.4164)
  bool referenced = false;
  bool blockedPositive = false; // over-travel, until reset (l.3613)
  bool blockedNegative = false;
  std::array<bool, 4> atReference = {}; // the axis has returned there and not left since

  template <class Archive>
  void state(Archive& archive) {
    archive(machine, commanded, relative, rest, moving, negative, referenced, blockedPositive, blockedNegative,
            atReference);
  }
};

class Axes {
public:
  // The table of the CNC outlives it.
  explicit Axes(const Cnc& cnc) : cnc_(&cnc) {}

  // Names in order, "XYZ"; their count is the number of axes.
  std::string names = "XYZ";
  // Whether *+L, *-L (G114, G116) are wired.
  bool limitSwitches = false;

  uint32_t count() const { return static_cast<uint32_t>(names.size()); }
  Axis& operator[](uint32_t axis) { return axes_[axis]; }
  const Axis& operator[](uint32_t axis) const { return axes_[axis]; }

  void beginSlot(const nc::pmc::SignalsIo& io, const Tables& tables, Alarms& alarms);
  void writeSignals(const nc::pmc::SignalsIo& io, const Tables& tables, bool rapid) const;

  // Moves by `delta`; the machine does not move under machine lock.
  void move(uint32_t axis, int64_t delta);
  // Moves towards `target` (in terms of `commanded`) by at most `units`; returns true on arrival.
  bool moveTowards(uint32_t axis, int64_t target, double units);
  void startMotion(uint32_t axis, bool negative);
  bool mayMove(uint32_t axis, bool negative) const;
  void place(uint32_t axis, int64_t machine);
  // The machine coordinate of reference point 1-4 (l.5109); the first is the origin.
  static int64_t reference(const Tables& tables, uint32_t axis, uint32_t point);
  void arriveAtReference(uint32_t axis, uint32_t point);
  void clearOverTravel();

  template <class Archive>
  void state(Archive& archive) {
    archive(axes_, locked_, interlocked_, noPositive_, noNegative_);
  }

private:
  uint32_t switches(const Tables& tables) const;
  void raiseOverTravel(Alarms& alarms, uint32_t number, uint32_t axis) const;

  const Cnc* cnc_;
  std::array<Axis, kAxes> axes_;
  bool locked_ = false;
  uint8_t interlocked_ = 0; // bit n-1: axis n
  uint8_t noPositive_ = 0;
  uint8_t noNegative_ = 0;
};

} // namespace rung::sim::pmc
