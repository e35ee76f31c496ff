// How a dialect writes names of places: one class for each dialect. The base class serves programs of unknown dialects.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/nc/names/names.h"

namespace rung::nc {

class NameSearch;

// Without state: one object serves all programs and threads.
class NameGrammar {
public:
  virtual ~NameGrammar() = default;

  enum class Case : uint8_t {
    Counts,
    Upper,   // names are looked up in upper case, as the program's tables have them
    Ignored, // the program's tables have names as it writes them, to be shown; upper and lower case are the same
  };
  virtual Case ofNames() const { return Case::Counts; }
  // An address takes precedence over a signal of the control with the same name.
  virtual bool addressFirst() const { return false; }
  virtual bool hasAddresses() const { return true; }
  // Bytes of the longest cell that a name may denote: 4 or 8.
  virtual uint32_t longestCell() const { return 4; }

  // The symbol of this name; null if there is none.
  virtual const rung_symbol* symbol(const rung_program& program, std::string_view name) const;
  // Resolves a name that is not a symbol and not empty: NAME:bytes, NAME[n], CELL.n, NAME+n.
  virtual std::optional<runtime::Ref> takeApart(NameSearch& search, std::string_view name) const;

  // The place as the kind of number that the dialect has in a cell of this width.
  virtual runtime::Ref meant(const runtime::Ref& place) const { return place; }
  // The address of a place in one of the program's spaces: AREA+n, AREA+n.b.
  virtual std::string address(const rung_program& program, const runtime::Ref& place) const;
  virtual std::string cellAddress(const rung_program& program, const runtime::Ref& place) const {
    return address(program, place);
  }
  virtual std::string placeName(const rung_program& program, const runtime::Ref& place) const;

protected:
  // The shortest symbol that contains the bit or the first byte of the place; null if there is none.
  static const rung_symbol* shortestAt(const rung_program& program, const runtime::Ref& place);
};

// One look-up of a name, with the helpers by which grammars parse names. The program and the fallback outlive it.
class NameSearch {
public:
  NameSearch(const rung_program& program, const NameGrammar& grammar, const NameFallback& fallback)
      : program_(program), grammar_(grammar), fallback_(fallback), memory_(program, nullptr) {}

  // Finds a symbol, a signal of the control, or a place by the grammar's takeApart.
  std::optional<runtime::Ref> find(std::string_view name);

  const rung_program& program() const { return program_; }
  uint32_t space(std::string_view name) const;
  // The place itself, or nothing if it is outside its space.
  std::optional<runtime::Ref> inSpace(const std::optional<runtime::Ref>& ref) const;
  // Bit `digits` of the cell `name`.
  std::optional<runtime::Ref> bitIn(std::string_view name, std::string_view digits);
  // A cell of `bytes` bytes (1, 2, 4 or the longest) at the address of the integer.
  std::optional<runtime::Ref> widened(std::optional<runtime::Ref> ref, std::optional<uint32_t> bytes) const;
  // The same at NAME or NAME+n; a cell of NAME's own length need not fit there.
  std::optional<runtime::Ref> ofBytes(std::string_view name, std::optional<uint32_t> bytes);

  // The real at the address of the cell, as runtime::asReal.
  std::optional<runtime::Ref> real(const std::optional<runtime::Ref>& ref) const;

  // Converts texts and reals to integers, whose width can be changed; nothing for a bit or a constant.
  static std::optional<runtime::Ref> inBytes(std::optional<runtime::Ref> ref);
  static bool allDigits(std::string_view text);

private:
  std::optional<runtime::Ref> nested(std::string_view name);

  const rung_program& program_;
  const NameGrammar& grammar_;
  const NameFallback& fallback_;
  core::Memory memory_; // for its bounds only
  int depth_ = 0;
};

} // namespace rung::nc
