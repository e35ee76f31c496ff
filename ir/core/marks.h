// What a rung asks and what it decides, as its author wrote it: which value is a contact and which is the power into a
// coil. Front ends note it where coverage asks for it (frontend::CompileOptions::marks), beside the module: no
// operation is added. Passes that change rungs make marks meaningless, so they go with a module as it was built (and
// put in order).
#pragma once
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ir/core/type.h"

namespace rung::ir {

enum class MarkKind : uint8_t {
  Contact, // the value says whether it conducts
  Result,  // of a box or an instruction that is not logic of the rung's contacts; decides as a contact does
  Coil,    // the value is the power into it
  Input,   // of a box or an instruction: decided as a coil is
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

// Numbers in the rungs of a module that are not what their author wrote: where the compiler has put a variable, in
// which line an instruction is written. Front ends note them where two versions of a program are compared
// (frontend::CompileOptions::given), beside the module as marks are (marks.h).

struct GivenNumber {
  ValueId value;        // a constant of the rung
  SpaceId space;        // of an address; invalid: a line, the size or the number of a space, or a routine
  uint32_t byte = 0;    // where the variable begins that it is an address in
  int64_t distance = 0; // from there, in bytes
  uint32_t bit = 0;     // of the byte there
  RoutineId routine{};  // whose number it is; invalid: none
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
