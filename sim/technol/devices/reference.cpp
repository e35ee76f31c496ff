// Reference (see reference.h).
#include "sim/technol/devices/reference.h"

#include <utility>

namespace rung::sim::technol {
namespace {

// Of axes that exist.
void forBits(AxisMask mask, size_t count, auto act) {
  for (uint32_t i = 0; i < count; ++i)
    if (has(mask, i)) act(i);
}

} // namespace

AxisMask Reference::take(ReferenceKind kind) { return std::exchange(ordered_[static_cast<uint32_t>(kind)], {}); }

void Reference::drop(Axis& axis, uint32_t index) { travels_[index].end(axis, axis.attributes.accelerationRT); }

bool Reference::begin(Axis& axis, uint32_t index, AxisRequests& requests, Complaints& complaints) {
  std::string_view reason;
  if (axis.attributes.method() == 1)
    reason = " has RefMethod 1: the PLC references it";
  else if (axis.spindle)
    reason = " is a spindle";
  else if (axis.mover != Mover::None && axis.mover != Mover::Reference)
    reason = " is moved otherwise";
  if (!reason.empty()) {
    complaints.add({"reference", "axis", index + 1, reason});
    return false;
  }
  clearBit(requests.homing, index);
  travels_[index].begin(axis);
  return true;
}

// The system does it, or asks the program to (l.11497, l.11775).
void Reference::takeSingles(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints) {
  AxisMask asked = 0;
  forBits(take(ReferenceKind::Single), axes.size(), [&](uint32_t i) {
    const bool byProgram = axes[i].attributes.method() == 1 || axes[i].attributes.refViaPlc != 0;
    if (byProgram)
      setBit(asked, i);
    else
      begin(axes[i], i, requests, complaints);
  });
  if (asked == 0) return;
  requests.homingSingle = true;
  requests.homingAxes = asked;
}

void Reference::takeOrders(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints) {
  takeSingles(axes, requests, complaints);
  if (const AxisMask mask = take(ReferenceKind::Plc); mask != 0) {
    requests.homingPlc = true;
    requests.homingAxes = mask;
  }
  if (const AxisMask mask = take(ReferenceKind::Group); mask != 0) {
    requests.homingGroup = true;
    requests.homingAxes = mask;
  }
  forBits(take(ReferenceKind::Pseudo), axes.size(), [&](uint32_t i) {
    axes[i].setMeasured(0);
    setBit(requests.homing, i);
    clearBit(requests.nonlinearEnable, i);
    clearBit(requests.softLimits, i);
  });
  forBits(take(ReferenceKind::Simulated), axes.size(), [&](uint32_t i) { setBit(requests.homing, i); });
  forBits(take(ReferenceKind::Clear), axes.size(), [&](uint32_t i) { clearBit(requests.homing, i); });
}

void Reference::takeRequests(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests,
                             Complaints& complaints) {
  forBits(requests.homingReq, axes.size(), [&](uint32_t i) { // l.11779
    const double shift = static_cast<double>(in.refpointDist[i]) / 65536 / 1000;
    axes[i].setMeasured(axes[i].attributes.machineNullPoint + shift);
    clearBit(requests.homingReq, i);
  });
  forBits(requests.homingStartReq, axes.size(), [&](uint32_t i) { // l.11744
    if (!travels_[i].active() && !begin(axes[i], i, requests, complaints)) clearBit(requests.homingStartReq, i);
  });
}

void Reference::stopAll(std::span<Axis> axes, AxisRequests& requests, Stop stop) {
  for (uint32_t i = 0; i < axes.size(); ++i) {
    if (!travels_[i].active()) continue;
    const AxisAttributes& own = axes[i].attributes;
    travels_[i].end(axes[i], stop == Stop::Emergency ? own.accelerationEmergency : own.accelerationRT);
    clearBit(requests.homingStartReq, i);
  }
}

void Reference::drive(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, Stop stop,
                      Complaints& complaints) {
  takeOrders(axes, requests, complaints);
  takeRequests(axes, in, requests, complaints);
  if (stop != Stop::None) stopAll(axes, requests, stop);
  for (uint32_t i = 0; i < axes.size(); ++i) travels_[i].drive(axes[i], i, in);
}

void Reference::look(std::span<Axis> axes, AxisRequests& requests) {
  for (uint32_t i = 0; i < axes.size(); ++i) {
    if (!travels_[i].look(axes[i])) continue;
    setBit(requests.homing, i);
    clearBit(requests.homingStartReq, i);
  }
}

bool Reference::underWay(std::span<const Axis> axes) const {
  for (uint32_t i = 0; i < axes.size(); ++i)
    if (travels_[i].active() && isActualTravel(axes[i].attributes.method())) return true;
  return false;
}

} // namespace rung::sim::technol
