// A program in its simulated NC (see machine.h).
#include "sim/machine.h"

#include <utility>

#include "rtlib/load/program_info.h"

namespace rung::sim {

rung::Instance Machine::instanceOf(const rung::Image& image, std::unique_ptr<SimulatedNc> nc, Clock clock,
                                   Machine& self) {
  auto options = sized<rung_instance_options>();
  options.flags = clock == Clock::Virtual ? RUNG_SAVE_AT_ONCE : 0;
  options.user = &self;
  options.log = [](void* user, int32_t, const char* text) {
    if (const auto& report = static_cast<Machine*>(user)->report_) report(text);
  };
  rung_instance* instance = nullptr;
  check(api::newInstance(image.handle(), &options, std::move(nc), &instance));
  return rung::Instance(instance);
}

Machine::Machine(const rung_program& program, void* engine, std::unique_ptr<SimulatedNc> nc, Clock clock)
    : nc_(nc.get()), image_(rung::Image::adopt(program, engine)),
      instance_(instanceOf(image_, std::move(nc), clock, *this)), inside_(api::insideOf(*instance_.handle())) {}

void Machine::powerOn(nc::PowerOn kind) {
  instance_.powerOn(kind == nc::PowerOn::Warm ? rung::Power::Warm : rung::Power::Cold);
}

void Machine::idle() {
  inside_.advanceClock(static_cast<int64_t>(runtime::scanPeriodUs(inside_.program())));
  nc_->idle(inside_);
}

// For a dialect with slots, the machine runs in every slot.
void Machine::scan() {
  if (inside_.faulted()) return idle();
  if (!nc_->control().runsInSlots()) return (void)instance_.scan();
  do slot();
  while (!inside_.atListStart() && !inside_.faulted());
}

} // namespace rung::sim
