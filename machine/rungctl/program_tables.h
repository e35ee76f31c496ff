// The tables by which two programs are compared: of the program that a host runs, and of one in a file.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/control/client.h"
#include "rtlib/load/program_parts.h"
#include "rung/runtime.hpp"

namespace rung::rungctl {

using control::Client;

struct ProgramTables {
  struct Rung {
    uint32_t number = 0; // as drawn, from 1; 0: not drawn
    std::string routine;
    uint64_t text = 0; // equal for equal texts
    std::string title;
    std::string file;
    uint32_t line = 0;
  };
  std::string name;
  std::string dialect;
  std::string compiler; // its version
  uint64_t code = 0;    // equal: the same program
  bool instrumented = false;
  std::vector<std::string> files;
  runtime::ProgramParts parts;
  std::vector<Rung> rungs; // empty until `addRungs`
};

// Of the program that the host runs. Throws std::runtime_error.
ProgramTables tablesOf(Client& client);
// Adds its rungs. Throws std::runtime_error, also if another program has taken over.
void addRungs(Client& client, ProgramTables& tables);
ProgramTables tablesOf(const rung_program& program);

struct ProgramDifference {
  nlohmann::json rungs = nlohmann::json::array(); // as in the answer to `reload`
  std::vector<const runtime::ProgramPart*> parts;
  bool none() const { return rungs.empty() && parts.empty(); }
};
// The changes from the first program to the second.
ProgramDifference difference(const ProgramTables& before, const ProgramTables& after);

} // namespace rung::rungctl
