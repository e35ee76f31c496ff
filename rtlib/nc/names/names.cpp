// The common part of names in all dialects, and the table of the dialects (see names.h, grammar.h).
#include "rtlib/nc/names/names.h"

#include <algorithm>
#include <span>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/grammar.h"
#include "rtlib/nc/names/nct.h"
#include "rtlib/nc/names/pmc.h"
#include "rtlib/nc/names/technol.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/name_parts.h"
#include "rtlib/text/number.h"

namespace rung::nc {

using runtime::Ref;
using runtime::RefKind;

namespace {

constexpr int kMostNested = 8; // NAME[2].3 is two; longer names than any dialect has are refused

struct Row {
  std::string_view dialect;
  const NameGrammar& (*grammar)();
};
constexpr Row kDialects[] = {{"fanuc", fanucNames}, {"gsk", gskNames}, {"nct", nctNames}, {"technol", technolNames}};

const NameGrammar& grammarOf(const rung_program& program) {
  static const NameGrammar plain;
  const Row* row = std::ranges::find(kDialects, std::string_view(program.dialect), &Row::dialect);
  return row == std::end(kDialects) ? plain : row->grammar();
}

uint32_t bytesOf(const rung_symbol& symbol) {
  const Ref ref = runtime::refOf(symbol);
  return ref.kind == RefKind::Bit ? (ref.bit + ref.count + 7) / 8 : ref.width / 8u * ref.count;
}

// Whether the symbol contains the place; a bit symbol contains only its own bit.
bool liesAt(const rung_symbol& symbol, const Ref& place) {
  if ((symbol.flags & RUNG_SYMBOL_CONST) != 0 || symbol.space != place.space) return false;
  if (place.byte < symbol.byte || place.byte - symbol.byte >= bytesOf(symbol)) return false;
  if (symbol.type != RUNG_TYPE_BIT || symbol.count > 1) return true;
  return place.kind == RefKind::Bit && symbol.bit == place.bit;
}

// Whether the name is shown: a hidden one only in a hidden space, because elsewhere it is a second name for the
// compiler's own use.
bool isShown(const rung_program& program, const rung_symbol& symbol) {
  const bool hidden = (symbol.flags & RUNG_SYMBOL_HIDDEN) != 0;
  return !hidden ||
         (symbol.space < program.space_count && (program.spaces[symbol.space].flags & RUNG_SPACE_HIDDEN) != 0);
}

std::string addressBy(const NameGrammar& grammar, const rung_program& program, const Ref& place) {
  return place.space < program.space_count ? grammar.address(program, place) : "no space";
}

} // namespace

// ---- grammar of unknown dialects ---------------------------------------------------------------------------------

const rung_symbol* NameGrammar::symbol(const rung_program& program, std::string_view name) const {
  if (const rung_symbol* exact = runtime::findSymbol(program, name); exact != nullptr || ofNames() != Case::Ignored)
    return exact;
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count))
    if (text::equalsIgnoringCase(symbol.name, name)) return &symbol;
  return nullptr;
}

std::optional<Ref> NameGrammar::takeApart(NameSearch& search, std::string_view name) const {
  if (const size_t colon = name.rfind(':'); colon != std::string_view::npos)
    return search.ofBytes(name.substr(0, colon), text::numberIn<uint32_t>(name.substr(colon + 1)));
  if (const size_t bracket = name.rfind('['); name.back() == ']' && bracket != std::string_view::npos) {
    const std::optional<Ref> array = search.find(name.substr(0, bracket));
    const std::optional<uint32_t> index = text::numberIn<uint32_t>(name.substr(bracket + 1, name.size() - bracket - 2));
    return array && index ? search.inSpace(runtime::element(*array, *index)) : std::nullopt;
  }
  if (const size_t dot = name.rfind('.'); dot != std::string_view::npos)
    return search.bitIn(name.substr(0, dot), name.substr(dot + 1));
  const size_t plus = name.rfind('+');
  if (plus == std::string_view::npos) return std::nullopt;
  // The cell `bytes` bytes further, of the same width.
  std::optional<Ref> ref = NameSearch::inBytes(search.find(name.substr(0, plus)));
  const std::optional<uint32_t> bytes = text::numberIn<uint32_t>(name.substr(plus + 1));
  if (!ref || !bytes || *bytes > 0xFFFFFFF) return std::nullopt;
  ref->byte += *bytes;
  ref->count = 1;
  return search.inSpace(ref);
}

std::string NameGrammar::address(const rung_program& program, const Ref& place) const {
  const std::string text = std::string(program.spaces[place.space].name) + "+" + std::to_string(place.byte);
  return place.kind == RefKind::Bit ? text + "." + std::to_string(place.bit) : text;
}

std::string NameGrammar::placeName(const rung_program& program, const Ref& place) const {
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    Ref own = runtime::refOf(symbol);
    own.readonly = place.readonly;
    if (own == place && isShown(program, symbol)) return symbol.name;
  }
  return addressBy(*this, program, place);
}

const rung_symbol* NameGrammar::shortestAt(const rung_program& program, const Ref& place) {
  const rung_symbol* shortest = nullptr;
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    if (!liesAt(symbol, place) || !isShown(program, symbol)) continue;
    const bool isShorter = shortest == nullptr || bytesOf(symbol) < bytesOf(*shortest) ||
                           (symbol.type == RUNG_TYPE_BIT && shortest->type != RUNG_TYPE_BIT);
    if (isShorter) shortest = &symbol;
  }
  return shortest;
}

