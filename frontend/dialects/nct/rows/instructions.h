// The instruction table of the dialect: one row an instruction, data beside its check and its lowering.
// README.md says how to add one.
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

// Gives the power at the output; nothing for a row without output.
using LowerFn = ir::ValueId (*)(Lowering& box);
// What a row's data cannot say about the operands; all of them are of the right kinds.
using CheckFn = void (*)(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics);

// What "each output once" (l.233) means for the row's first operand.
enum class Reservation : uint8_t { None, Once, SetReset };

enum class Flow : uint8_t { None, End, Jump, Label, Call, Subroutine, Return, Section };

// How it is drawn: contacts and coils are found by their form, not by a mnemonic.
enum class Shape : uint8_t { Box, Contact, Coil };

struct Row {
  frontend::InstructionInfo info;
  LowerFn lower = nullptr; // null: not built yet, unless `flow` says that there is nothing to do
  int variant = 0;         // meaning is the lowering function's
  CheckFn check = nullptr;
  Reservation reservation = Reservation::None;
  Flow flow = Flow::None;
  Shape shape = Shape::Box;
  bool usesScratch = false; // works on the space @S
  bool isBuilt() const { return lower != nullptr || flow != Flow::None; }
};

// In the order of the manual.
std::span<const Row> allRows();
std::span<const frontend::InstructionInfo* const> instructionInfos();

// A box by its mnemonic or one of its other spellings, also section (SEC); null for contacts and coils, and when there
// is none.
const Row* findBox(std::string_view mnemonic);
// Its data alone.
const frontend::InstructionInfo* findBoxInfo(std::string_view mnemonic);
// Row of a contact: on a bit or a word, closed or open.
const Row& contactRow(bool onBit, bool closed);
const Row& coilRow(int coilKind); // ladder::CoilKind as a number
// The box that does for doubles what this one does for integers; empty when there is none.
std::string_view doublesOf(std::string_view mnemonic);
// Boxes of other controls.
std::span<const frontend::ForeignWord> foreignWords();

} // namespace rung::frontend::nct
