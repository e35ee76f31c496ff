// See asked_axes.h.
#include "rtlib/nc/control/pmc/asked_axes.h"

#include <iterator>

#include "rtlib/nc/control/control.h"

namespace rung::nc {
namespace {

constexpr uint32_t kReferenced = 120; // F: ZRF1-ZRF8

template <class Act>
void forAxes(uint8_t axes, Act act) {
  for (uint32_t i = 0; i < PmcAxisGroups::kAxes; ++i)
    if ((axes >> i & 1) != 0) act(i);
}

} // namespace

bool PmcAskedAxes::setGroup(uint32_t axis, uint32_t group) {
  if (axis >= PmcAxisGroups::kAxes || group >= model_->axisGroups.size()) return false;
  axes_[axis].group = group;
  served_ = static_cast<uint8_t>(served_ | 1u << group);
  given_ = static_cast<uint8_t>(given_ | 1u << axis);
  return true;
}

void PmcAskedAxes::powerOn() {
  groups_ = PmcAxisGroups(*model_);
  for (Axis& axis : axes_) axis = {.group = axis.group};
  unknown_ = given_;
  lost_ = 0;
}

// When the CNC returns, axes of unknown state are stopped by a request.
void PmcAskedAxes::step(const pmc::SignalsIo& io, core::ServiceQueue& services, bool served) {
  io_ = &io;
  services_ = &services;
  isServed_ = served;
  if (!served) {
    unknown_ = given_;
    for (uint32_t i = 0; i < PmcAxisGroups::kAxes; ++i)
      if (axes_[i].ordered) lost_ = static_cast<uint8_t>(lost_ | 1u << i);
  } else if (unknown_ != 0) {
    stop(unknown_, false);
    unknown_ = lost_ = 0;
  }
  groups_.step(io, *this, served_, !io.g(8, 4));
}

uint32_t PmcAskedAxes::ask(uint32_t axis, int64_t command, int64_t data1, int64_t data2) {
  const int64_t args[] = {axis, command, data1, data2};
  return services_->request(Control::kOwnService, args, std::size(args));
}

// False: the queue of requests is full.
bool PmcAskedAxes::order(uint8_t axes, const PmcAxisGroups::Command& command) {
  bool asked = true;
  forAxes(axes, [&](uint32_t i) {
    axes_[i].motion = ask(i, command.code, command.data1, command.data2);
    axes_[i].ordered = true;
    asked = asked && axes_[i].motion != 0;
  });
  return asked;
}

bool PmcAskedAxes::begin(uint8_t axes, const PmcAxisGroups::Command& command) {
  const bool referenced = (io_->fDword(kReferenced) & axes) == axes;
  if (pmc::isAxisReference(command.code) && !referenced) return false; // l.7787
  return order(axes, command);
}

PmcAxisGroups::Progress PmcAskedAxes::move(uint8_t axes, const PmcAxisGroups::Command& command) {
  using enum PmcAxisGroups::Progress;
  PmcAxisGroups::Progress progress = Over;
  const pmc::AxisCommand* known = pmc::findAxisCommand(model_->axisCommands, command.code);
  const bool endless = known != nullptr && known->buffering == pmc::AxisBuffering::Immediate;
  forAxes(axes, [&](uint32_t i) {
    Axis& axis = axes_[i];
    axis.paused = false;
    const uint32_t state = services_->poll(axis.motion);
    if (state == RUNG_SERVICE_PENDING && progress == Over) progress = UnderWay;
    if (state != RUNG_SERVICE_PENDING && state != RUNG_SERVICE_DONE) progress = Failed;
    const bool begun = endless && state == RUNG_SERVICE_DONE; // an endless motion is answered when it has begun
    axis.ordered = axis.ordered && (state == RUNG_SERVICE_PENDING || begun);
  });
  return progress;
}

// The host itself evaluates ESTP and ESOF to hold the axis.
void PmcAskedAxes::pause(uint8_t axes) {
  forAxes(axes, [&](uint32_t i) { axes_[i].paused = true; });
}

void PmcAskedAxes::stop(uint8_t axes, bool) {
  forAxes(axes, [&](uint32_t i) {
    Axis& axis = axes_[i];
    if ((unknown_ >> i & 1) == 0 && !axis.ordered) return;
    axis = {.group = axis.group, .stop = ask(i, pmc::kAxisStop, 0, 0)};
  });
}

PmcAxisGroups::Motion PmcAskedAxes::look(uint8_t axes) const {
  PmcAxisGroups::Motion motion;
  forAxes(axes, [&](uint32_t i) {
    const Axis& axis = axes_[i];
    const uint32_t status = io_->fDword(model_->axisGroups[axis.group.value_or(0)].status);
    motion.unknown = motion.unknown || !isServed_;
    motion.lost = motion.lost || (lost_ >> i & 1) != 0;
    motion.stopping = motion.stopping || isPending(axis.stop);
    motion.moving = motion.moving || motion.stopping || (isPending(axis.motion) && !axis.paused);
    motion.overPositive = motion.overPositive || (status >> pmc::kEotpBit & 1) != 0;
    motion.overNegative = motion.overNegative || (status >> pmc::kEotnBit & 1) != 0;
  });
  return motion;
}

} // namespace rung::nc
