// Builds a routine (see routine_builder.h).
#include "frontend/dialects/technol/lower/routine_builder.h"

#include <algorithm>

#include "frontend/dialects/technol/read/lexer.h"
#include "ir/support/check.h"
#include "ir/support/hash.h"
#include "rtlib/text/blanks.h"
#include "rung/types.hpp"

namespace rung::frontend::technol {
namespace {

constexpr uint32_t kMaxSourceLines = 100; // per rung; the text of a longer rung is its first line

} // namespace

// Source position of a statement. A statement of a macro has the line of the macro's use.
RungSource sourceOf(const SourceProgram& program, const Statement& statement) {
  const FileId own = program.files[statement.file].id;
  const LineCol at = program.sources.lineCol(statement.pos);
  const bool here = program.sources.fileOf(statement.pos) == own && at.line == statement.line;
  return {.sources = &program.sources,
          .file = own,
          .index = {statement.file},
          .line = statement.line,
          .column = here ? at.column : 1};
}

ir::RungBuilder& RoutineBuilder::b() {
  if (builder_) return *builder_;
  rung_ = ir::Rung{};
  ir::RungBuilder& builder = builder_.emplace(module_, rung_);
  registers_.begin(builder);
  statements_ = 0;
  first_ = current_;
  lastLine_ = current_.line;
  rung_.begin = {.file = current_.index, .line = current_.line, .column = current_.column};
  builder.setLine(current_.line);
  return builder;
}

void RoutineBuilder::statement(const RungSource& source) {
  current_ = source;
  b().setLine(source.line);
  lastLine_ = source.line;
  ++statements_;
}

uint32_t RoutineBuilder::newLabel() {
  labels_.push_back(UINT32_MAX);
  return static_cast<uint32_t>(labels_.size()) - 1;
}

void RoutineBuilder::bind(uint32_t label) {
  cut();
  labels_[label] = static_cast<uint32_t>(module_.routines[routine_.index].rungs.size());
  endIsLabelled_ = true;
}

void RoutineBuilder::cut() {
  if (!builder_) return;
  registers_.flush();
  close();
}

// Sets title (the comment of the first line), source text and key of the rung.
void RoutineBuilder::describe() {
  if (first_.line == 0) return;
  const bool inOrder = lastLine_ >= first_.line && lastLine_ - first_.line < kMaxSourceLines;
  rung_.lastLine = inOrder ? lastLine_ : first_.line;
  for (uint32_t line = first_.line; line <= rung_.lastLine; ++line) {
    const std::string_view text = first_.sources->lineText(first_.file, line);
    if (line == first_.line)
      if (const size_t comment = commentOf(text); comment != std::string_view::npos)
        rung_.title = text::trimmed(text.substr(comment + 1));
    if (!rung_.sourceText.empty()) rung_.sourceText += '\n';
    rung_.sourceText += text::trimmed(text);
  }
  const uint64_t text = hashBytes(rung_.sourceText, hashBytes(module_.routines[routine_.index].name));
  rung_.copy = sameText_[text]++;
  rung_.key = rungKey(text, rung_.copy);
}

void RoutineBuilder::close() {
  describe();
  rung_.weight = std::max(1u, statements_);
  weight_ += rung_.weight;
  module_.routines[routine_.index].rungs.push_back(std::move(rung_));
  builder_.reset();
  endIsLabelled_ = false;
}

void RoutineBuilder::jump(uint32_t label, ir::ValueId cond) {
  ir::RungBuilder& builder = b();
  registers_.flush();
  builder.gotoRung(0, cond);
  fixups_.push_back({static_cast<uint32_t>(module_.routines[routine_.index].rungs.size()), {label}});
  close();
}

void RoutineBuilder::call(ir::RoutineId callee, ir::ValueId cond) {
  ir::RungBuilder& builder = b();
  registers_.flush();
  builder.call(callee, cond);
  close();
}

uint32_t RoutineBuilder::selectLater(ir::ValueId value) {
  ir::RungBuilder& builder = b();
  registers_.flush();
  builder.switchTo(value, {});
  fixups_.push_back({static_cast<uint32_t>(module_.routines[routine_.index].rungs.size()), {}});
  close();
  return static_cast<uint32_t>(fixups_.size()) - 1;
}

void RoutineBuilder::setLabels(uint32_t handle, std::vector<uint32_t> labels) {
  fixups_[handle].labels = std::move(labels);
}

void RoutineBuilder::select(ir::ValueId value, std::vector<uint32_t> labels) {
  setLabels(selectLater(value), std::move(labels));
}

void RoutineBuilder::finish() {
  cut();
  ir::Routine& routine = module_.routines[routine_.index];
  if (endIsLabelled_ || routine.rungs.empty()) routine.rungs.push_back({.lastLine = 0});
  for (const Fixup& fixup : fixups_) {
    ir::Transfer& transfer = routine.rungs[fixup.rung].transfer;
    for (const uint32_t label : fixup.labels) {
      const uint32_t rung = labels_[label];
      if (transfer.kind == ir::TransferKind::Goto)
        transfer.target = rung;
      else
        transfer.targets.push_back(rung);
    }
  }
}

} // namespace rung::frontend::technol
