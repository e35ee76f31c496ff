// Initial contents (see contents.h).
#include "tools/report/difference_contents.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <vector>

#include "rtlib/load/ref.h"

namespace rung::report {
namespace {

using runtime::Ref;
using runtime::RefKind;

std::vector<uint8_t> startOf(const rung_program& program) {
  std::vector<uint8_t> memory(program.memory_size, 0);
  for (const rung_init& init : std::span(program.inits, program.init_count))
    std::copy_n(init.data, init.size, memory.begin() + init.offset);
  return memory;
}

std::string shown(const core::Memory& memory, const Ref& ref) {
  switch (ref.kind) {
  case RefKind::Text: return fmt::format("'{}'", runtime::readText(memory, ref));
  case RefKind::Real: return fmt::format("{}", runtime::readReal(memory, ref));
  case RefKind::Int:
    if (ref.width > 8) return fmt::format("{}", runtime::readSigned(memory, ref));
    [[fallthrough]]; // a byte is one of any data
  case RefKind::Bit:
  case RefKind::Constant: return fmt::format("{}", runtime::readRaw(memory, ref));
  }
  return {};
}

void add(const core::Memory& memory, const rung_symbol& symbol, Contents& contents) {
  const Ref whole = runtime::refOf(symbol);
  if (whole.kind == RefKind::Text || whole.count <= 1) {
    contents.emplace(std::pair(symbol.name, 0), shown(memory, whole));
    return;
  }
  for (uint32_t i = 0; i < whole.count; ++i)
    if (const auto element = runtime::element(whole, i); element && runtime::readRaw(memory, *element) != 0)
      contents.emplace(std::pair(fmt::format("{}[{}]", symbol.name, i), i), shown(memory, *element));
}

} // namespace

Contents initialContents(const rung_program& program) {
  std::vector<uint8_t> start = startOf(program);
  const core::Memory memory(program, start.data());
  Contents contents;
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    if ((symbol.flags & (RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST)) != 0 || symbol.space >= program.space_count) continue;
    if ((program.spaces[symbol.space].flags & RUNG_SPACE_ALLOCATED) != 0) add(memory, symbol, contents);
  }
  return contents;
}

std::string zeroLike(const std::string& text) { return text.starts_with('\'') ? "''" : "0"; }

} // namespace rung::report
