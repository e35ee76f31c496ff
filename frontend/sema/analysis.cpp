// Names and source ranges of a program (see analysis.h).
#include "frontend/sema/analysis.h"

namespace rung::frontend {

void Analysis::settle() {
  for (uint32_t i = 0; i < definitions_.size(); ++i)
    if (definitions_[i].range.valid()) declared_.add({definitions_[i].range, i});
  declared_.settle(false);
  operands_.settle(false);
  // Some checks read an operand twice: duplicates are removed.
  names_.settle(true);
  targets_.settle(true);
  instructions_.settle(true);
}

} // namespace rung::frontend
