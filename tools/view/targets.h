// Where jumps and calls lead: the rungs that begin a subprogram or carry a label, and those that ask for it.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/table/instruction.h"

namespace rung::view {

// What an operand of a box says of a place in the program.
enum class TargetRole : uint8_t { None, Defines, Asks };
TargetRole roleOf(const frontend::InstructionInfo& row, const frontend::OperandInfo& operand);

class Targets {
public:
  struct Target {
    uint32_t rung = 0; // its number; 0: no rung is known
    std::vector<uint32_t> callers;
  };

  // The same for all spellings of a number: "L007" and "L7"; `module` is empty where numbers hold in the whole program.
  uint32_t idOf(std::string_view module, std::string_view operand);
  void define(uint32_t id, uint32_t rung) { targets_[id].rung = rung; }
  void ask(uint32_t id, uint32_t rung);
  const Target& at(uint32_t id) const { return targets_[id]; }

private:
  std::map<std::string, uint32_t, std::less<>> ids_;
  std::vector<Target> targets_;
};

} // namespace rung::view
