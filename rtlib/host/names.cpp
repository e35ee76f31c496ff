// The three dialects' ways to write a place. Every dialect first looks the whole name up, then takes it apart.
#include "rtlib/host/names.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <span>

#include "rtlib/host/program_info.h"

namespace rung::host {

namespace {

constexpr size_t kTechnolLength = 31; // significant characters of a name
constexpr int kMostNested = 8;        // NAME[2].3 is two; longer names than any dialect has are refused

bool allDigits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<int64_t> integer(std::string_view text) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<uint32_t> number(std::string_view text) {
  if (!allDigits(text)) return std::nullopt;
  const std::optional<int64_t> value = integer(text);
  if (!value || *value > 0xFFFFFFFF) return std::nullopt;
  return static_cast<uint32_t>(*value);
}

const rung_symbol* firstNotBefore(const rung_program& program, std::string_view name) {
  const rung_symbol* end = program.symbols + program.symbol_count;
  return std::lower_bound(program.symbols, end, name,
                          [](const rung_symbol& s, std::string_view n) { return std::string_view(s.name) < n; });
}

enum class Dialect { Gsk, Nct, Technol, Other };

Dialect dialectOf(const rung_program& program) {
  const std::string_view name = program.dialect;
  if (name == "gsk") return Dialect::Gsk;
  if (name == "nct") return Dialect::Nct;
  if (name == "technol") return Dialect::Technol;
  return Dialect::Other;
}

class Resolver {
public:
  Resolver(const rung_program& program, const NameFallback& fallback)
      : program_(program), fallback_(fallback), memory_(program, nullptr), dialect_(dialectOf(program)) {}

  std::optional<Ref> resolve(std::string_view name) {
    if (name.empty() || depth_ >= kMostNested) return std::nullopt;
    if (const rung_symbol* symbol = lookUp(name)) return refOf(*symbol);
    // GSK's T10 is an address in programs, so it is one here, and not the signal of that name.
    const bool addressFirst = dialect_ == Dialect::Gsk;
    if (addressFirst)
      if (std::optional<Ref> ref = nested(name)) return ref;
    if (fallback_)
      if (std::optional<Ref> ref = fallback_(name)) return ref;
    return addressFirst ? std::nullopt : nested(name);
  }

private:
  const rung_symbol* lookUp(std::string_view name) const {
    if (const rung_symbol* exact = findSymbol(program_, name)) return exact;
    const bool plain = name.find_first_of(".[") == std::string_view::npos;
    if (dialect_ != Dialect::Technol || !plain) return nullptr;
    const std::string_view head = name.substr(0, kTechnolLength);
    const rung_symbol* symbol = firstNotBefore(program_, head);
    const bool found = symbol != program_.symbols + program_.symbol_count &&
                       std::string_view(symbol->name).substr(0, kTechnolLength) == head &&
                       head.size() == kTechnolLength;
    return found ? symbol : nullptr;
  }

  std::optional<Ref> nested(std::string_view name) {
    ++depth_;
    const std::optional<Ref> ref = takeApart(name);
    --depth_;
    return ref;
  }

  std::optional<Ref> takeApart(std::string_view name) {
    switch (dialect_) {
    case Dialect::Gsk: return gsk(name);
    case Dialect::Nct: return nct(name);
    case Dialect::Technol:
    case Dialect::Other: return technol(name);
    }
    return std::nullopt;
  }

  std::optional<Ref> inSpace(const std::optional<Ref>& ref) const {
    if (!ref || !memory_.contains(ref->space, ref->byte, std::max(1u, ref->width / 8u))) return std::nullopt;
    return ref;
  }

  // Bit `digits` of the cell that `name` stands for.
  std::optional<Ref> bitIn(std::string_view name, std::string_view digits) {
    const std::optional<Ref> cell = resolve(name);
    const std::optional<uint32_t> bit = number(digits);
    return cell && bit ? bitOf(*cell, *bit) : std::nullopt;
  }

  // BASE.b, BASE:bytes, and area letter with address.
  std::optional<Ref> gsk(std::string_view name) {
    if (const size_t colon = name.rfind(':'); colon != std::string_view::npos)
      return widened(resolve(name.substr(0, colon)), number(name.substr(colon + 1)));
    if (const size_t dot = name.rfind('.'); dot != std::string_view::npos)
      return bitIn(name.substr(0, dot), name.substr(dot + 1));
    const std::optional<uint32_t> address = number(name.substr(1));
    if (!address) return std::nullopt;
    return inSpace(intRef(findSpace(program_, name.substr(0, 1)), *address, 8));
  }

  std::optional<Ref> widened(std::optional<Ref> ref, std::optional<uint32_t> bytes) const {
    if (!ref || ref->kind != RefKind::Int || !bytes) return std::nullopt;
    const bool longest = *bytes == 8 && dialect_ == Dialect::Technol;
    if (*bytes != 1 && *bytes != 2 && *bytes != 4 && !longest) return std::nullopt;
    ref->width = static_cast<uint8_t>(*bytes * 8);
    ref->count = 1;
    return inSpace(ref);
  }

