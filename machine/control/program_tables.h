// The tables of the running program, so that a client can compare it with another one.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/plc_access.h"
#include "machine/control/server.h"
#include "rung/runtime.hpp"

namespace rung::control {

// Service thread.
class ProgramTables {
public:
  // `image`: of the program that the host started with.
  ProgramTables(PlcAccess& plc, const Image& image);

  // A replacement, which keeps the tables of its program, is about to take over.
  void learn(const rung_program& program, uint32_t number) { programs_[number] = &program; }
  // It has taken over from the program `former`: other programs will not run again.
  void forgetOthers(uint32_t number, uint32_t former);

  // "mill, code 00112233AABBCCDD", of the running program.
  std::string text() const;
  // Requests of docs/control-protocol.md; they throw Refused.
  nlohmann::json program(const Peer& peer, const nlohmann::json& request);
  nlohmann::json rungs(const Peer& peer, const nlohmann::json& request);

private:
  const rung_program& running() const;

  PlcAccess& plc_;
  std::map<uint32_t, const rung_program*> programs_; // by number (rung_instance_program)
};

} // namespace rung::control
