// Names that are not declared (see undeclared.h).
#include "frontend/sema/undeclared.h"

#include <string>

namespace rung::frontend {

void noteFurtherUses(DiagBuilder& report, SourceRange second, size_t further) {
  report.note(second, further == 1 ? "it is used once more, here"
                                   : "and " + std::to_string(further) + " further uses; the next is here");
}

} // namespace rung::frontend
