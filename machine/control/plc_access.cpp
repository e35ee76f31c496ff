// See plc_access.h.
#include "machine/control/plc_access.h"

#include "machine/control/values.h"

namespace rung::control {

LogEntry::Person personOf(const Peer& peer) { return {.name = peer.name, .user = peer.user, .process = peer.process}; }

rung_program_info PlcAccess::program() const {
  auto info = sized<rung_program_info>();
  check(rung_instance_program(instance(), &info));
  return info;
}

host::Command PlcAccess::post(host::Command command, std::chrono::milliseconds time) {
  const host::CommandResult result = host_.post(command, time);
  if (!result.ok()) throw Refused(result.problem);
  return command;
}

std::optional<rung_state> PlcAccess::state() {
  host::Command look{.kind = host::Command::Kind::State};
  return host_.post(look).ok() ? std::optional(look.state) : std::nullopt;
}

std::vector<rung_force_info> PlcAccess::activeForces() {
  std::vector<rung_force_info> list;
  for (uint32_t i = 0; i < kMostForces; ++i) {
    host::Command look{.kind = host::Command::Kind::Forced, .index = i};
    const host::CommandResult result = host_.post(look);
    if (!result.ok()) throw Refused(result.problem);
    if (result.status == RUNG_EMPTY) break;
    list.push_back(look.force);
  }
  return list;
}

void PlcAccess::logChange(const Peer& peer, LogKind kind, const std::string& text) {
  log_.always({.kind = kind, .text = text, .by = personOf(peer)});
}

} // namespace rung::control
