// The row of an instruction of this family of languages: what reading, checking and converting a program ask of it.
// lower/lowered_row.h adds the lowering.
#pragma once
#include <cstdint>

#include "frontend/table/instruction.h"

namespace rung::frontend::network {

// Instructions that shape the program; everything else is Plain.
enum class Control : uint8_t { Plain, LevelEnd, Sp, Spe, Jmp, Jmpe, Jmpb, Jmpc, Lbl, Call, CallU, Com, Come };

constexpr bool isEnd(Control control) { return control == Control::LevelEnd || control == Control::Spe; }

struct Row {
  frontend::InstructionInfo info;
  Control control = Control::Plain;
  // Numbers of this class that appear twice in a program give a warning.
  enum class Numbers : uint8_t { Free, Timer, Counter, Edge } numbers = Numbers::Free;
  bool ignoresCondition = false; // one value before it is accepted, and has no effect
  bool hasTable = false;
  uint32_t recordBytes = 0; // of an operand of kind Record
  bool built = true;        // else it is known, and refused by name
};

} // namespace rung::frontend::network
