// Builds one routine, rung by rung: registers are written back at the end of a rung, jumps go to labels that may be
// bound later.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/technol/lower/registers.h"
#include "frontend/dialects/technol/program.h"
#include "ir/support/source.h"

namespace rung::frontend::technol {

// Positions of a rung's statements in the sources.
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
  // The open rung; opens one if there is none.
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
  // Number in the routine of the open rung, or of the next one.
  uint32_t openRung() const { return static_cast<uint32_t>(module_.routines[routine_.index].rungs.size()); }
  bool isOpen() const { return builder_.has_value(); }
  // Number of statements in the open rung.
  uint32_t length() const { return builder_ ? statements_ : 0; }

  uint32_t newLabel();
  // Binds the label to the next rung.
  void bind(uint32_t label);
  // Ends the open rung, if there is one; control continues below.
  void cut();
  // End the rung with a transfer; with a condition of 0 the rung below follows.
  void jump(uint32_t label, ir::ValueId cond = {});
  void call(ir::RoutineId callee, ir::ValueId cond = {});
  void select(ir::ValueId value, std::vector<uint32_t> labels);
  // A Switch whose labels are set later; returns a handle for setLabels.
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
  std::optional<ir::RungBuilder> builder_; // set while a rung is open
  RungSource current_;                     // of the statement that is being lowered
  RungSource first_;                       // first statement of the open rung
  uint32_t statements_ = 0;
  uint32_t lastLine_ = 0;
  std::vector<uint32_t> labels_; // by label: its rung
  std::vector<Fixup> fixups_;
  bool endIsLabelled_ = false;
  std::unordered_map<uint64_t, uint32_t> sameText_; // number of rungs with each text so far
  uint64_t weight_ = 0;
};

} // namespace rung::frontend::technol
