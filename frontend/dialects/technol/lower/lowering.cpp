// The walk over a program's modules (see lowering.h).
#include "frontend/dialects/technol/lower/lowering.h"

#include <algorithm>

#include "frontend/dialects/technol/lower/lower.h"
#include "ir/support/hash.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/licences.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// A rung of data instructions is cut at the next load when it has grown to this many statements.
constexpr uint32_t kLongRung = 12;
constexpr uint32_t kLongestRung = 48;

constexpr HostCellInfo kHostCellInfos[kHostCells] = {
    {"@DR", Type::I64, 0},
    {"@RLO", Type::Bit, 8},
    {"@BLOCK_INIT.CONT", Type::I32, 12},
    {"@BLOCK_INIT.DONE", Type::Bit, 16},
    {"@BLOCK_DONE.CONT", Type::I32, 20},
    {"@BLOCK_DONE.DONE", Type::Bit, 24},
    {"@INIT.PENDING", Type::I64, 32},
    {"@DONE.PENDING", Type::I64, 40},
    {nc::kLicenceCell, Type::I32, 28},
};

// What the control presets when MODULE_INIT starts (man. l.6186, l.6316).
constexpr std::string_view kPresets[] = {"MPXPI", "MPYPI", "MPZPI", "VAZBA_X", "VAZBA_Y", "VAZBA_Z"};
constexpr std::string_view kNumberedPresets[] = {"MP#PI", "VAZBA_#"};

} // namespace

const HostCellInfo& hostCell(HostCell cell) { return kHostCellInfos[static_cast<size_t>(cell)]; }

Lowering::Lowering(const Program& program, const TypedProgram& typed, ir::Module& module, uint32_t periodUs,
                   ir::Marks* marks)
    : program_(program), typedProgram_(typed), module_(module), periodUs_(periodUs), marks_(marks),
      slots_(makeRegisterSlots(module)) {
  codeLabels_.assign(program.labels.size(), kNone);
  for (const Mechanism& mechanism : program.mechanisms) {
    const uint32_t index = static_cast<uint32_t>(module.slots.size());
    module.slots.push_back({.type = Type::I32, .key = "MECH." + symbolKey(mechanism.name) + ".CONT"});
    contSlots_.push_back({index});
    const uint32_t byte = static_cast<uint32_t>(contSlots_.size() - 1) * kMechanismBytes;
    nameCells("@MECH." + symbolKey(mechanism.name), kMechanismSpace, byte, Type::Bit);
    nameCells("@MECH." + symbolKey(mechanism.name) + ".LINE", kMechanismSpace, byte + 1, Type::I16);
  }
  resets_.resize(program.mechanisms.size());
  resetCells_.resize(program.mechanisms.size());
  for (const Procedure& procedure : program.procedures)
    procedureRoutines_.push_back(newRoutine("PROC " + symbolKey(procedure.name)));
}

ir::RoutineId Lowering::newRoutine(std::string name) {
  module_.routines.push_back({.name = std::move(name)});
  return {static_cast<uint32_t>(module_.routines.size()) - 1};
}

std::unique_ptr<RoutineBuilder> Lowering::newBuilder(ir::RoutineId routine) {
  return std::make_unique<RoutineBuilder>(module_, routine, slots_);
}

ir::FaultId Lowering::fault(std::string_view text) {
  const auto [entry, isNew] = faults_.emplace(text, ir::FaultId{static_cast<uint32_t>(module_.faults.size())});
  if (isNew) module_.faults.emplace_back(text);
  return entry->second;
}

ir::ServiceId Lowering::service(std::string_view signature) {
  const auto found = std::find(module_.services.begin(), module_.services.end(), signature);
  const auto index = static_cast<uint32_t>(found - module_.services.begin());
  if (found == module_.services.end()) module_.services.emplace_back(signature);
  return {index};
}

RungSource Lowering::sourceOf(const Statement& statement) const {
  const FileId file = program_.sources.fileOf(statement.pos);
  // A statement of a macro has its own text elsewhere; it counts in the line of the use.
  const LineCol at = program_.sources.lineCol(statement.pos);
  const bool here = file == program_.files[statement.file].id && at.line == statement.line;
  return {.sources = &program_.sources,
          .file = program_.files[statement.file].id,
          .index = {statement.file},
          .line = statement.line,
          .column = here ? at.column : 1};
}

// ---- modules --------------------------------------------------------------------------------------------------------

void Lowering::run() {
  start_ = newRoutine("@START");
  findTimed();
  fault(nc::kTechnolRequested); // by the control (man. l.5361)
  onMessage_ = program_.procedureNamed(kOnMessage);
  for (int i = 1; i < kModuleKinds; ++i) lowerModule(static_cast<ModuleKind>(i));
  finishProcedures();
  makeClears();
  makeResets();
  makeBitMessages();
  makeStart();
  makeEvents();
}

