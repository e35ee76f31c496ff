// See ladder_text.h.
#include "frontend/dialects/fanuc/read/ladder_text.h"

#include "frontend/dialects/fanuc/language.h"
#include "frontend/network/read/reading.h"

namespace rung::frontend::fanuc {

// Which files are lists is the same for each PMC.
bool isLadderText(const SourceManager& sources, FileId file) {
  return network::isLadder(languageOf(Pmc::MemB), sources, file);
}

} // namespace rung::frontend::fanuc
