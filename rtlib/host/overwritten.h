// Places that the input copies of a task overwrite before the program reads them: what a host writes there is lost, and
// lasts where the copy comes from.
#pragma once
#include <optional>
#include <vector>

#include "rtlib/host/ref.h"

namespace rung::host {

class Overwritten {
public:
  explicit Overwritten(const rung_program& program); // which outlives it

  // The place that is copied over `ref`; nothing when a value written to `ref` lasts.
  std::optional<Ref> source(const Ref& ref) const;

private:
  const rung_program* program_;
  std::vector<rung_copy> copies_;
};

} // namespace rung::host
