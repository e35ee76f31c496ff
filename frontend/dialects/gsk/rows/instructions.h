// The instruction table of the dialect: one row an instruction, with its lowering. Everything that is data about an
// instruction stands here only; README.md tells how to add one.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "frontend/table/instruction.h"

namespace rung::gsk {

class FunctionLowering;

// Classes of operands; the rows name them by kindName().
enum class Kind : uint8_t {
  Bit,            // bit to be read
  Coil,           // bit to be written
  Format,         // 1, 2 or 4: length in bytes
  FormatA,        // a00n: 0 constant or 1 address, length
  Byte,           // address of 1 byte
  Word,           // address of 2 bytes
  Dword,          // address of 4 bytes
  Data,           // address of as many bytes as the format says
  Block,          // address of as many bytes as the first operand says (MOVN)
  Constant,       // constant that fits the format
  ConstantOrData, // as the format's `a` says
  Number,         // number in the range of the row
  Mask,           // four binary digits
  Label,          // L1-L9999
  Subprogram,     // P1-P512
  DataTable,      // address in D
  WorkArea,       // address of 4 bytes in R
  Record,         // address of as many bytes as Row::recordBytes says
};
inline constexpr int kKindCount = 18;
inline constexpr std::array<std::string_view, kKindCount> kKindNames = {
    "bit",       "coil",     "format",           "format-a", "byte", "word",  "dword",      "data",
    "block",     "constant", "constant-or-data", "number",   "mask", "label", "subprogram", "data-table",
    "work-area", "record"};
constexpr std::string_view kindName(Kind kind) { return kKindNames[static_cast<size_t>(kind)]; }
Kind kindOf(const frontend::OperandInfo& operand);

// Instructions that shape the program; everything else is Plain.
enum class Control : uint8_t { Plain, End1, End2, Sp, Spe, Jmp, Jmpe, Jmpb, Jmpc, Lbl, Call, CallU, Com, Come };

constexpr bool isEnd(Control control) {
  return control == Control::End1 || control == Control::End2 || control == Control::Spe;
}

struct Row {
  frontend::InstructionInfo info;
  Control control = Control::Plain;
  // Numbers of this class that stand twice in a program give a warning.
  enum class Numbers : uint8_t { Free, Timer, Counter, Edge } numbers = Numbers::Free;
  bool hasTable = false;
  uint32_t recordBytes = 0;                     // of an operand of kind Record
  void (*lower)(FunctionLowering& f) = nullptr; // null: known, but not built
  int variant = 0;                              // for `lower`
};

std::span<const Row> allRows();
// The rows of FUNC; null when there is none.
const Row* findFunction(uint64_t number);
const Row* findFunction(std::string_view mnemonic);
// Its data alone, of a box.
const frontend::InstructionInfo* findBox(std::string_view mnemonic);

std::span<const frontend::InstructionInfo* const> instructionInfos();
std::span<const frontend::OperandKindInfo> operandKindInfos();

} // namespace rung::gsk
