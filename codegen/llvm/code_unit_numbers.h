// The numbers in a unit's code that depend on its position in the program: chunks to which it continues, rungs and
// lines that it reports to the host. Inserting a rung above changes only these. The code therefore refers to them by
// symbols whose values the linker supplies, and the same object serves at any position. Does not include LLVM.
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

  // Index of a number in values(); the unit's code must use it.
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
  std::vector<uint32_t> values_; // in the order of first use
};

} // namespace rung::codegen
