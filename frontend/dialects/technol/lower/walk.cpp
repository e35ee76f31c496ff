// Visits the modules of a program and lowers them (see walk.h).
#include "frontend/dialects/technol/lower/walk.h"

#include "rtlib/nc/faults.h"

namespace rung::frontend::technol {

using ir::Type;

namespace {

// A rung of data instructions with this many statements ends at the next load; kLongestRung ends it in any case.
constexpr uint32_t kLongRung = 12;
constexpr uint32_t kLongestRung = 48;

bool isSequential(ModuleKind kind) { return kind == ModuleKind::BlockInit || kind == ModuleKind::BlockDone; }

} // namespace

Walk::Walk(const TypedProgram& program, ir::Module& module, uint32_t periodUs, ir::Marks* marks,
           ir::GivenNumbers* given)
    : program_(program), source_(program.source), l_(program, module, marks, given),
      start_(l_.emitter.newRoutine("@START")), clocks_(source_, l_.emitter, l_.state, periodUs) {
  trace_.statements.resize(source_.statements.size());
  l_.emitter.fault(nc::kTechnolRequested); // the control stops the program with this fault (man. l.5361)
}

LoweredProgram Walk::run() {
  for (int i = 1; i < kModuleKinds; ++i) module(static_cast<ModuleKind>(i));
  l_.clears.make();
  l_.sequences.makeResets();
  made_.bitMessages = l_.bitMessages.makeTask(made_.bitMessagesWeight);
  makeStart(source_, l_.emitter, start_, l_.state, clocks_, l_.bitMessages);
  made_.events = makeEvents(source_, l_.emitter, l_.procedures, clocks_);
  return std::move(made_);
}

Trace Walk::takeTrace() {
  trace_.sequences = l_.sequences.takeTrace();
  return std::move(trace_);
}

// ---- modules --------------------------------------------------------------------------------------------------------

void Walk::module(ModuleKind kind) {
  kind_ = kind;
  // A program without MODULE_DONE may still have to report the end of the shutdown.
  bool present = kind == ModuleKind::Done && source_.filesWith(&SourceFile::finishesDone) != 0;
  for (const ModulePart& p : source_.parts) present = present || p.kind == kind;
  if (!present) return;
  const ir::RoutineId routine = l_.emitter.newRoutine(std::string(moduleName(kind)));
  l_.emitter.open(routine);
  prologue(kind);
  for (const ModulePart& p : source_.parts)
    if (p.kind == kind) part(p);
  clocks_.leave(kind);
  const uint64_t weight = l_.emitter.close();
  made_.modules.push_back({kind, routine, weight});
}

// Code that the compiler adds before a module.
void Walk::prologue(ModuleKind kind) {
  if (kind == ModuleKind::Init) l_.emitter.out().call(start_);
  if (kind == ModuleKind::Done) {
    l_.b().store(place(HostCell::DonePending),
                 l_.b().constant(Type::I64, source_.filesWith(&SourceFile::finishesDone)));
    l_.emitter.out().cut();
  }
  clocks_.enter(kind);
}

// RLO and DR are 0 if the manual leaves them undefined; INIT and DONE get the reason for their run in DR (man. l.2567,
// l.2613).
void Walk::enterPart(const ModulePart& part) {
  Statement begin{.pos = source_.at(part.unit).begin.begin, .file = part.file};
  begin.line = source_.sources.lineCol(begin.pos).line;
  beginAt(begin);
  l_.r().clear();
  if (part.kind == ModuleKind::Init || part.kind == ModuleKind::Done)
    l_.r().setDr(l_.b().load(Type::I64, place(HostCell::Dr)));
}

// Its last rung is that of the line that ends it.
void Walk::endPart(const ModulePart& part) {
  Statement end{.pos = part.end.begin, .file = part.file};
  end.line = part.endLine;
  beginAt(end);
  l_.sequences.end();
}

void Walk::part(const ModulePart& part) {
  enterPart(part);
  if (isSequential(part.kind)) l_.sequences.beginModule(part.kind, part.unit);
  for (uint32_t i = part.firstStatement; i < part.endStatement && i < source_.statements.size(); ++i) statement(i);
  if (isSequential(part.kind)) endPart(part);
}

// ---- statements -----------------------------------------------------------------------------------------------------

void Walk::bindLabels(uint32_t index) {
  const uint32_t first = source_.statements[index].label;
  for (uint32_t i = first; i < source_.labels.size() && source_.labels[i].statement == index; ++i)
    l_.emitter.out().bind(l_.labelOf(i));
}

void Walk::statement(uint32_t index) {
  const Statement& statement = source_.statements[index];
  const Typed& typed = program_.statements[index];
  l_.enter(statement, typed);
  if (statement.label != kNone) bindLabels(index);
  l_.sequences.pass(statement);
  index_ = index;
  execute(statement, typed);
  index_ = kNone;
  const RoutineBuilder& out = l_.emitter.out();
  Trace::Statement& traced = trace_.statements[index];
  if (traced.routine == out.routine()) traced.last = std::max(traced.first, out.openRung() - (out.isOpen() ? 0 : 1));
}

// The open rung is the first of the current statement.
void Walk::trace() {
  if (index_ == kNone) return;
  const RoutineBuilder& out = l_.emitter.out();
  trace_.statements[index_] = {out.routine(), out.openRung(), out.openRung()};
}

void Walk::execute(const Statement& statement, const Typed& typed) {
  switch (statement.row->role) {
  case Role::Code: return code(typed);
  case Role::MechBegin: return beginMechanism(statement);
  case Role::MechEnd: beginAt(statement); return l_.sequences.end();
  case Role::ProcBegin: return beginProcedure(statement);
  case Role::ProcEnd: l_.emitter.close(); return;
  case Role::Timed: return beginTimed(statement, typed);
  case Role::MacroBegin: return l_.useStack();
  default: return; // not executed
  }
}

void Walk::code(const Typed& typed) {
  const Statement& statement = l_.statement();
  beginRungFor(typed);
  l_.emitter.out().statement(sourceOf(source_, statement));
  trace();
  l_.useStack();
  l_.marking.decision(statement);
  const uint32_t rung = l_.emitter.out().openRung();
  statement.row->lower(l_, program_.operandsOf(typed), statement.row->variant);
  l_.marking.result(statement, rung);
}

// An equation begins a rung of its own; long runs of data instructions are split where a value is loaded.
void Walk::beginRungFor(const Typed& typed) {
  const uint32_t length = l_.emitter.out().length();
  const bool loads = (l_.statement().row->effects & kPushes) != 0 || l_.mnemonic() == "LOD";
  const bool begins = typed.stack.begins && length > 0;
  if (begins || (loads && length >= kLongRung) || length >= kLongestRung) l_.emitter.out().cut();
}

// ---- units ----------------------------------------------------------------------------------------------------------

void Walk::beginAt(const Statement& statement) {
  l_.emitter.out().cut();
  l_.emitter.out().statement(sourceOf(source_, statement));
  trace();
}

void Walk::beginMechanism(const Statement& statement) {
  beginAt(statement);
  l_.sequences.beginMechanism(source_.at(statement.unit).index, statement.unit);
}

// Lowers a procedure to a routine of its own: the normal flow skips the definition (man. l.1588-1603).
void Walk::beginProcedure(const Statement& statement) {
  l_.emitter.out().cut();
  l_.emitter.open(l_.procedures.routine(source_.at(statement.unit).index));
  l_.emitter.out().statement(sourceOf(source_, statement));
}

void Walk::beginTimed(const Statement& statement, const Typed& typed) {
  const uint32_t end = l_.jumpTarget(program_.operandsOf(typed)[0]);
  beginAt(statement);
  const bool inProcedure = source_.procedureOf(statement.unit) != kNone;
  const auto kind = static_cast<TimedKind>(statement.row->variant);
  l_.emitter.out().jump(end, l_.b().not_(clocks_.isDue(kind, kind_, inProcedure)));
}

} // namespace rung::frontend::technol