// ---- search ------------------------------------------------------------------------------------------------------

std::optional<Ref> NameSearch::find(std::string_view name) {
  if (name.empty() || depth_ >= kMostNested) return std::nullopt;
  if (const rung_symbol* symbol = grammar_.symbol(program_, name)) return runtime::refOf(*symbol);
  const bool addressFirst = grammar_.addressFirst();
  if (addressFirst)
    if (std::optional<Ref> ref = nested(name)) return ref;
  if (fallback_)
    if (std::optional<Ref> ref = fallback_(name)) return ref;
  return addressFirst ? std::nullopt : nested(name);
}

std::optional<Ref> NameSearch::nested(std::string_view name) {
  ++depth_;
  const std::optional<Ref> ref = grammar_.takeApart(*this, name);
  --depth_;
  return ref;
}

uint32_t NameSearch::space(std::string_view name) const { return runtime::findSpace(program_, name); }

std::optional<Ref> NameSearch::inSpace(const std::optional<Ref>& ref) const {
  if (!ref || !memory_.contains(ref->space, ref->byte, std::max(1u, ref->width / 8u))) return std::nullopt;
  return ref;
}

std::optional<Ref> NameSearch::bitIn(std::string_view name, std::string_view digits) {
  const std::optional<uint32_t> bit = text::numberIn<uint32_t>(digits);
  std::optional<Ref> cell = bit ? find(name) : std::nullopt;
  if (bit && !cell) cell = ofBytes(name, *bit < 8 ? 1 : *bit < 16 ? 2 : *bit < 32 ? 4 : 8); // NAME+n at a space's end
  return cell ? runtime::bitOf(*cell, *bit) : std::nullopt;
}

std::optional<Ref> NameSearch::widened(std::optional<Ref> ref, std::optional<uint32_t> bytes) const {
  if (!ref || ref->kind != RefKind::Int || !bytes) return std::nullopt;
  if (*bytes != 1 && *bytes != 2 && *bytes != 4 && *bytes != grammar_.longestCell()) return std::nullopt;
  ref->width = static_cast<uint8_t>(*bytes * 8);
  ref->count = 1;
  return inSpace(ref);
}

std::optional<Ref> NameSearch::ofBytes(std::string_view name, std::optional<uint32_t> bytes) {
  const size_t plus = std::min(name.rfind('+'), name.size());
  std::optional<Ref> cell = inBytes(find(name.substr(0, plus)));
  const std::optional<uint32_t> distance =
      plus == name.size() ? std::optional(0u) : text::numberIn<uint32_t>(name.substr(plus + 1));
  if (!cell || !distance || *distance > 0xFFFFFFF) return std::nullopt;
  cell->byte += *distance;
  return widened(cell, bytes);
}

std::optional<Ref> NameSearch::real(const std::optional<Ref>& ref) const {
  return ref ? runtime::asReal(memory_, *ref) : std::nullopt;
}

std::optional<Ref> NameSearch::inBytes(std::optional<Ref> ref) {
  if (ref && (ref->kind == RefKind::Text || ref->kind == RefKind::Real)) ref->kind = RefKind::Int;
  return ref && ref->kind == RefKind::Int ? ref : std::nullopt;
}

bool NameSearch::allDigits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// ---- names.h -----------------------------------------------------------------------------------------------------

std::optional<Ref> resolve(const rung_program& program, std::string_view name, const NameFallback& fallback) {
  const NameGrammar& grammar = grammarOf(program);
  NameSearch search(program, grammar, fallback);
  return grammar.ofNames() == NameGrammar::Case::Upper ? search.find(text::upper(name)) : search.find(name);
}

std::string_view headOf(std::string_view name) { return text::headOf(name); }

std::string placeName(const rung_program& program, const Ref& place) {
  if (place.kind == RefKind::Constant) return std::to_string(place.constant);
  return grammarOf(program).placeName(program, place);
}

Ref meant(const rung_program& program, const Ref& place) { return grammarOf(program).meant(place); }

std::string realName(std::string_view name) { return std::string(text::kRealPrefix) + std::string(name); }

std::string address(const rung_program& program, const Ref& place) {
  return addressBy(grammarOf(program), program, place);
}

std::string cellAddress(const rung_program& program, const Ref& place) {
  return place.space < program.space_count ? grammarOf(program).cellAddress(program, place) : "no space";
}

runtime::Naming naming(const rung_program& program) {
  return {.nameOf = &address, .ignoresCase = grammarOf(program).ofNames() == NameGrammar::Case::Ignored};
}

bool hasAddresses(const rung_program& program) { return grammarOf(program).hasAddresses(); }

std::string describe(const rung_program& program, const Ref& place) {
  if (!hasAddresses(program)) return address(program, place); // it consists of names
  constexpr int kMostNames = 3;
  const std::string text = address(program, place);
  std::string names;
  int found = 0;
  for (uint32_t i = 0; i < program.symbol_count && found < kMostNames; ++i) {
    const rung_symbol& symbol = program.symbols[i];
    if (!liesAt(symbol, place) || !isShown(program, symbol) || headOf(text) == symbol.name) continue;
    names += (found++ == 0 ? "" : ", ") + std::string(symbol.name);
  }
  return text + (found == 0 ? "" : " (" + names + ")");
}

} // namespace rung::nc
