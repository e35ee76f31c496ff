// The functions of MR and MW, by which the PLC reads from and writes to the NC (man. §6.19-§6.28, l.3544-6320), and the
// execution codes of their answers (§6.29, l.6324-6412). Used by the compiler to check codes, by the simulated NC to
// answer, and by the reference page.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::nc::nct {

enum class FunctionAccess : uint8_t { Read, Write }; // MR, MW

enum ExecutionCodeValue : uint16_t {
  kExecuted = 0,
  kBadFunction = 1,
  kBadAmount = 2,
  kWriteProtected = 3,
  kChecksumError = 4,
};

struct ExecutionCode {
  uint16_t code = 0;
  std::string_view meaning;
  uint16_t line = 0; // of the manual
};
// In the order of their codes.
std::span<const ExecutionCode> executionCodes();
const ExecutionCode* findExecutionCode(uint32_t code);

struct NumberRange {
  uint16_t first = 0;
  uint16_t last = 0;
  uint16_t step = 1;
  constexpr bool contains(int64_t n) const { return n >= first && n <= last && (n - first) % step == 0; }
};

enum class WordUse : uint8_t {
  Input,    // the program sets it
  Output,   // the NC writes it ("need not be set")
  Optional, // the program may set it, the NC may write it
};

struct BlockWord {
  uint16_t first = 0;
  uint16_t last = 0;
  WordUse use = WordUse::Input;
  std::string_view meaning;
};

struct ServiceFunction {
  uint16_t code = 0;
  FunctionAccess access = FunctionAccess::Read;
  std::string_view title;
  // Amounts of data that the manual allows, whatever the other words are; any other amount gives code 2. A function may
  // refuse further amounts, depending on its words.
  std::array<NumberRange, 3> amounts = {}; // unused entries begin with 0
  std::span<const BlockWord> words = {};   // from word 2 on
  std::array<NumberRange, 5> codes = {};   // execution codes; unused entries after the first begin with 0
  std::string_view section = {};
  uint16_t line = 0;

  bool allowsAmount(int64_t amount) const;
  bool hasCode(uint32_t executionCode) const;
};

// In the order of the manual.
std::span<const ServiceFunction> serviceFunctions();
// Null if there is none. Reading and writing functions have no code in common.
const ServiceFunction* findServiceFunction(int64_t code);
constexpr std::string_view mnemonicOf(FunctionAccess access) { return access == FunctionAccess::Read ? "MR" : "MW"; }

} // namespace rung::nc::nct
