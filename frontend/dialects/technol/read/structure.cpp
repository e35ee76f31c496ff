// Modules and units of a file (see structure.h).
#include "frontend/dialects/technol/read/structure.h"

#include <algorithm>

#include "ir/support/diag/structure.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {
namespace {

std::string endName(ModuleKind kind) { return std::string(moduleName(kind)) + "_END"; }

// §12.1: modules that the main file must contain, and modules that only the main file may contain.
constexpr ModuleKind kMandatory[] = {ModuleKind::Data, ModuleKind::Input, ModuleKind::BlockInit, ModuleKind::BlockDone,
                                     ModuleKind::Main, ModuleKind::Init,  ModuleKind::Clear,     ModuleKind::Halt};
constexpr ModuleKind kMainOnly[] = {ModuleKind::Input, ModuleKind::BlockInit, ModuleKind::BlockDone, ModuleKind::Halt,
                                    ModuleKind::Cont};

bool isOneOf(ModuleKind kind, std::span<const ModuleKind> kinds) {
  return std::ranges::find(kinds, kind) != kinds.end();
}

} // namespace

void Structure::push(Unit unit) {
  unit.parent = unit_;
  unit_ = {static_cast<uint32_t>(program_.units.size())};
  program_.units.push_back(unit);
}

void Structure::checkPlace(const Statement& statement, ModuleKind kind) {
  bool& seen = seen_[static_cast<size_t>(kind)];
  if (kind != ModuleKind::Data && !seen_[0] && !dataReported_) {
    dataReported_ = true;
    c_.report(diag::DataNotFirst, statement.range());
  }
  if (seen) c_.report(diag::DuplicateModule, statement.range()) << moduleName(kind);
  if (isOneOf(kind, kMainOnly) && !program_.files[file_].main)
    c_.report(diag::ModuleNotAllowed, statement.range()) << moduleName(kind);
  seen = true;
}

void Structure::beginModule(const Statement& statement, ModuleKind kind, uint32_t index) {
  nested_ = inModule();
  if (nested_) {
    outer_ = this->kind();
    reportUnclosed(statement.range());
    closeModule(statement.range(), statement.line, index);
  }
  closeLocal(statement.range());
  outsideReported_ = false;
  checkPlace(statement, kind);
  push({.kind = UnitKind::Module, .module = kind, .name = moduleName(kind), .begin = statement.range()});
  part_ = static_cast<uint32_t>(program_.parts.size());
  program_.parts.push_back({.kind = kind, .file = file_, .unit = unit_, .firstStatement = index});
}

void Structure::reportUnclosed(SourceRange at) {
  const Unit& module = program_.at(program_.parts[part_].unit);
  c_.report(diag::ModuleNotClosed, at).note(module.begin, "it begins here") << moduleName(kind()) << endName(kind());
}

void Structure::endModule(const Statement& statement, ModuleKind kind_, uint32_t index) {
  if (!inModule()) {
    if (nested_ && kind_ != outer_) outsideReported_ = false;
    allowsCode(statement);
    return;
  }
  if (kind() != kind_) reportUnclosed(statement.range());
  closeModule(statement.range(), statement.line, index);
  outsideReported_ = nested_; // the following statements belong to the outer module
}

void Structure::closeModule(SourceRange at, uint32_t line, uint32_t index) {
  closeLocal(at);
  closeUnits(at);
  ModulePart& part = program_.parts[part_];
  part.end = at;
  part.endLine = line;
  part.endStatement = index;
  part_ = kNone;
  unit_ = {};
}

// Closes all units inside the module, innermost first; only the innermost one is reported as unclosed.
void Structure::closeUnits(SourceRange at) {
  bool reported = false;
  while (program_.at(unit_).kind != UnitKind::Module) {
    if (!reported || program_.at(unit_).kind == UnitKind::Timed)
      closeUnit(at);
    else
      unit_ = program_.at(unit_).parent;
    reported = true;
  }
}

