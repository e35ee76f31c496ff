// Names of places (see place_names.h).
#include "tools/report/place_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

#include "rtlib/nc/names/names.h"
#include "rtlib/nc/signals.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::report {

using runtime::Ref;
using runtime::RefKind;

Ref refOf(const ir::Use& use) {
  const uint32_t byte = use.place.first / 8;
  if (use.type == ir::Type::Bit) return runtime::bitRef(use.place.space.index, byte, use.place.first % 8);
  if (use.type == ir::Type::F64) return runtime::realRef(use.place.space.index, byte);
  return runtime::intRef(use.place.space.index, byte, ir::bitWidth(use.type));
}

Ref refAt(const ir::BitRange& bits) {
  const uint32_t byte = bits.first / 8;
  if (bits.count == 1) return runtime::bitRef(bits.space.index, byte, bits.first % 8);
  Ref bytes = runtime::intRef(bits.space.index, byte, 8);
  bytes.count = bits.count / 8;
  return bytes;
}

ir::BitRange bitsOf(const Ref& place) {
  if (place.kind == RefKind::Bit) return {ir::SpaceId{place.space}, place.byte * 8 + place.bit, place.count};
  if (place.kind == RefKind::Constant) return {ir::SpaceId{place.space}, 0, 0};
  return {ir::SpaceId{place.space}, place.byte * 8, place.width * place.count};
}

std::optional<ir::BitRange> rangeOf(const rung_program& program, const frontend::NamedPlace& place) {
  for (uint32_t i = 0; i < program.space_count && place.bits != 0; ++i)
    if (place.space == program.spaces[i].name) return ir::BitRange{ir::SpaceId{i}, place.firstBit, place.bits};
  return std::nullopt;
}

namespace {

bool isHidden(const rung_program& program, const ir::BitRange& place) {
  return (program.spaces[place.space.index].flags & RUNG_SPACE_HIDDEN) != 0;
}

} // namespace

std::optional<ir::BitRange> knownPlace(const rung_program& program, const ir::Uses& uses, const ir::BitRange& place) {
  if (!isHidden(program, place)) return place;
  const std::vector<ir::BitRange> from = uses.copiedFrom(place);
  if (from.empty() || isHidden(program, from[0])) return std::nullopt;
  return from[0];
}

ir::BitRange listedPlace(const rung_program& program, const ir::Uses& uses, const ir::BitRange& place) {
  const std::optional<ir::BitRange> own = uses.copiedWhole(place);
  return !own || isHidden(program, place) || isHidden(program, *own) ? place : *own;
}

std::string symbolAt(const rung_program& program, const Ref& place) {
  for (uint32_t i = 0; i < program.symbol_count; ++i) {
    const rung_symbol& symbol = program.symbols[i];
    if ((symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN)) != 0) continue;
    if (bitsOf(runtime::refOf(symbol)) == bitsOf(place)) return symbol.name;
  }
  return {};
}

namespace {

// The signal of the control that is this bit, which programs can name without a symbol of their own; "": none.
std::string signalAt(const rung_program& program, const Ref& place) {
  const nc::SignalTable* signals = nc::signalsOf(program.dialect);
  if (signals == nullptr || place.kind != RefKind::Bit) return {};
  const std::string_view area = program.spaces[place.space].name;
  const auto found = std::ranges::find_if(*signals, [&](const nc::Signal& signal) {
    return signal.byteOffset == place.byte && signal.bit == place.bit && signal.type == nc::SignalType::Bit &&
           signal.count == 1 && signal.area == area;
  });
  return found == signals->end() ? std::string() : found->symbol;
}

} // namespace

std::string shownName(const rung_program& program, const Ref& place) {
  std::string symbol = symbolAt(program, place);
  if (symbol.empty()) symbol = signalAt(program, place);
  const std::string address = nc::address(program, place);
  if (symbol.empty()) {
    const std::string cell = nc::cellAddress(program, place);
    const bool isLonger = place.kind == RefKind::Int && cell != address; // D10:2 is not another name of D10
    return nc::hasAddresses(program) && !isLonger ? nc::describe(program, place) : cell;
  }
  return nc::hasAddresses(program) && address != symbol ? fmt::format("{} ({})", symbol, address) : symbol;
}

std::string writtenName(const rung_program& program, const Ref& use) {
  const Ref place = nc::meant(program, use);
  const auto found = [&](const std::string& name) {
    const std::optional<Ref> there = nc::resolve(program, name);
    return there && bitsOf(*there) == bitsOf(place) && (there->kind == RefKind::Real || place.kind != RefKind::Real);
  };
  const std::string symbol = symbolAt(program, place);
  for (const std::string& name : {symbol, nc::realName(symbol), nc::cellAddress(program, place)})
    if (found(name)) return name;
  return {};
}

namespace {

// The space NCI has both directions of TECHNOL's interface; its table says which cells the control reads.
bool isInterfaceOutput(const rung_program& program, const Ref& place) {
  if (program.spaces[place.space].name != std::string_view("NCI")) return false;
  const ir::BitRange bits = bitsOf(place);
  return std::ranges::any_of(nc::technolSignals(), [&](const nc::Signal& signal) {
    if (signal.direction == nc::Direction::In || signal.area != std::string_view("I")) return false;
    const bool isBit = signal.type == nc::SignalType::Bit;
    const ir::BitRange own{bits.space, signal.byteOffset * 8 + (isBit ? signal.bit : 0),
                           isBit ? signal.count : signal.count * signal.strideBytes * 8};
    return ir::overlap(own, bits);
  });
}

// Whether a space is only an input or only an output, as `flag` says.
bool isOnly(const rung_program& program, uint32_t space, uint32_t flag) {
  return (program.spaces[space].flags & (RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT)) == flag;
}
bool anyHas(const rung_program& program, const std::vector<ir::BitRange>& places, uint32_t flag) {
  return std::ranges::any_of(
      places, [&](const ir::BitRange& place) { return (program.spaces[place.space.index].flags & flag) != 0; });
}

} // namespace

bool isWrittenByControl(const rung_program& program, const ir::Uses& uses, const Ref& place) {
  if (isOnly(program, place.space, RUNG_SPACE_INPUT)) return true;
  if (anyHas(program, uses.copiedFrom(bitsOf(place)), RUNG_SPACE_INPUT)) return true;
  for (uint32_t i = 0; i < program.symbol_count; ++i) {
    const rung_symbol& symbol = program.symbols[i];
    if ((symbol.flags & RUNG_SYMBOL_READONLY) != 0 && ir::overlap(bitsOf(runtime::refOf(symbol)), bitsOf(place)))
      return true;
  }
  return false;
}

bool isReadByControl(const rung_program& program, const ir::Uses& uses, const Ref& place) {
  return isOnly(program, place.space, RUNG_SPACE_OUTPUT) || isInterfaceOutput(program, place) ||
         uses.isCleared(bitsOf(place)) || anyHas(program, uses.copiedTo(bitsOf(place)), RUNG_SPACE_OUTPUT);
}

} // namespace rung::report
