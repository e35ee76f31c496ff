// The structure of a file while it is read: the open module, mechanism, procedure and timed block (man. ch. 5). It
// reports mistakes and continues with the most likely meaning, so that one mistake gives one report.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "frontend/dialects/technol/read/read_context.h"

namespace rung::frontend::technol {

class Structure {
public:
  Structure(ReadContext& context, uint32_t file) : c_(context), program_(context.program), file_(file) {}

  // Statements that open and close; `index` is the statement's number.
  void beginModule(const Statement& statement, ModuleKind kind, uint32_t index);
  void endModule(const Statement& statement, ModuleKind kind, uint32_t index);
  void beginLocal(const Statement& statement);
  void endLocal(const Statement& statement);
  void stop(const Statement& statement, uint32_t index);
  void beginMechanism(const Statement& statement, const Token& name);
  // False if none was open.
  bool endMechanism(const Statement& statement, const Token& name) {
    return endUnit(statement, name, UnitKind::Mechanism);
  }
  void beginProcedure(const Statement& statement, const Token& name);
  bool endProcedure(const Statement& statement, const Token& name) {
    return endUnit(statement, name, UnitKind::Procedure);
  }
  void beginTimed(const Statement& statement, const Token& endLabel);
  // A label ends the timed blocks that name it.
  void passLabel(std::string_view name);
  // Reports what is missing at the end of the file.
  void finish(uint32_t statementCount);

  // Whether a statement that opens, closes or declares something is right here, as far as that is known.
  bool fits(const Row& row) const;
  // Whether an executable statement is allowed here; otherwise reports.
  bool allowsCode(const Statement& statement);
  // Whether a declaration is allowed here; otherwise reports.
  bool allowsData(const Statement& statement);

  UnitId unit() const { return unit_; }
  bool stopped() const { return stopped_; }
  bool inModule() const { return part_ != kNone; }
  bool localOpen() const { return localOpen_; }
  bool inData() const { return inModule() && kind() == ModuleKind::Data; }
  // Whether names declared here are local to this file.
  bool isLocal() const { return localOpen_ || !inData(); }

private:
  ModuleKind kind() const { return program_.parts[part_].kind; }
  void closeModule(SourceRange at, uint32_t line, uint32_t index);
  void closeUnits(SourceRange at);
  void closeUnit(SourceRange at);
  UnitId innermost(UnitKind kind) const;
  bool endUnit(const Statement& statement, const Token& name, UnitKind kind);
  void closeLocal(SourceRange at);
  void push(Unit unit);
  void reportUnclosed(SourceRange at);
  void checkPlace(const Statement& statement, ModuleKind kind);
  void checkMissing();

  ReadContext& c_;
  SourceProgram& program_;
  uint32_t file_;
  uint32_t part_ = kNone; // the open one
  UnitId unit_;
  bool localOpen_ = false;
  bool stopped_ = false;
  bool outsideReported_ = false;
  bool nested_ = false; // the module is inside of another one, outer_
  ModuleKind outer_ = ModuleKind::Data;
  bool dataReported_ = false;
  std::array<bool, kModuleKinds> seen_{};
  struct OpenBlock {
    Token label;
    UnitId unit;
  };
  struct InnerBlock {
    UnitId outer;
    SourceRange at;
  };
  std::vector<InnerBlock> innerBlocks_; // timed blocks inside of another one
  std::vector<OpenBlock> lostBlocks_;   // timed blocks whose label did not follow in time
};

} // namespace rung::frontend::technol
