// The numbers in a unit's code that say where the unit is in its program: of chunks that it goes to, of rungs and
// lines that it names to the host. A rung that is inserted above changes these and nothing else. So the code has
// symbols for them, whose values the linker puts in, and the same object serves wherever the unit is. Free of LLVM.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "codegen/llvm/module_part.h"
#include "ir/shape/partition.h"

namespace rung::codegen {

class CodeUnitNumbers {
public:
  enum class Kind : uint8_t { Chunk, Rung, Line };

  CodeUnitNumbers(const ir::Partition& partition, const ModulePart& unit);

  // Which of the values it is; the unit's code has it.
  uint32_t index(Kind kind, uint32_t number) const { return indices_.at({kind, number}); }
  std::span<const uint32_t> values() const { return values_; }

  // Whether an operation reports its rung to the host.
  static bool namesRung(ir::OpCode code);
  // The symbol of a value.
  static std::string name(uint32_t index);

private:
  void addRung(const ir::Rung& rung, uint32_t number);
  void addExit(const ir::Exit& exit);
  void add(Kind kind, uint32_t number);

  std::map<std::pair<Kind, uint32_t>, uint32_t> indices_;
  std::vector<uint32_t> values_; // in the order in which the unit first has them
};

} // namespace rung::codegen
