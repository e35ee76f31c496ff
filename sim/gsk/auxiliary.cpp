// Functions of a block (see auxiliary.h).
#include "sim/gsk/auxiliary.h"

namespace rung::sim::gsk {
namespace {

bool passesLock(uint32_t code) { return code <= 2 || code == 30; }

} // namespace

void AuxiliaryCodes::lock() {
  std::erase_if(m, [](uint32_t code) { return !passesLock(code); });
  s.reset();
  t.reset();
  b.reset();
}

void AuxiliaryCodes::start(nc::GskFunctions& functions, const nc::gsk::SignalsIo& io, bool highSpeed) const {
  using Line = nc::GskFunctions::Line;
  constexpr Line kLinesOfM[] = {Line::M, Line::M2, Line::M3};
  functions.setHighSpeed(highSpeed && !external);
  for (size_t i = 0; i < m.size() && i < std::size(kLinesOfM); ++i) functions.start(io, kLinesOfM[i], m[i]);
  if (s) functions.start(io, Line::S, *s);
  if (t) functions.start(io, Line::T, *t);
  if (b) functions.start(io, Line::B, *b);
  if (external) functions.start(io, Line::External, 0);
}

} // namespace rung::sim::gsk
