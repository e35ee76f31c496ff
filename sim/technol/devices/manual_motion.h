// Manual motion AUTMAN with its handwheel, and SHIFT (man. chapter 20).
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "sim/technol/devices/manual_panel.h"

namespace rung::sim::technol {

class ManualMotion {
public:
  ManualPanel panel;

  void reset() { *this = ManualMotion(); }
  // It ends; with `locked` it stays off until the program runs again (fault, HALT).
  void lock(bool locked);
  // The axis is taken from it: it brakes.
  void drop(Axis& axis, uint32_t index);
  // A millisecond, before the axes move. `revolutions`: of the main spindle, per minute.
  void drive(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, double revolutions);
  // Its own cells.
  void show(std::span<const Axis> axes, AxisOutputs& out) const;

private:
  struct Ordered {
    AxisMask plus = 0, minus = 0;
    bool rapid = false;
  };
  void activate(const AxisInputs& in, AxisRequests& requests);
  Ordered orders(const AxisInputs& in);
  double speed(const Axis& axis, const AxisInputs& in, double revolutions) const;
  void driveAxis(Axis& axis, uint32_t index, const AxisInputs& in, double perMinute);
  void driveWheel(Axis& axis, uint32_t index, const AxisInputs& in);
  void turnWheel(std::span<const Axis> axes, double steps);
  void watchStop(std::span<const Axis> axes, const AxisInputs& in);
  void driveShift(std::span<Axis> axes, const AxisInputs& in, const AxisRequests& requests, double steps);

  bool on_ = false, active_ = false, locked_ = false;
  bool external_ = false, externalSelecting_ = false;
  Ordered ordered_;
  AxisMask wheels_ = 0; // axes that the handwheel moves
  std::array<double, kMaxAxes> wheelTargets_ = {};
  bool atStop_ = true;
  std::array<double, kMaxAxes> stopPlaces_ = {};
  std::array<double, kMaxAxes> shifts_ = {}; // mm, where they are to go
  AxisMask shifting_ = 0;
  bool shiftWasActive_ = false, shiftActive_ = false;
};

} // namespace rung::sim::technol
