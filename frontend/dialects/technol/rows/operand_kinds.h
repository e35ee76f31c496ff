// Kinds of operands: what a row may ask for.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "frontend/dialects/technol/records.h"

namespace rung::frontend::technol {

// Which type prefixes a kind takes.
enum Prefix : uint8_t { kByte = 1, kWord = 2, kDword = 4, kQword = 8, kHigh = 16, kReal = 32, kCnst = 64 };

enum class OperandClass : uint8_t { Bit, Value, Label, Name, Keyword, Text, Variable };

struct OperandKind {
  OperandKindInfo info;
  OperandClass parse = OperandClass::Value;
  uint8_t prefixes = 0;
  bool sign = false;                   // `-` in front
  bool cell = true;                    // a cell may stand there
  bool constant = false;               // a constant may
  bool notGiven = false;               // `-` or NIL may
  bool empty = false;                  // nothing may, between commas
  bool text = false;                   // a text may
  bool weight = false;                 // a bit number without an address may: its place has no space
  uint8_t types = 0xFF;                // ir::TypeSet of cells
  SymbolKind name = SymbolKind::Label; // class Name
  std::string_view keywords = {};      // parted by blanks; beside what else may stand there
  const char* structure = nullptr;     // of the control: class Keyword, one of its members
};

std::span<const OperandKind> operandKinds();
std::span<const OperandKindInfo> operandKindInfos();
// By its name; null when there is none.
const OperandKind* findOperandKind(std::string_view kind);

// Calls visit(word, number) for the words of a list, which are parted by blanks.
template <class Visit>
void forEachWord(std::string_view words, Visit visit) {
  for (int64_t number = 0; !words.empty(); ++number) {
    const size_t end = std::min(words.find(' '), words.size());
    visit(words.substr(0, end), number);
    words.remove_prefix(std::min(end + 1, words.size()));
  }
}
// The number of a word in a list, in any case; -1: it is not there.
int64_t numberOfWord(std::string_view words, std::string_view wanted);

// The classes that name variables of MAP_* and DEF_*, and a bit for its number.
inline constexpr std::string_view kNewBit = "new bit";
inline constexpr std::string_view kNewReal = "new real";
inline constexpr std::string_view kNewVariable = "new variable";
inline constexpr std::string_view kLogicalInput = "logical input";
inline constexpr std::string_view kBitName = "name of a bit";

} // namespace rung::frontend::technol