void Lowering::lowerModule(ModuleKind kind) {
  kind_ = kind;
  // The end of the shutdown may be pending in a program without MODULE_DONE.
  bool present = kind == ModuleKind::Done && filesOwing(&SourceFile::finishesDone) != 0;
  for (const ModulePart& part : program_.parts) present = present || part.kind == kind;
  if (!present) return;
  const ir::RoutineId routine = newRoutine(std::string(moduleName(kind)));
  out_ = newBuilder(routine);
  prologue(kind);
  for (const ModulePart& part : program_.parts)
    if (part.kind == kind) lowerPart(part, kind);
  leaveClock(kind);
  out_->finish();
  modules_.push_back({kind, routine, out_->weight()});
  out_.reset();
}

int64_t Lowering::filesOwing(bool SourceFile::* finishes) const {
  uint64_t mask = 0;
  for (size_t i = 0; i < program_.files.size(); ++i)
    if (program_.files[i].*finishes) mask |= uint64_t{1} << i;
  return static_cast<int64_t>(mask);
}

// What the compiler adds before a module.
void Lowering::prologue(ModuleKind kind) {
  if (kind == ModuleKind::Init) out_->call(start_);
  if (kind == ModuleKind::Done) {
    b().store(place(HostCell::DoneOwed), b().constant(Type::I64, filesOwing(&SourceFile::finishesDone)));
    out_->cut();
  }
  enterClock(kind);
}

void Lowering::enterPart(const ModulePart& part, ModuleKind kind) {
  const Unit& unit = program_.units[part.unit];
  Statement begin{.pos = unit.begin.begin, .file = part.file};
  begin.line = program_.sources.lineCol(begin.pos).line;
  out_->cut();
  out_->statement(sourceOf(begin));
  // RLO and DR are 0 where the manual leaves them open; INIT and DONE learn in DR why they run (man. l.2567, l.2613).
  r().clear();
  if (kind == ModuleKind::Init || kind == ModuleKind::Done) r().setDr(b().load(Type::I64, place(HostCell::Dr)));
}

void Lowering::lowerPart(const ModulePart& part, ModuleKind kind) {
  enterPart(part, kind);
  const bool sequential = kind == ModuleKind::BlockInit || kind == ModuleKind::BlockDone;
  if (sequential) beginSequence(kNone, part.unit);
  for (uint32_t i = part.firstStatement; i < part.endStatement && i < program_.statements.size(); ++i)
    lowerStatement(program_.statements[i], i);
  if (sequential) endSequence();
}

// ---- statements -----------------------------------------------------------------------------------------------------

void Lowering::bindLabels(const Statement& statement, uint32_t index) {
  for (uint32_t i = statement.label; i < program_.labels.size() && program_.labels[i].statement == index; ++i) {
    if (codeLabels_[i] == kNone) codeLabels_[i] = out_->newLabel();
    out_->bind(codeLabels_[i]);
  }
}

void Lowering::lowerStatement(const Statement& statement, uint32_t index) {
  statement_ = &statement;
  typed_ = &typedProgram_.statements[index];
  if (statement.label != kNone) bindLabels(statement, index);
  if (Sequence* s = ownSequence()) {
    s->section = hashBytes(instructionKey(statement.row->info.mnemonic), s->sectionEnds ? 0 : s->section);
    s->sectionEnds = false;
  }
  switch (statement.row->role) {
  case Role::Code: return lowerCode();
  case Role::MechBegin: return beginMechanism();
  case Role::MechEnd: return endMechanism();
  case Role::ProcBegin: return beginProcedure();
  case Role::ProcEnd: return endProcedure();
  case Role::Timed: return beginTimed();
  case Role::MacroBegin: return applyStack(typed_->stack);
  default: return; // nothing that runs
  }
}

void Lowering::lowerCode() {
  const Row& row = *statement_->row;
  beginRungFor(row);
  out_->statement(sourceOf(*statement_));
  applyStack(typed_->stack);
  if (marks_ != nullptr) markDecision(row);
  const uint32_t rung = out_->openRung();
  row.lower(*this, typedProgram_.operandsOf(*typed_), row.variant);
  if (marks_ != nullptr) markResult(row, rung);
}

// ---- marks ----------------------------------------------------------------------------------------------------------

void Lowering::mark(ir::MarkKind kind, ValueId value) {
  if (marks_ == nullptr) return;
  const RungSource at = sourceOf(*statement_);
  std::string text(statement_->row->info.mnemonic);
  if (statement_->tokenCount != 0) text.append(" ").append(spelled(program_.operandTokens(*statement_)));
  marks_->add(out_->routine(), out_->openRung(), {kind, value, at.line, at.column, std::move(text)});
}