  // !NAME, BASE,#n, WORD.bb, and four digits.
  std::optional<Ref> nct(std::string_view name) {
    if (name.front() == '!') {
      std::optional<Ref> ref = resolve(name.substr(1));
      if (!ref || ref->space != findSpace(program_, "M")) return std::nullopt;
      ref->space = findSpace(program_, "TS");
      return inSpace(ref);
    }
    if (const size_t comma = name.rfind(','); comma != std::string_view::npos)
      return shifted(resolve(name.substr(0, comma)), name.substr(comma + 1));
    if (const size_t dot = name.rfind('.'); dot != std::string_view::npos)
      return name.size() - dot == 3 ? bitIn(name.substr(0, dot), name.substr(dot + 1)) : std::nullopt;
    if (name.size() != 4 || !allDigits(name)) return std::nullopt;
    return inSpace(intRef(findSpace(program_, "M"), 4 * number(name).value_or(0), 32));
  }

  // The offset is #n or a constant symbol, and always moves whole words.
  std::optional<Ref> shifted(std::optional<Ref> ref, std::string_view index) {
    std::optional<int64_t> words;
    if (index.starts_with('#')) {
      words = integer(index.substr(1));
    } else if (const std::optional<Ref> symbol = resolve(index); symbol && symbol->kind == RefKind::Constant) {
      words = symbol->constant;
    }
    if (!ref || !words || *words < -0x10000000 || *words > 0x10000000) return std::nullopt;
    const int64_t byte = int64_t{ref->byte} + 4 * *words;
    if (byte < 0 || byte > 0xFFFFFFF) return std::nullopt;
    ref->byte = static_cast<uint32_t>(byte);
    return inSpace(ref);
  }

  // TYPE.NAME, NAME:bytes, NAME[n], CELL.n, CELL.WEIGHT, NAME+n.
  std::optional<Ref> technol(std::string_view name) {
    if (const std::optional<uint32_t> bytes = takeType(name)) return widened(inBytes(resolve(name)), bytes);
    if (const size_t colon = name.rfind(':'); colon != std::string_view::npos)
      return widened(inBytes(resolve(name.substr(0, colon))), number(name.substr(colon + 1)));
    const size_t bracket = name.rfind('[');
    if (name.back() == ']' && bracket != std::string_view::npos) {
      const std::optional<Ref> array = resolve(name.substr(0, bracket));
      const std::optional<uint32_t> index = number(name.substr(bracket + 1, name.size() - bracket - 2));
      return array && index ? inSpace(element(*array, *index)) : std::nullopt;
    }
    const size_t dot = name.rfind('.');
    if (dot == std::string_view::npos) return offset(name);
    const std::string_view right = name.substr(dot + 1);
    if (allDigits(right)) return bitIn(name.substr(0, dot), right);
    return weighted(resolve(name.substr(0, dot)), resolve(right));
  }

  // "WORD." at the beginning of the name, which loses it; its bytes.
  static std::optional<uint32_t> takeType(std::string_view& name) {
    constexpr std::pair<std::string_view, uint32_t> kTypes[] = {
        {"BYTE.", 1}, {"WORD.", 2}, {"DWRD.", 4}, {"QWRD.", 8}, {"REAL.", 8}};
    for (const auto& [type, bytes] : kTypes) {
      if (!name.starts_with(type) || name.size() == type.size()) continue;
      name.remove_prefix(type.size());
      return bytes;
    }
    return std::nullopt;
  }

  // NAME+n: what begins n bytes behind it, in the width of its cells.
  std::optional<Ref> offset(std::string_view name) {
    const size_t plus = name.rfind('+');
    if (plus == std::string_view::npos) return std::nullopt;
    std::optional<Ref> ref = inBytes(resolve(name.substr(0, plus)));
    const std::optional<uint32_t> bytes = number(name.substr(plus + 1));
    if (!ref || !bytes || *bytes > 0xFFFFFFF) return std::nullopt;
    ref->byte += *bytes;
    ref->count = 1;
    return inSpace(ref);
  }

  // Texts and reals as integers, the form that has a width; nothing of a bit or a constant.
  static std::optional<Ref> inBytes(std::optional<Ref> ref) {
    if (ref && (ref->kind == RefKind::Text || ref->kind == RefKind::Real)) ref->kind = RefKind::Int;
    return ref && ref->kind == RefKind::Int ? ref : std::nullopt;
  }

  // A bit symbol behind the dot stands for its number in its byte (technol.md 4.1).
  static std::optional<Ref> weighted(const std::optional<Ref>& cell, const std::optional<Ref>& weight) {
    if (!cell || !weight || weight->kind != RefKind::Bit || cell->kind == RefKind::Constant) return std::nullopt;
    Ref ref = bitRef(cell->space, cell->byte, weight->bit);
    ref.readonly = cell->readonly;
    return ref;
  }

