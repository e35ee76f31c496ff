// The conditions of a rung and its outputs, as its author wrote them: which value is a contact and which is the power
// into a coil. Front ends record them for coverage (frontend::CompileOptions::marks), beside the module: no operation
// is added. Passes that change rungs invalidate marks, so they are valid only for a module as built (and with its
// operations ordered).
#pragma once
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ir/core/type.h"

namespace rung::ir {

enum class MarkKind : uint8_t {
  Contact, // the value is 1 if it conducts
  Result,  // of a box or an instruction other than logic of the rung's contacts; decides like a contact
  Coil,    // the value is the power into it
  Input,   // of a box or an instruction: decided like a coil
};

struct Mark {
  MarkKind kind = MarkKind::Contact;
  ValueId value;       // a bit of the rung
  uint32_t line = 0;   // from 1, in the rung's file
  uint32_t column = 0; // from 1, in characters
  std::string text;    // as written: "[/STOP]", "LDI X1.0", "{TOND T1 #30 #1}"
  bool operator==(const Mark&) const = default;
};

class Marks {
public:
  void add(RoutineId routine, uint32_t rung, Mark mark) { marks_[{routine.index, rung}].push_back(std::move(mark)); }
  // In the order of evaluation.
  std::span<const Mark> of(RoutineId routine, uint32_t rung) const {
    const auto at = marks_.find({routine.index, rung});
    return at == marks_.end() ? std::span<const Mark>() : std::span(at->second);
  }

  std::span<Mark> of(RoutineId routine, uint32_t rung) {
    const auto at = marks_.find({routine.index, rung});
    return at == marks_.end() ? std::span<Mark>() : std::span(at->second);
  }

private:
  std::map<std::pair<uint32_t, uint32_t>, std::vector<Mark>> marks_;
};

// Numbers in the rungs of a module that their author did not write: where the compiler has placed a variable, or in
// which line an instruction is. Front ends record them for comparisons of two versions of a program
// (frontend::CompileOptions::given), beside the module as marks are (marks.h).

struct GivenNumber {
  ValueId value;        // a constant of the rung
  SpaceId space;        // of an address; invalid: the number is a line, the size or the number of a space, or a routine
  uint32_t byte = 0;    // beginning of the variable that contains the address
  int64_t distance = 0; // from there, in bytes
  uint32_t bit = 0;     // number of the bit in the byte
  RoutineId routine{};  // the routine with this number; invalid: not a routine's number
  bool operator==(const GivenNumber&) const = default;
};

class GivenNumbers {
public:
  void add(RoutineId routine, uint32_t rung, const GivenNumber& number) {
    numbers_[{routine.index, rung}].push_back(number);
  }
  std::span<const GivenNumber> of(RoutineId routine, uint32_t rung) const {
    const auto at = numbers_.find({routine.index, rung});
    return at == numbers_.end() ? std::span<const GivenNumber>() : std::span(at->second);
  }
  std::span<GivenNumber> of(RoutineId routine, uint32_t rung) {
    const auto at = numbers_.find({routine.index, rung});
    return at == numbers_.end() ? std::span<GivenNumber>() : std::span(at->second);
  }

private:
  std::map<std::pair<uint32_t, uint32_t>, std::vector<GivenNumber>> numbers_;
};

} // namespace rung::ir
