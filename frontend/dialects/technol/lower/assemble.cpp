// Assembles spaces, symbols and tasks (see assemble.h).
#include "frontend/dialects/technol/lower/assemble.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "frontend/dialects/technol/lower/system_routines.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {

using ir::Type;

namespace {

constexpr uint32_t kFastPeriodUs = 1000; // man. l.2660
constexpr uint32_t kScanBudget = 1'000'000;
constexpr uint32_t kFastBudget = 100'000;

// DS 8 holds a QWORD or a REAL, DS n bytes; a text has room for its terminator.
ir::Symbol madeSymbol(const Symbol& symbol) {
  ir::Symbol made;
  made.name = text::upper(symbol.name);
  made.space = symbol.space;
  made.byte = symbol.byte;
  made.bit = symbol.bit;
  made.type = ir::abiType(symbol.type);
  switch (symbol.kind) {
  case SymbolKind::Text:
    made.type = RUNG_TYPE_TEXT;
    made.count = symbol.size;
    break;
  case SymbolKind::Cell:
    if (symbol.type == Type::None && symbol.size == 8 && symbol.index == kNone)
      made.type = RUNG_TYPE_I64;
    else
      made.count = std::max(1u, symbol.size / std::max(1u, ir::byteWidth(symbol.type)));
    break;
  case SymbolKind::Constant:
    made.flags = RUNG_SYMBOL_CONST;
    made.type = RUNG_TYPE_I64;
    made.value = symbol.value;
    break;
  default: break;
  }
  if (symbol.protection != Protection::None) made.flags |= RUNG_SYMBOL_READONLY;
  return made;
}

// Whether the symbol is local to one use of a macro.
bool isOfUse(const Symbol& symbol) { return symbol.name.find(kUseMark) != std::string_view::npos; }

bool hasSymbol(const Symbol& symbol) {
  if (symbol.broken) return false;
  switch (symbol.kind) {
  case SymbolKind::Bit:
  case SymbolKind::Cell:
  case SymbolKind::Text:
  case SymbolKind::Mechanism: return symbol.space.valid();
  case SymbolKind::Constant: return !symbol.predeclared;
  case SymbolKind::Label:
  case SymbolKind::Procedure:
  case SymbolKind::Macro:
  case SymbolKind::Structure: return false;
  }
  return false;
}

} // namespace

void addSpaces(const Declarations& declarations, ir::Module& module) {
  const nc::SignalTable& signals = nc::technolSignals();
  const auto add = [&](std::string name, ir::SpaceId space, uint32_t flags) {
    module.spaces.push_back(
        {.name = std::move(name), .unitBytes = 1, .units = declarations.bytesOf(space), .flags = flags});
  };
  add("NCI", kInterfaceSpace, 0);
  add("DATA", kDataSpace, RUNG_SPACE_ALLOCATED);
  add("MECH", kMechanismSpace, RUNG_SPACE_ALLOCATED);
  add("@REG", kRegisterSpace, RUNG_SPACE_HIDDEN);
  add("BLK", kBlockSpace, RUNG_SPACE_INPUT);
  add("IO", kExchangeSpace, RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT | RUNG_SPACE_ALLOCATED);
  module.inits = declarations.inits;
  addPowerOnPresets(module);
  // Saved at a regular shutdown, loaded at start-up (man. l.7549).
  if (const nc::Signal* backup = nc::findSignal(signals, "PLC_MEM_BACKUP", "I"))
    module.retains.push_back({.space = kInterfaceSpace, .byte = backup->byteOffset, .size = backup->count});
}

namespace {

// Adds the elements of arrays of bits, one byte each: NAME[0], NAME[1]...
void addElements(const TypedProgram& program, ir::Module& module) {
  for (const Exchanged& variable : program.declarations.exchanged) {
    if (variable.type != nc::ExchangeType::Bit || variable.count == 1) continue;
    ir::Symbol made = madeSymbol(program.symbols[variable.symbol]);
    const std::string name = made.name;
    for (uint32_t i = 0; i < variable.count; ++i) {
      made.name = name + "[" + std::to_string(i) + "]";
      module.symbols.push_back(made);
      ++made.byte;
    }
  }
}

// A local name qualified by its file.
std::string inFile(const SourceProgram& program, const Symbol& symbol, const std::string& name) {
  std::string_view path = program.sources.name(program.files[symbol.file].id);
  if (const size_t slash = path.find_last_of('/'); slash != std::string_view::npos) path.remove_prefix(slash + 1);
  return std::string(path) + ":" + name;
}

// Adds the local symbols of macro uses under a name that all uses share; the preceding symbols show which use it is.
void addOfUses(const TypedProgram& program, ir::Module& module) {
  for (const Symbol& symbol : program.symbols.all()) {
    if (!isOfUse(symbol) || !hasSymbol(symbol)) continue;
    ir::Symbol made = madeSymbol(symbol);
    made.name.erase(made.name.find(kUseMark) + 1);
    made.flags |= RUNG_SYMBOL_HIDDEN;
    module.symbols.push_back(std::move(made));
  }
}

bool isVisible(const Symbol& symbol) { return hasSymbol(symbol) && !isOfUse(symbol); }

} // namespace

