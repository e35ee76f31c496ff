// Analogue outputs and positioning units, and axes that are not there (see axis_service.h).
#include "machine/io/axes/axis_service.h"

#include <utility>

#include "rtlib/nc/control/technol/cells.h"

namespace rung::io {

OutputPlaces::OutputPlaces(const rung_program& program) {
  nc::technol::locateElements(program, "SU_OUT_PLC", outputs_);
}

void OutputPlaces::zero(const core::Memory& memory) const {
  for (const core::Place& place : outputs_) memory.write(place, 0);
}

void AxisService::powerOn() noexcept {
  outputs_.reset();
  spindles_ = 0;
  positioned_.powerOn();
}

bool AxisService::answer(DeviceOrder device, DeviceCall& call, const AxisCells& cells) {
  const auto order = static_cast<AxisOrder>(device.order);
  const uint32_t bit = 1u << static_cast<uint32_t>(order);
  if (outOfRange(device, call.request())) {
    outOfRange_.fetch_or(bit, std::memory_order_relaxed);
    answerNothing(order, call);
    return true;
  }
  if (answerAnalog(*this, order, call)) return true;
  if (const auto axis = positionedAxis(order, call.request()); axis && positioned_.has(*axis))
    return answerPosition(positioned_, cells, order, call);
  refused_.fetch_or(bit, std::memory_order_relaxed);
  return false;
}

void AxisService::fault(const core::Memory& memory, const OutputPlaces& places) noexcept {
  outputs_.zeroOutputs();
  places.zero(memory);
  positioned_.brake();
}

// ---- analogue outputs ----------------------------------------------------------------------------------------------

void AxisService::analogPort(int64_t port) { outputs_.selectPort(static_cast<uint32_t>(port)); }

AnalogOutput AxisService::analogOnSpindle(int64_t value, int64_t axis, int64_t spi) {
  return outputs_.putOnSpindle(value, static_cast<uint32_t>(axis), static_cast<uint32_t>(spi));
}

AnalogOutput AxisService::analogSpi(int64_t value, int64_t axis) {
  return outputs_.putOn(static_cast<uint32_t>(axis), value);
}

AnalogOutput AxisService::axSpi(int64_t axis, SpindleRole role) {
  spindles_ |= 1u << (axis - 1);
  positioned_.becomeSpindle(static_cast<uint32_t>(axis));
  return outputs_.switchTo(static_cast<uint32_t>(axis), role);
}

// What is not a spindle yet becomes one (inventory of the services, 4).
void AxisService::spiMain(int64_t axis) {
  if ((spindles_ >> (axis - 1) & 1) == 0) axSpi(axis, SpindleRole::Keep);
  outputs_.makeMain(static_cast<uint32_t>(axis));
}

// ---- for people ----------------------------------------------------------------------------------------------------

void AxisService::report(std::vector<std::string>& lines) {
  const auto add = [&lines](const std::atomic<uint32_t>& orders, uint32_t& reported, const char* sentence) {
    const uint32_t all = orders.load(std::memory_order_relaxed);
    const uint32_t fresh = all & ~std::exchange(reported, all);
    for (uint32_t i = 0; i < 32; ++i)
      if ((fresh >> i & 1) != 0) lines.push_back(std::string(nameOf(static_cast<AxisOrder>(i))) + sentence);
  };
  add(refused_, refusedReported_,
      positioned_.added() == 0 ? ": this host cannot move axes for the program; the instruction is refused"
                               : ": this host cannot move this axis for the program; the instruction is refused");
  positioned_.report(lines);
  add(outOfRange_, outOfRangeReported_, ": an axis, port or role is out of range; nothing is done");
}

} // namespace rung::io
