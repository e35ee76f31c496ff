// REAL.NAME, !NAME, BASE,#n, WORD.bb, signals, and four digits (see nct.h).
#include "rtlib/nc/names/nct.h"

#include "rtlib/load/program_info.h"
#include "rtlib/nc/nct/signals.h"
#include "rtlib/run/loaded_program.h"
#include "rtlib/text/name_parts.h"
#include "rtlib/text/number.h"

namespace rung::nc {

using runtime::Ref;
using runtime::RefKind;

namespace {

constexpr std::string_view kMemory = "M";
constexpr std::string_view kTimeSliceMemory = "TS";
constexpr std::string_view kFlags = "FLAGS"; // word 0000; a symbol only if the program declares it
constexpr uint32_t kFirstNcByte = 8;         // words 0000 and 0001 belong to the program

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
  ref->count = 1;
  return search.inSpace(ref);
}

uint32_t bitIn(const Ref& place) { return place.byte % 4 * 8 + place.bit; } // in its word

// The signal at a place of the NC area, for which the manual gives names and no addresses (man. l.6448): preferably the
// word, as marked at the terminals of the 24 V interface, else the bit. Null for a place without a name, and for the
// bits of a double.
const Signal* signalAt(const Ref& place) {
  const uint32_t word = place.byte / 4 * 4;
  const bool isBit = place.kind == RefKind::Bit;
  const Signal* own = nullptr;
  for (const Signal& signal : nctSignals()) {
    const uint32_t distance = word - signal.byteOffset; // wraps to a large number for words before the signal
    if (distance >= signal.count * signal.strideBytes || distance % signal.strideBytes != 0) continue;
    if (signal.type == SignalType::Real && isBit) return nullptr;
    if (signal.type != SignalType::Bit) return &signal;
    if (isBit && signal.bit == bitIn(place) && own == nullptr) own = &signal;
  }
  return own;
}

std::string bitText(const Ref& place) { return place.kind == RefKind::Bit ? "." + padded(bitIn(place), 2) : ""; }

// The suffix for a byte that is not the first of its word.
std::string byteText(const Ref& place) {
  const uint32_t byte = place.byte % 4;
  return place.kind == RefKind::Bit || byte == 0 ? "" : " byte " + std::to_string(byte);
}

std::string numberText(const Ref& place) { return padded(place.byte / 4, 4) + bitText(place) + byteText(place); }

std::string signalText(const Signal& signal, const Ref& place) {
  const uint32_t words = (place.byte - signal.byteOffset) / 4;
  const std::string index = words == 0 ? "" : ",#" + std::to_string(words);
  return signal.symbol + (signal.type == SignalType::Bit ? "" : bitText(place)) + index + byteText(place);
}

class NctNames final : public NameGrammar {
public:
  std::optional<Ref> takeApart(NameSearch& search, std::string_view name) const override {
    if (name.starts_with(text::kRealPrefix)) // if not a real: a bit of the symbol REAL
      if (std::optional<Ref> real = search.real(search.find(name.substr(text::kRealPrefix.size())))) return real;
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
    if (name == kFlags) return search.inSpace(runtime::intRef(search.space(kMemory), 0, 32));
    if (const std::optional<Ref> signal = nctSignalPlace(search.program(), name)) return search.inSpace(signal);
    const std::optional<uint32_t> word = text::numberIn<uint32_t>(name);
    if (!word || name.size() != 4) return std::nullopt;
    return search.inSpace(runtime::intRef(search.space(kMemory), 4 * *word, 32));
  }

  // Two words are a double (man. 6.3.2): nothing else moves or computes 64 bits.
  Ref meant(const Ref& place) const override {
    return place.kind == RefKind::Int && place.width == 64 ? runtime::realRef(place.space, place.byte) : place;
  }

  std::string address(const rung_program& program, const Ref& place) const override {
    const std::string_view area = program.spaces[place.space].name;
    if (area != kMemory && area != kTimeSliceMemory) return NameGrammar::address(program, place);
    const Signal* signal = signalAt(place);
    return mark(area) + (signal != nullptr ? signalText(*signal, place) : numberText(place));
  }

  // The name of a signal refers to all its elements, so it also gives the length.
  std::string cellAddress(const rung_program& program, const Ref& place) const override {
    const std::string_view area = program.spaces[place.space].name;
    const Signal* signal = area == kMemory || area == kTimeSliceMemory ? signalAt(place) : nullptr;
    const bool isRealSignal = signal != nullptr && signal->type == SignalType::Real;
    if (place.kind == RefKind::Real && !isRealSignal) return realName(address(program, place));
    if (signal == nullptr || place.kind == RefKind::Bit) return address(program, place);
    const uint32_t bits = uint32_t{place.width} * place.count;
    const uint32_t element = elementBytes(signal->type) * 8;
    if (bits != element && bits != element * signal->count) return mark(area) + numberText(place);
    const bool isFirstOfMany = bits == element && signal->count > 1 && place.byte == signal->byteOffset;
    return address(program, place) + (isFirstOfMany ? ",#0" : "");
  }

  std::string placeName(const rung_program& program, const Ref& place) const override {
    if (place.kind == RefKind::Real) return realName(placeName(program, runtime::intRef(place.space, place.byte, 32)));
    if (place.space != runtime::findSpace(program, kTimeSliceMemory)) return NameGrammar::placeName(program, place);
    Ref copy = place;
    copy.space = runtime::findSpace(program, kMemory);
    return "!" + NameGrammar::placeName(program, copy);
  }

private:
  static std::string mark(std::string_view area) { return area == kTimeSliceMemory ? "!" : ""; }
};

} // namespace

Ref nctTimeSlicePlace(const rung_program& program, const Ref& place) {
  if (place.byte < kFirstNcByte || place.space != runtime::findSpace(program, kMemory)) return place;
  return runtime::Overwritten(program).source(place).value_or(place);
}

std::optional<Ref> nctSignalPlace(const rung_program& program, std::string_view name) {
  const Signal* found = findSignal(nctSignals(), name);
  const uint32_t memory = runtime::findSpace(program, kMemory);
  if (found == nullptr || memory == RUNG_NONE) return std::nullopt;
  if (found->type == SignalType::Bit) return runtime::bitRef(memory, found->byteOffset, found->bit);
  Ref place = found->type == SignalType::Real ? runtime::realRef(memory, found->byteOffset)
                                              : runtime::intRef(memory, found->byteOffset, 32);
  place.count = found->count;
  return place;
}

const NameGrammar& nctNames() {
  static const NctNames names;
  return names;
}

} // namespace rung::nc