void addSymbols(const TypedProgram& program, ir::Module& module, bool isCompared) {
  std::unordered_map<std::string, uint32_t> global, local;
  for (const Symbol& symbol : program.symbols.all())
    if (isVisible(symbol)) ++(symbol.local ? local : global)[madeSymbol(symbol).name];
  // A local name is public if no other file has it. If a cell and a mechanism share a name, it refers to the cell; the
  // mechanism is found in the control's own view.
  for (const Symbol& symbol : program.symbols.all()) {
    if (!isVisible(symbol)) continue;
    ir::Symbol made = madeSymbol(symbol);
    const bool shared = symbol.local && global.contains(made.name);
    if (isCompared && symbol.local && (symbol.file != 0 || shared))
      made.name = inFile(program.source, symbol, made.name);
    const bool other = !isCompared && (shared || (symbol.local && local[made.name] > 1));
    if (!other && (symbol.local || global[made.name] == 1)) module.symbols.push_back(std::move(made));
  }
  addElements(program, module);
  if (isCompared) addOfUses(program, module);
  for (int i = 0; i < kHostCells; ++i) {
    const HostCellInfo& cell = hostCell(static_cast<HostCell>(i));
    nameCells(module, std::string(cell.name), {.space = kRegisterSpace, .byte = cell.byte}, cell.type, cell.count);
  }
  settleSymbols(module);
}

namespace {

using LineOfFile = std::pair<uint32_t, uint32_t>;

bool hasCode(const SourceProgram& program, const ModulePart& part) {
  for (uint32_t i = part.firstStatement; i < part.endStatement && i < program.statements.size(); ++i)
    if (program.statements[i].row != nullptr && program.statements[i].row->role == Role::Code) return true;
  return false;
}

// First lines of modules and procedures, last lines of modules without code.
std::set<LineOfFile> headingsOf(const SourceProgram& program) {
  std::set<LineOfFile> headings;
  for (const ModulePart& part : program.parts) {
    headings.emplace(part.file, program.sources.lineCol(program.at(part.unit).begin.begin).line);
    if (!hasCode(program, part)) headings.emplace(part.file, part.endLine);
  }
  for (const Statement& statement : program.statements)
    if (statement.row != nullptr && statement.row->role == Role::ProcBegin)
      headings.emplace(statement.file, statement.line);
  return headings;
}

} // namespace

void numberRungs(const SourceProgram& source, ir::Module& module) {
  const std::set<LineOfFile> headings = headingsOf(source);
  std::map<LineOfFile, uint32_t> numbers;
  const auto forRungs = [&](auto act) {
    for (ir::Routine& routine : module.routines)
      for (ir::Rung& rung : routine.rungs) {
        const LineOfFile place(rung.begin.file.index, rung.begin.line);
        const bool isLine = rung.weight == 1 && rung.lastLine == rung.begin.line;
        if (rung.begin.line != 0 && !(isLine && headings.contains(place))) act(rung, place);
      }
  };
  forRungs([&](const ir::Rung&, auto place) { numbers.emplace(place, 0); });
  uint32_t count = 0;
  for (auto& [place, number] : numbers) number = ++count;
  forRungs([&](ir::Rung& rung, auto place) { rung.number = numbers.at(place); });
}

namespace {

class TaskMaker {
public:
  TaskMaker(const Declarations& declarations, const LoweredProgram& lowered, Emitter& emitter, uint32_t periodUs)
      : declarations_(declarations), lowered_(lowered), emitter_(emitter), module_(emitter.module()),
        periodUs_(periodUs) {}
  void make();

private:
  ir::TaskId add(std::string name, ir::RoutineId routine, uint64_t weight, uint32_t period, bool fast);
  ir::TaskId of(ModuleKind kind) const { return ids_[static_cast<size_t>(kind)]; }
  void run(std::vector<ir::Step>& steps, ModuleKind kind, uint32_t times = 1) const;
  void fastSteps(std::vector<ir::Step>& steps, uint32_t times) const;
  void makeScan();
  void pass(std::vector<ir::Step>& steps, uint32_t us, uint32_t fastRuns) const;
  static void step(std::vector<ir::Step>& steps, uint32_t op, uint32_t arg) {
    steps.push_back({.op = op, .task = {RUNG_NONE}, .arg = arg});
  }

