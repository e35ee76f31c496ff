// A decision of a rung (the power into a coil) as a function of its conditions (its contacts), read off the rung's
// operations: and, or, exclusive or, not and select of bits. Every other value is held still. Sixty-three conditions
// are flipped at a time, each in a lane of its own of one 64-bit word, so asking which of them decide costs about as
// much as running the rung.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "ir/core/module.h"

namespace rung::report {

class Expression {
public:
  // `conditions` are values of the rung; those that `root` follows from become its conditions.
  Expression(const ir::Rung& rung, ir::ValueId root, std::span<const ir::ValueId> conditions);

  // Indices into the conditions given, in the order in which their values are computed.
  const std::vector<uint32_t>& conditions() const { return conditions_; }
  // Calls decides(i) for each i in conditions() that alone decides: flipped, it flips the root. `values` are the
  // rung's.
  void findDeciding(std::span<const uint64_t> values, const std::function<void(size_t i)>& decides) const;

private:
  enum class Kind : uint8_t { Condition, Held, And, Or, Xor, Not, Select };
  // Operands are nodes, those of Condition and Held (a) a condition of ours and a value of the rung.
  struct Node {
    Kind kind = Kind::Held;
    uint32_t a = 0;
    uint32_t b = 0;
    uint32_t c = 0;
    uint32_t value = 0; // Condition
  };
  static bool isLogic(const ir::Op& op);
  static Kind kindOf(ir::OpCode code);
  uint64_t evaluate(std::span<const uint64_t> values, size_t first, std::vector<uint64_t>& lanes) const;

  std::vector<uint32_t> conditions_;
  std::vector<Node> nodes_; // operands come first; the last is the root
};

} // namespace rung::report
