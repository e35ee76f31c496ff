// Places that the input copies of a task overwrite before the program reads them: what a host writes there is lost, and
// lasts where the copy comes from.
#pragma once
#include <optional>

#include "rtlib/load/ref.h"

namespace rung::runtime {

class Overwritten {
public:
  explicit Overwritten(const rung_program& program) : program_(&program) {} // which outlives it

  // The place that is copied over `ref`; nothing when a value written to `ref` lasts. Allocates nothing.
  std::optional<Ref> source(const Ref& ref) const;

private:
  const rung_copy* over(uint32_t offset) const;

  const rung_program* program_;
};

} // namespace rung::runtime
