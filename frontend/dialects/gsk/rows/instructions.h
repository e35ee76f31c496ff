// The instruction table of the dialect: one row an instruction, with its lowering. Everything that is data about an
// instruction is here only; README.md says how to add one.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "frontend/table/instruction.h"

namespace rung::gsk {

class FunctionLowering;

// Instructions that shape the program; everything else is Plain.
enum class Control : uint8_t { Plain, End1, End2, Sp, Spe, Jmp, Jmpe, Jmpb, Jmpc, Lbl, Call, CallU, Com, Come };

constexpr bool isEnd(Control control) {
  return control == Control::End1 || control == Control::End2 || control == Control::Spe;
}

struct Row {
  frontend::InstructionInfo info;
  Control control = Control::Plain;
  // Numbers of this class that appear twice in a program give a warning.
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

} // namespace rung::gsk