void Structure::closeUnit(SourceRange at) {
  const Unit& unit = program_.at(unit_);
  switch (unit.kind) {
  case UnitKind::Mechanism: c_.report(diag::MechNotClosed, at).note(unit.begin, "it begins here") << unit.name; break;
  case UnitKind::Procedure: c_.report(diag::ProcNotClosed, at).note(unit.begin, "it begins here") << unit.name; break;
  case UnitKind::Timed: lostBlocks_.push_back({program_.tokens[unit.endLabel], unit_}); break;
  case UnitKind::Module: break;
  }
  unit_ = unit.parent;
}

void Structure::beginLocal(const Statement& statement) {
  closeLocal(statement.range());
  localOpen_ = true;
}

void Structure::endLocal(const Statement& statement) {
  if (!localOpen_) c_.report(diag::SyntaxError, statement.range()) << "DATA_LOCAL" << "DATA_LOCAL_END";
  localOpen_ = false;
}

void Structure::closeLocal(SourceRange at) {
  if (localOpen_) c_.report(diag::ModuleNotClosed, at) << "DATA_LOCAL" << "DATA_LOCAL_END";
  localOpen_ = false;
}

void Structure::stop(const Statement& statement, uint32_t index) {
  if (inModule()) {
    reportUnclosed(statement.range());
    closeModule(statement.range(), statement.line, index);
  }
  closeLocal(statement.range());
  stopped_ = true;
}

void Structure::beginMechanism(const Statement& statement, const Token& name) {
  const UnitId outer = program_.owner(unit_);
  if (program_.inMechanism(unit_))
    c_.report(diag::NestedMechanism, statement.range()).note(program_.at(outer).begin, "it begins here")
        << program_.at(outer).name;
  const auto index = static_cast<uint32_t>(program_.mechanisms.size());
  push({.kind = UnitKind::Mechanism, .index = index, .name = name.text, .begin = statement.range()});
  program_.mechanisms.push_back({.name = name.text, .unit = unit_});
}

UnitId Structure::innermost(UnitKind kind) const {
  UnitId unit = unit_;
  while (unit.valid() && program_.at(unit).kind != kind) unit = program_.at(unit).parent;
  return unit;
}

// Ends a unit; units that are still open inside it end here as well.
bool Structure::endUnit(const Statement& statement, const Token& name, UnitKind kind) {
  const bool mechanism = kind == UnitKind::Mechanism;
  const Diag mismatch = mechanism ? diag::MechNameMismatch : diag::ProcNameMismatch;
  const UnitId open = innermost(kind);
  if (!open.valid()) {
    c_.report(mismatch, statement.range()) << name.text << (mechanism ? "no mechanism" : "no procedure");
    return false;
  }
  while (unit_ != open) closeUnit(statement.range());
  const Unit& unit = program_.at(unit_);
  if (symbolKey(unit.name) != symbolKey(name.text))
    c_.report(mismatch, name.range()).note(unit.begin, "it begins here")
        << name.text << "'" + std::string(unit.name) + "'";
  unit_ = unit.parent;
  return true;
}

void Structure::beginProcedure(const Statement& statement, const Token& name) {
  if (const UnitId outer = innermost(UnitKind::Procedure); outer.valid())
    c_.report(diag::NestedProcedure, statement.range()).note(program_.at(outer).begin, "it begins here")
        << program_.at(outer).name;
  const auto index = static_cast<uint32_t>(program_.procedures.size());
  push({.kind = UnitKind::Procedure, .index = index, .name = name.text, .begin = statement.range()});
  program_.procedures.push_back({.name = name.text, .unit = unit_});
}

void Structure::beginTimed(const Statement& statement, const Token& endLabel) {
  if (unit_.valid() && program_.at(unit_).kind == UnitKind::Timed) innerBlocks_.push_back({unit_, statement.range()});
  push({.kind = UnitKind::Timed,
        .name = statement.row->info.mnemonic,
        .endLabel = static_cast<uint32_t>(&endLabel - program_.tokens.data()),
        .begin = statement.range()});
}

void Structure::passLabel(std::string_view name) {
  const std::string key = symbolKey(name);
  UnitId found;
  for (UnitId at = unit_; at.valid() && program_.at(at).kind == UnitKind::Timed; at = program_.at(at).parent)
    if (symbolKey(program_.tokens[program_.at(at).endLabel].text) == key) found = at;
  if (!found.valid()) return;
  while (unit_ != found) closeUnit({});
  // Inner blocks are reported only if their outer block has an end; otherwise the missing end is the error.
  std::erase_if(innerBlocks_, [&](const InnerBlock& inner) {
    if (inner.outer != found) return false;
    c_.report(diag::SyntaxError, inner.at).note(program_.at(found).begin, "it begins here")
        << "label '" + std::string(name) + "', which ends the timed block," << "a timed block inside it";
    return true;
  });
  unit_ = program_.at(found).parent;
}