  const Declarations& declarations_;
  const LoweredProgram& lowered_;
  Emitter& emitter_;
  ir::Module& module_;
  uint32_t periodUs_;
  std::array<ir::TaskId, kModuleKinds> ids_{};
  ir::TaskId bitMessages_;
};

// Adds a task. The budget grows with the weight, so that a long program without a loop does not trigger the watchdog.
ir::TaskId TaskMaker::add(std::string name, ir::RoutineId routine, uint64_t weight, uint32_t period, bool fast) {
  const uint64_t budget = std::max<uint64_t>(fast ? kFastBudget : kScanBudget, weight * 4);
  std::string_view where = module_.at(routine).name;
  if (where.starts_with('@')) where.remove_prefix(1); // removes the mark of the wrapper routine of an event procedure
  const std::string fault =
      fast ? std::string(nc::kTechnolFastOverrun) : std::string(nc::kTechnolWatchdog) + std::string(where);
  module_.tasks.push_back({.name = std::move(name),
                           .entry = routine,
                           .periodUs = period,
                           .budget = static_cast<uint32_t>(std::min<uint64_t>(budget, UINT32_MAX)),
                           .budgetFault = emitter_.fault(fault)});
  return {static_cast<uint32_t>(module_.tasks.size()) - 1};
}

void TaskMaker::run(std::vector<ir::Step>& steps, ModuleKind kind, uint32_t times) const {
  if (of(kind).valid()) steps.push_back({.op = RUNG_STEP_RUN, .task = of(kind), .arg = times});
}

// Fast connections are exchanged before MODULE_CYCLICOPERATION and MODULE_FAST, the fastest before and after
// MODULE_FASTEST (man. l.13455-13482).
void TaskMaker::fastSteps(std::vector<ir::Step>& steps, uint32_t times) const {
  const bool others = of(ModuleKind::Cyclic).valid() || of(ModuleKind::Fastest).valid();
  const bool exchanges = declarations_.exchangesFast;
  if (!others && !exchanges) return run(steps, ModuleKind::Fast, times);
  const auto exchange = [&](ModuleKind kind, uint32_t hook) {
    if (exchanges && of(kind).valid()) step(steps, RUNG_STEP_HOOK, hook);
  };
  for (uint32_t i = 0; i < times; ++i) {
    exchange(ModuleKind::Cyclic, nc::kHookFast);
    run(steps, ModuleKind::Cyclic);
    exchange(ModuleKind::Fastest, nc::kHookFastest);
    run(steps, ModuleKind::Fastest);
    exchange(ModuleKind::Fastest, nc::kHookFastest);
    exchange(ModuleKind::Fast, nc::kHookFast);
    run(steps, ModuleKind::Fast);
  }
}

void TaskMaker::make() {
  for (const LoweredModule& lowered : lowered_.modules) {
    const bool fast = isFast(lowered.kind);
    const bool cyclic =
        lowered.kind == ModuleKind::Input || lowered.kind == ModuleKind::Main || lowered.kind == ModuleKind::Cont;
    const std::string_view name = moduleName(lowered.kind).substr(std::string_view("MODULE_").size());
    ids_[static_cast<size_t>(lowered.kind)] = add(std::string(name), lowered.routine, lowered.weight,
                                                  fast     ? kFastPeriodUs
                                                  : cyclic ? periodUs_
                                                           : 0,
                                                  fast);
  }
  for (const Event& event : lowered_.events) add(event.name, event.routine, 1, 0, false);
  module_.mainTask = of(ModuleKind::Main);
  module_.fastTask = of(ModuleKind::Fast);
  if (lowered_.bitMessages.valid())
    bitMessages_ = add("EDEF", lowered_.bitMessages, lowered_.bitMessagesWeight, periodUs_, false);
  fastSteps(module_.fast, 1);
  makeScan();
}

// Builds the schedule of one period. On the virtual clock all fast runs of a period take place between MODULE_INPUT and
// MODULE_MAIN (technol.md 12.2). On a real clock MODULE_FAST runs every millisecond (man. l.2660-2669): the first time
// between these modules, then alone.
void TaskMaker::makeScan() {
  const uint32_t fastRuns = std::max(1u, periodUs_ / kFastPeriodUs);
  pass(module_.scan, periodUs_, fastRuns);
  if (module_.fast.empty() || fastRuns == 1) return;
  pass(module_.slices, periodUs_ - (fastRuns - 1) * kFastPeriodUs, 1);
  for (uint32_t i = 1; i < fastRuns; ++i) {
    step(module_.slices, RUNG_STEP_ADVANCE, kFastPeriodUs);
    fastSteps(module_.slices, 1);
  }
}

void TaskMaker::pass(std::vector<ir::Step>& steps, uint32_t us, uint32_t fastRuns) const {
  step(steps, RUNG_STEP_ADVANCE, us);
  step(steps, RUNG_STEP_HOOK, nc::kHookBeforeInput);
  run(steps, ModuleKind::Input);
  fastSteps(steps, fastRuns);
  step(steps, RUNG_STEP_HOOK, nc::kHookAfterInput);
  run(steps, ModuleKind::Main);
  step(steps, RUNG_STEP_HOOK, nc::kHookAfterMain);
  run(steps, ModuleKind::Cont);
  if (bitMessages_.valid()) steps.push_back({.op = RUNG_STEP_RUN, .task = bitMessages_, .arg = 1});
}

} // namespace

void addTasks(const Declarations& declarations, const LoweredProgram& lowered, Emitter& emitter, uint32_t periodUs) {
  TaskMaker(declarations, lowered, emitter, periodUs).make();
}

} // namespace rung::frontend::technol