ValueId Lowering::contact(const Operand& operand) {
  const ValueId value = bit(operand);
  mark(ir::MarkKind::Contact, value);
  return value;
}

namespace {

// What only joins values of the equation: LA, LO and LX, whose bits are contacts, and CA.
bool isLogic(const Row& row) {
  constexpr uint16_t kBoth = kReadsRlo | kSetsRlo;
  return (row.effects & kJoins) != 0 || (row.info.group == "bit logic" && (row.effects & kBoth) == kBoth);
}

} // namespace

// What an instruction does by RLO is what the equation decides.
void Lowering::markDecision(const Row& row) {
  if ((row.effects & kReadsRlo) == 0 || isLogic(row)) return;
  const bool coil = row.info.group == "bit write";
  mark(coil ? ir::MarkKind::Coil : ir::MarkKind::Input, r().rlo());
}

// RLO of a comparison, an edge or a timer, as far as the rung continues: contacts have marked themselves.
void Lowering::markResult(const Row& row, uint32_t rung) {
  const bool asksBit = row.lower == &lowerLoadBit;
  if ((row.effects & kSetsRlo) == 0 || isLogic(row) || asksBit || !out_->isOpen() || out_->openRung() != rung) return;
  mark(ir::MarkKind::Result, r().rlo());
}

// An equation begins its own rung; long runs of data instructions are cut where a value is loaded.
void Lowering::beginRungFor(const Row& row) {
  const bool loads = (row.effects & kPushes) != 0 || row.info.mnemonic == "LOD";
  const bool begins = typed_->stack.begins && out_->length() > 0;
  if (begins || (loads && out_->length() >= kLongRung) || out_->length() >= kLongestRung) out_->cut();
}

void Lowering::applyStack(const StackUse& use) {
  if (use.pushed != kNone) r().setStack(use.pushed, r().rlo());
  popped_ = use.popped == kNone ? ValueId{} : r().stack(use.popped);
}

// ---- the compiler's own routines
// -------------------------------------------------------------------------------------

void Lowering::finishProcedures() {
  for (const ir::RoutineId routine : procedureRoutines_)
    if (module_.routines[routine.index].rungs.empty()) module_.routines[routine.index].rungs.push_back({});
}

// Clears the counts of a mechanism, for MECH_INIT.
void Lowering::makeResets() {
  for (size_t i = 0; i < resets_.size(); ++i) {
    if (!resets_[i].valid()) continue;
    out_ = newBuilder(resets_[i]);
    for (const CountCell& cell : resetCells_[i]) storeCount(cell, b().constant(cell.type, 0));
    out_->finish();
  }
}

// Runs before MODULE_INIT: edges are recorded anew (man. l.300), the periods of timed blocks begin, presets of
// the interface.
void Lowering::makeStart() {
  constexpr size_t kStoresPerRung = 64;
  out_ = newBuilder(start_);
  b().store(place(HostCell::InitOwed), b().constant(Type::I64, filesOwing(&SourceFile::finishesInit)));
  b().store(place(HostCell::DoneOwed), b().constant(Type::I64, 0));
  const ValueId one = b().bit(true);
  const auto preset = [&](std::string_view name) {
    const nc::Signal* signal = nc::findSignal(nc::technolSignals(), name, "I");
    if (signal) b().store({.space = kInterfaceSpace, .byte = signal->byteOffset, .bit = signal->bit}, one);
  };
  for (std::string_view name : kPresets) preset(name);
  for (std::string_view pattern : kNumberedPresets)
    for (int axis = 4; axis <= 16; ++axis) {
      std::string name(pattern);
      preset(name.replace(name.find('#'), 1, std::to_string(axis)));
    }
  for (size_t i = 0; i < forgotten_.size(); ++i) {
    if (i % kStoresPerRung == 0) out_->cut();
    b().slotStore(forgotten_[i], b().constant(Type::I8, 0));
  }
  clearSlots(phases_);
  forgetBitMessages();
  out_->finish();
}

// Tasks for the procedures that the control calls (man. l.1614-1644): RLO and DR come from the host.
void Lowering::makeEvents() {
  for (const std::string_view name : {"_ON_CMD", "_ON_EVENT"}) {
    const uint32_t procedure = program_.procedureNamed(name);
    if (procedure == kNone) continue;
    const ir::RoutineId routine = newRoutine("@" + std::string(name));
    out_ = newBuilder(routine);
    r().clear();
    r().setRlo(b().load(Type::Bit, place(HostCell::Rlo)));
    r().setDr(b().load(Type::I64, place(HostCell::Dr)));
    callEvent(procedureRoutines_[procedure]);
    out_->finish();
    events_.push_back({ModuleKind::Main, routine, 1});
    eventNames_.emplace_back(name);
  }
}

} // namespace rung::frontend::technol
