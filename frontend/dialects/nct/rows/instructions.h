// The instruction table of the dialect: one row per instruction, data with its check and its lowering. README.md says
// how to add one.
#pragma once
#include <span>
#include <string_view>

#include "frontend/dialects/nct/config.h"
#include "frontend/dialects/nct/read/symbols.h"
#include "frontend/sema/foreign_word.h"
#include "frontend/table/instruction.h"
#include "ir/core/builder.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend::nct {

struct Lowering; // lower.h

// Returns the power at the output; an invalid id for a row without output.
using LowerFn = ir::ValueId (*)(Lowering& box);
// Checks that a row's data cannot express; called if all operands are of the right kinds.
using CheckFn = void (*)(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics);

// What "each output once" (l.233) means for the row's first operand.
enum class Reservation : uint8_t { None, Once, SetReset };

enum class Flow : uint8_t { None, End, Jump, Label, Call, Subroutine, Return, Section };

// How it is drawn: contacts and coils are identified by their form, not by a mnemonic.
enum class Shape : uint8_t { Box, Contact, Coil };

struct Row {
  frontend::InstructionInfo info;
  LowerFn lower = nullptr; // null: not built yet, unless `flow` needs no lowering
  int variant = 0;         // interpreted by the lowering function
  CheckFn check = nullptr;
  Reservation reservation = Reservation::None;
  Flow flow = Flow::None;
  Shape shape = Shape::Box;
  bool usesScratch = false; // uses the space @S
  bool isBuilt() const { return lower != nullptr || flow != Flow::None; }
};

// In the order of the manual.
std::span<const Row> allRows();
std::span<const frontend::InstructionInfo* const> instructionInfos();

// A box by its mnemonic or one of its other spellings, including section (SEC); null for contacts and coils, and if
// there is none.
const Row* findBox(std::string_view mnemonic);
// The data of its row.
const frontend::InstructionInfo* findBoxInfo(std::string_view mnemonic);
// Row of a contact: on a bit or a word, closed or open.
const Row& contactRow(bool onBit, bool closed);
const Row& coilRow(int coilKind); // ladder::CoilKind as a number
// The box that does for doubles what this one does for integers; empty if there is none.
std::string_view doublesOf(std::string_view mnemonic);
// Boxes of other controls.
std::span<const frontend::ForeignWord> foreignWords();

} // namespace rung::frontend::nct
