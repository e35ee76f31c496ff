// Numbers in the rungs of a module that are not what their author wrote: where the compiler has put a variable, in
// which line an instruction is written. Front ends note them where two versions of a program are compared
// (frontend::CompileOptions::given), beside the module as marks are (marks.h).
#pragma once
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "ir/core/ids.h"

namespace rung::ir {

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
