// Hooks of a TECHNOL program's schedule (see technol_control.h).
#include "rtlib/nc/control/technol/technol_control.h"

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::nc {

void TechnolControl::prepare(host::Instance& instance, PowerOn kind) {
  Control::prepare(instance, kind);
  messages_.clear();
  blocks_.reset(instance);
  functions_.locate(instance);
  backup_.powerOn(instance);
}

void TechnolControl::onHook(host::Instance& instance, uint32_t work) {
  if (work == kHookAfterInput) blocks_.supervise(instance);
  if (work == kHookAfterMain) backup_.afterMain(instance);
}

void TechnolControl::onFault(host::Instance& instance) { technol::runWith(instance, "HALT", 0, false); }

void TechnolControl::afterSlice(host::Instance& instance) {
  if (instance.atListStart()) life_.afterScan(instance);
}

size_t TechnolControl::describe(const rung_program&, const rung_message& message, std::span<char> out) const noexcept {
  return messages_.describe(message, out);
}

std::optional<host::Ref> TechnolControl::signal(const host::Instance& instance, std::string_view name) const {
  return technol::signalPlace(instance, name);
}

} // namespace rung::nc
