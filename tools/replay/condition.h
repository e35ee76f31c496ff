// Conditions about a program's memory, looked for in a recording:
//
//   X8.4                          it is not 0
//   D100 > 500 and not R1.0       = != < <= > >=, and, or, not, brackets
//   rises LAMP                    it is 1 (not 0) and was 0 after the part before; falls, changes
//
// Names are those of scenarios; words are separated by blanks, only brackets and comparisons need none.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"
#include "rtlib/core/memory.h"
#include "rtlib/load/ref.h"
#include "tools/replay/past.h"

namespace rung::replay {

class Condition {
public:
  // The place of a name in a program; the error says what is wrong with it.
  using Locate = std::function<Result<runtime::Ref>(std::string_view name)>;

  static Result<Condition> parse(std::string_view text, const Locate& locate);
  // Looks the names up again, in another program, whose values are compared with those of the former one. "" or which
  // one it lacks.
  std::string locate(const Locate& locate);

  // `memory` is of the program in which its names were looked up last. To be called after each part in order: rises,
  // falls and changes compare with the last call, and do not hold in the first one.
  bool holds(const core::Memory& memory);
  // Forgets the last call.
  void restart() { started_ = false; }

private:
  enum class Kind : uint8_t { Value, Equal, NotEqual, Less, LessEqual, Changes, Rises, Falls, And, Or, Not };
  struct Operand {
    // "" or what is wrong with the name.
    std::string locate(const Locate& locate);

    std::string name; // "": a number that is written
    runtime::Ref ref;
    core::Place place;
    bool isNumber = false; // `integer` and `number`, and no place
    double number = 0;
    int64_t integer = 0;
    bool real = false;
  };
  // Those of And, Or and Not are nodes; all others are operands.
  struct Node {
    Kind kind = Kind::Value;
    uint32_t a = 0, b = 0;
    uint64_t last = 0; // value of operand a in the last call
  };
  class Parser;
  bool holds(uint32_t node, const core::Memory& memory);
  bool compare(const Node& node, const core::Memory& memory) const;
  static uint64_t bitsOf(const Operand& operand, const core::Memory& memory);
  static int64_t integerOf(const Operand& operand, const core::Memory& memory);
  static double realOf(const Operand& operand, const core::Memory& memory);
  static bool equal(const Operand& a, const Operand& b, const core::Memory& memory);

  std::vector<Node> nodes_; // the last one is the root
  std::vector<Operand> operands_;
  bool started_ = false;
};

// The first part after `from`, up to `to`, after which the condition holds and did not hold after the part before; the
// past is then at it. Nothing: there is none, or `problem` says why the search ended.
std::optional<uint64_t> findNext(Past& past, Condition& condition, const Condition::Locate& locate, uint64_t from,
                                 uint64_t to, std::string& problem);
// All of them, at most `most`.
std::vector<uint64_t> findAll(Past& past, Condition& condition, const Condition::Locate& locate, uint64_t from,
                              uint64_t to, size_t most, std::string& problem);

} // namespace rung::replay
