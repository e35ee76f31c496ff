// Builds one routine, rung by rung: registers are written back where a rung ends, jumps go to labels that may be bound
// later.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/technol/lower/registers.h"
#include "frontend/dialects/technol/program.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

// Where the statements of a rung are in the sources.
struct RungSource {
  const SourceManager* sources = nullptr;
  FileId file;
  ir::FileIndex index;
  uint32_t line = 0;
  uint32_t column = 0;
};

RungSource sourceOf(const SourceProgram& program, const Statement& statement);

class RoutineBuilder {
public:
  RoutineBuilder(ir::Module& module, ir::RoutineId routine, const RegisterSlots& slots)
      : module_(module), routine_(routine), registers_(slots) {}

  ir::RoutineId routine() const { return routine_; }
  // The open rung; opens one.
  ir::RungBuilder& b();
  Registers& registers() {
    b();
    return registers_;
  }
  // The next operations belong to this statement.
  void statement(const RungSource& source);
  // The next rungs are the compiler's own, up to the next statement.
  void beginOwn() {
    cut();
    current_ = {};
  }
  // Number of the rung in the routine that is open or comes next.
  uint32_t openRung() const { return static_cast<uint32_t>(module_.routines[routine_.index].rungs.size()); }
  bool isOpen() const { return builder_.has_value(); }
  // Statements in the open rung.
  uint32_t length() const { return builder_ ? statements_ : 0; }

  uint32_t newLabel();
  // The next rung is the label's.
  void bind(uint32_t label);
  // Ends the open rung, if there is one; control continues below.
  void cut();
  // Ends of the rung with a transfer; with a condition the rung below follows when it is 0.
  void jump(uint32_t label, ir::ValueId cond = {});
  void call(ir::RoutineId callee, ir::ValueId cond = {});
  void select(ir::ValueId value, std::vector<uint32_t> labels);
  // A Switch whose labels come later; gives a handle for setLabels.
  uint32_t selectLater(ir::ValueId value);
  void setLabels(uint32_t handle, std::vector<uint32_t> labels);
  // Closes the routine and resolves its jumps.
  void finish();
  uint64_t weight() const { return weight_; }

private:
  struct Fixup {
    uint32_t rung;
    std::vector<uint32_t> labels; // one for a Goto
  };

  void close();
  void describe();

  ir::Module& module_;
  ir::RoutineId routine_;
  Registers registers_;
  ir::Rung rung_;
  std::optional<ir::RungBuilder> builder_; // while the rung is open
  RungSource current_;                     // of the statement that is being lowered
  RungSource first_;                       // of the open rung's first
  uint32_t statements_ = 0;
  uint32_t lastLine_ = 0;
  std::vector<uint32_t> labels_; // the rung of each
  std::vector<Fixup> fixups_;
  bool endIsLabelled_ = false;
  std::unordered_map<uint64_t, uint32_t> sameText_; // rungs of each text so far
  uint64_t weight_ = 0;
};

} // namespace rung::frontend::technol
