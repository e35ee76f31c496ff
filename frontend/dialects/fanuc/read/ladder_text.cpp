// See ladder_text.h.
#include "frontend/dialects/fanuc/read/ladder_text.h"

#include "frontend/ladder/text/ladder_file.h"

namespace rung::frontend::fanuc {

bool isLadderText(const SourceManager& sources, FileId file) { return !ladder::peekDialect(sources, file).empty(); }

} // namespace rung::frontend::fanuc
