// !NAME, BASE,#n, WORD.bb, and four digits (see nct.h).
#include "rtlib/nc/names/nct.h"

#include "rtlib/host/overwritten.h"
#include "rtlib/host/program_info.h"
#include "rtlib/text/number.h"

namespace rung::nc {

using host::Ref;
using host::RefKind;

namespace {

constexpr std::string_view kMemory = "M";
constexpr std::string_view kTimeSliceMemory = "TS";
constexpr std::string_view kFlags = "FLAGS"; // word 0000; a symbol only where the program names it
constexpr uint32_t kFirstNcByte = 8;         // words 0000 and 0001 are the program's

std::string padded(uint32_t value, size_t digits) {
  const std::string text = std::to_string(value);
  return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
}

// The offset is #n or a constant symbol, and always moves whole words.
std::optional<Ref> shifted(NameSearch& search, std::optional<Ref> ref, std::string_view index) {
  std::optional<int64_t> words;
  if (index.starts_with('#')) {
    words = text::numberIn<int64_t>(index.substr(1));
  } else if (const std::optional<Ref> symbol = search.find(index); symbol && symbol->kind == RefKind::Constant) {
    words = symbol->constant;
  }
  if (!ref || !words || *words < -0x10000000 || *words > 0x10000000) return std::nullopt;
  const int64_t byte = int64_t{ref->byte} + 4 * *words;
  if (byte < 0 || byte > 0xFFFFFFF) return std::nullopt;
  ref->byte = static_cast<uint32_t>(byte);
  return search.inSpace(ref);
}

class NctNames final : public NameGrammar {
public:
  std::optional<Ref> takeApart(NameSearch& search, std::string_view name) const override {
    if (name.front() == '!') {
      const std::optional<Ref> ref = search.find(name.substr(1));
      if (!ref || ref->space != search.space(kMemory)) return std::nullopt;
      Ref direct = *ref;
      direct.space = search.space(kTimeSliceMemory);
      if (!search.inSpace(direct)) return std::nullopt;
      return ref->byte < kFirstNcByte ? direct : nctTimeSlicePlace(search.program(), *ref);
    }
    if (const size_t comma = name.rfind(','); comma != std::string_view::npos)
      return shifted(search, search.find(name.substr(0, comma)), name.substr(comma + 1));
    if (const size_t dot = name.rfind('.'); dot != std::string_view::npos)
      return name.size() - dot == 3 ? search.bitIn(name.substr(0, dot), name.substr(dot + 1)) : std::nullopt;
    if (name == kFlags) return search.inSpace(host::intRef(search.space(kMemory), 0, 32));
    const std::optional<uint32_t> word = text::numberIn<uint32_t>(name);
    if (!word || name.size() != 4) return std::nullopt;
    return search.inSpace(host::intRef(search.space(kMemory), 4 * *word, 32));
  }

  std::string address(const rung_program& program, const Ref& place) const override {
    const std::string_view area = program.spaces[place.space].name;
    if (area != kMemory && area != kTimeSliceMemory) return NameGrammar::address(program, place);
    const std::string word = (area == kTimeSliceMemory ? "!" : "") + padded(place.byte / 4, 4);
    const uint32_t byte = place.byte % 4;
    if (place.kind == RefKind::Bit) return word + "." + padded(byte * 8 + place.bit, 2);
    return byte == 0 ? word : word + " byte " + std::to_string(byte);
  }

  std::string placeName(const rung_program& program, const Ref& place) const override {
    if (place.space != host::findSpace(program, kTimeSliceMemory)) return NameGrammar::placeName(program, place);
    Ref copy = place;
    copy.space = host::findSpace(program, kMemory);
    return "!" + NameGrammar::placeName(program, copy);
  }
};

} // namespace

Ref nctTimeSlicePlace(const rung_program& program, const Ref& place) {
  if (place.byte < kFirstNcByte || place.space != host::findSpace(program, kMemory)) return place;
  return host::Overwritten(program).source(place).value_or(place);
}

const NameGrammar& nctNames() {
  static const NctNames names;
  return names;
}

} // namespace rung::nc
