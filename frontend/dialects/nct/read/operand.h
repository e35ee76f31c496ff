// Operands as the checker and the lowering see them: constants, and places in memory that are fixed or computed.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "frontend/syntax/word_lexer.h"

namespace rung::frontend::nct {

struct Symbol; // symbols.h

inline constexpr uint32_t kNoRegister = UINT32_MAX;

enum class ConstantKind : uint8_t { Decimal, Hex, Real };

// #14, #$AB, *3.5 (man. l.598-668). A hexadecimal constant is a pattern of 32 bits, `integer` its signed reading.
struct Constant {
  ConstantKind kind = ConstantKind::Decimal;
  int64_t integer = 0;
  double real = 0;
};

// A word or bit. `word` holds the base with all constant offsets; registers are words whose content counts at run time.
struct Address {
  uint32_t word = 0;
  uint32_t bit = 0;
  uint32_t indexRegister = kNoRegister; // added to `word`
  uint32_t bitRegister = kNoRegister;   // the bit's number instead of `bit`
  bool isBit = false;
  bool immediate = false; // `!`: the time-slice memory
  bool oddIndex = false;  // a constant index that is odd
  bool isFixed() const { return indexRegister == kNoRegister && bitRegister == kNoRegister; }
};

enum class Form : uint8_t { Bad, Constant, Word, Bit, Text };

struct Operand {
  Form form = Form::Bad;   // Bad: has been reported
  bool fromSymbol = false; // written as a name
  char edge = 0;           // '@' or '%' before it
  Constant constant;
  Address address;              // Word and Bit
  const Symbol* base = nullptr; // Word and Bit: the name that it is counted from; null: it is an address
  const Word* source = nullptr;
};

} // namespace rung::frontend::nct
