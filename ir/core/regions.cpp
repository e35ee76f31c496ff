// Pairing what opens a region with what closes it (see regions.h).
#include "ir/core/regions.h"

#include "ir/core/ops.h"

namespace rung::ir {

bool findRegions(const Rung& rung, std::vector<Region>& regions) {
  regions.resize(rung.ops.size());
  std::vector<uint32_t> open; // the operation that began the region: if, else or loop
  bool any = false;
  for (uint32_t i = 0; i < rung.ops.size(); ++i) {
    const OpCode code = rung.ops[i].code;
    const bool opens = code == OpCode::If || code == OpCode::Else || code == OpCode::Loop;
    const bool closes = code == OpCode::Else || code == OpCode::EndIf || code == OpCode::EndLoop;
    if (!opens && !closes) continue;
    any = true;
    regions[i] = {i, i};
    if (closes) {
      regions[open.back()].end = i;
      regions[i].begin = regions[open.back()].begin;
      open.pop_back();
    }
    if (opens) open.push_back(i);
  }
  return any;
}

} // namespace rung::ir