  const rung_program& program_;
  const NameFallback& fallback_;
  rt::Memory memory_; // for its bounds only
  Dialect dialect_;
  int depth_ = 0;
};

std::string upperCase(std::string_view text) {
  std::string upper(text);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return upper;
}

std::string padded(uint32_t value, size_t digits) {
  const std::string text = std::to_string(value);
  return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
}

std::string addressText(const rung_program& program, uint32_t space, uint32_t byte, const uint32_t* bit) {
  if (space >= program.space_count) return "no space";
  const std::string area = program.spaces[space].name;
  if (dialectOf(program) == Dialect::Nct && (area == "M" || area == "TS")) {
    const std::string word = (area == "TS" ? "!" : "") + padded(byte / 4, 4);
    if (bit != nullptr) return word + "." + padded(byte % 4 * 8 + *bit, 2);
    return byte % 4 == 0 ? word : word + " byte " + std::to_string(byte % 4);
  }
  const char* separator = dialectOf(program) == Dialect::Gsk && area.size() == 1 ? "" : "+";
  const std::string text = area + separator + std::to_string(byte);
  return bit != nullptr ? text + "." + std::to_string(*bit) : text;
}

uint32_t bytesOf(const rung_symbol& symbol) {
  const Ref ref = refOf(symbol);
  return ref.kind == RefKind::Bit ? (ref.bit + ref.count + 7) / 8 : ref.width / 8u * ref.count;
}

// A bit symbol only counts where its own bit is asked for.
bool liesAt(const rung_symbol& symbol, uint32_t space, uint32_t byte, const uint32_t* bit) {
  if ((symbol.flags & RUNG_SYMBOL_CONST) != 0 || symbol.space != space) return false;
  if (byte < symbol.byte || byte - symbol.byte >= bytesOf(symbol)) return false;
  if (symbol.type != RUNG_TYPE_BIT || symbol.count > 1) return true;
  return bit != nullptr && symbol.bit == *bit;
}

std::string describe(const rung_program& program, uint32_t space, uint32_t byte, const uint32_t* bit) {
  constexpr int kMostNames = 3;
  std::string names;
  int found = 0;
  for (uint32_t i = 0; i < program.symbol_count && found < kMostNames; ++i) {
    if (!liesAt(program.symbols[i], space, byte, bit)) continue;
    names += (found++ == 0 ? "" : ", ") + std::string(program.symbols[i].name);
  }
  const std::string address = addressText(program, space, byte, bit);
  return found == 0 ? address : address + " (" + names + ")";
}

} // namespace

Ref refOf(const rung_symbol& symbol) {
  Ref ref;
  ref.readonly = (symbol.flags & RUNG_SYMBOL_READONLY) != 0;
  if ((symbol.flags & RUNG_SYMBOL_CONST) != 0) {
    ref.kind = RefKind::Constant;
    ref.width = 64;
    ref.constant = symbol.value;
    return ref;
  }
  ref.space = symbol.space;
  ref.byte = symbol.byte;
  ref.count = std::max(1u, symbol.count);
  ref.kind = RefKind::Int;
  switch (static_cast<rung_type>(symbol.type)) {
  case RUNG_TYPE_BIT:
    ref.kind = RefKind::Bit;
    ref.bit = static_cast<uint8_t>(symbol.bit);
    break;
  case RUNG_TYPE_I8: ref.width = 8; break;
  case RUNG_TYPE_I16: ref.width = 16; break;
  case RUNG_TYPE_I32: ref.width = 32; break;
  case RUNG_TYPE_I64: ref.width = 64; break;
  case RUNG_TYPE_F64:
    ref.width = 64;
    ref.kind = RefKind::Real;
    break;
  case RUNG_TYPE_TEXT:
    ref.width = 8;
    ref.kind = RefKind::Text;
    break;
  }
  return ref;
}

const rung_symbol* findSymbol(const rung_program& program, std::string_view name) {
  const rung_symbol* symbol = firstNotBefore(program, name);
  return symbol != program.symbols + program.symbol_count && name == symbol->name ? symbol : nullptr;
}

std::optional<Ref> resolve(const rung_program& program, std::string_view name, const NameFallback& fallback) {
  Resolver resolver(program, fallback);
  if (dialectOf(program) != Dialect::Technol) return resolver.resolve(name);
  const std::string upper = upperCase(name);
  return resolver.resolve(upper);
}

std::string placeName(const rung_program& program, const Ref& place) {
  if (place.kind == RefKind::Constant) return std::to_string(place.constant);
  if (dialectOf(program) == Dialect::Nct && place.space == findSpace(program, "TS")) {
    Ref copy = place;
    copy.space = findSpace(program, "M");
    return "!" + placeName(program, copy);
  }
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    Ref own = refOf(symbol);
    own.readonly = place.readonly;
    if (own == place) return symbol.name;
  }
  const uint32_t bit = place.bit;
  return addressText(program, place.space, place.byte, place.kind == RefKind::Bit ? &bit : nullptr);
}

std::string describeBit(const rung_program& program, uint32_t space, uint32_t byte, uint32_t bit) {
  return describe(program, space, byte, &bit);
}

std::string describeByte(const rung_program& program, uint32_t space, uint32_t byte) {
  return describe(program, space, byte, nullptr);
}

} // namespace rung::host