bool Structure::fits(const Row& row) const {
  const bool inCode = inModule() && !inData();
  switch (row.role) {
  case Role::Module: return !inModule() && !localOpen_;
  case Role::ModuleEnd: return inModule() && kind() == static_cast<ModuleKind>(row.variant);
  case Role::Stop: return !inModule();
  case Role::Local: return !localOpen_;
  case Role::LocalEnd: return localOpen_;
  case Role::Dfm:
  case Role::Ds:
  case Role::Str: return localOpen_ || inData();
  case Role::Equi: return true;
  case Role::MechBegin:
  case Role::ProcBegin: return inCode;
  case Role::MechEnd: return innermost(UnitKind::Mechanism).valid();
  case Role::ProcEnd: return innermost(UnitKind::Procedure).valid();
  default: return false;
  }
}

bool Structure::allowsCode(const Statement& statement) {
  if (localOpen_ && !inData()) closeLocal(statement.range());
  if (inModule() && !inData()) return true;
  if (!outsideReported_) {
    DiagBuilder report = c_.report(diag::CodeOutsideModule, statement.range());
    report << statement.row->info.mnemonic;
    if (inData()) report.note("DATA has declarations alone; instructions belong in a module such as MODULE_MAIN");
    if (inData() && statement.row->info.mnemonic == "MECH_INIT") report.note("a mechanism is declared by MECH_BEGIN");
  }
  outsideReported_ = true;
  return false;
}

bool Structure::allowsData(const Statement& statement) {
  if (localOpen_ || inData()) return true;
  c_.report(diag::DeclarationOutsideData, statement.range()) << statement.row->info.mnemonic;
  return false;
}

void Structure::checkMissing() {
  const SourceFile& file = program_.files[file_];
  if (!seen_[0] && !dataReported_) c_.report(diag::DataNotFirst, file.lastLine);
  std::string missing;
  size_t count = 0;
  for (int i = 1; i < kModuleKinds; ++i) {
    const auto kind = static_cast<ModuleKind>(i);
    const bool needed = file.main ? isOneOf(kind, kMandatory) : kind == ModuleKind::Main;
    if (!needed || seen_[static_cast<size_t>(i)]) continue;
    missing.append(count++ == 0 ? "" : ", ").append(moduleName(kind));
  }
  if (count != 0)
    c_.report(diag::MissingModule, file.lastLine) << (count == 1 ? "a module is" : "modules are") << missing;
  if (file.main && !stopped_) c_.report(diag::MissingStop, file.lastLine);
}

void Structure::finish(uint32_t statementCount) {
  const SourceRange last = program_.files[file_].lastLine;
  if (inModule()) {
    reportUnclosed(last);
    program_.parts[part_].cut = true;
    closeModule(last, program_.files[file_].lineCount, statementCount);
  }
  closeLocal(last);
  checkMissing();
  // A block whose label is elsewhere leaves its unit; one without a label, or with an earlier label, has no end.
  for (const OpenBlock& block : lostBlocks_) {
    const uint32_t symbol = c_.symbols.find(block.label.text, file_);
    const bool later = symbol != kNone && c_.symbols[symbol].kind == SymbolKind::Label &&
                       block.label.pos < c_.symbols[symbol].declared.begin;
    if (symbol != kNone && c_.symbols[symbol].kind != SymbolKind::Label) continue; // the operand check reports it
    if (symbol == kNone)
      c_.symbols.noteUndefined(block.label, file_, {});
    else if (!later)
      c_.report(diag::SyntaxError, block.label.range()).note(c_.symbols[symbol].declared, "the label")
          << "label '" + std::string(block.label.text) + "' below this statement" << "it above";
    else
      c_.report(diag::JumpCrossesUnit, block.label.range()) << block.label.text << "the unit of this timed block";
  }
}

} // namespace rung::frontend::technol
