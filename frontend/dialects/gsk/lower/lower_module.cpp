// The module around the networks: spaces, routines, tasks and the schedule of slots (P3).
#include "frontend/dialects/gsk/lower/lower_module.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/gsk/config.h"
#include "ir/support/diag/gsk.h"
#include "ir/support/hash.h"
#include "rtlib/nc/faults.h"
#include "rung/types.hpp"

namespace rung::gsk {
namespace {

using network::Control;

constexpr uint32_t kBudget = 1'000'000; // steps of one run (P6)
// Runs of bytes that are copied together although some between them are not needed.
constexpr uint32_t kCopyGap = 8;

uint32_t spaceFlags(network::AreaUse use) {
  switch (use) {
  case network::AreaUse::Input: return RUNG_SPACE_INPUT;
  case network::AreaUse::Output: return RUNG_SPACE_OUTPUT;
  case network::AreaUse::Memory: return 0;
  }
  return 0;
}

size_t indexOf(network::Area area) { return static_cast<size_t>(area); }

bool isLoweredBy(const network::Network& network, LowerFn lower) {
  return network.function.row != nullptr && rowOf(*network.function.row).lower == lower;
}
bool isTimer(const network::Network& network) { return isLoweredBy(network, &lowerTimer); }
bool jumps(const network::Network& network) {
  const Control control = controlOf(network);
  return control == Control::Jmp || control == Control::Jmpb || control == Control::Jmpc;
}
bool isWindow(const network::Network& network) { return isLoweredBy(network, &lowerWindow); }

std::string stemOf(std::string_view path) {
  const size_t slash = path.find_last_of('/');
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  return std::string(path.substr(0, path.find_last_of('.')));
}

} // namespace

ModuleLowering::ModuleLowering(const network::Program& program, network::Context& context,
                               std::span<const FileId> files, const frontend::CompileOptions& options)
    : program_(program), context_(context), files_(files), options_(options), module_(std::make_unique<ir::Module>()),
      constants_(*module_), levels_(kLanguage.levels.size()) {
  for (uint32_t level = 0; level < levels_.size(); ++level) levels_[level].level = level;
}

std::unique_ptr<ir::Module> ModuleLowering::run() {
  module_->name = files_.empty() ? "" : stemOf(context_.sources.name(files_[0]));
  module_->dialect = "gsk";
  module_->faults.emplace_back(nc::kGskDeadLoop);
  fileIndex_ = frontend::addFiles(*module_, context_.sources, files_);
  addSpaces();
  addSymbols();
  addPresets();
  makeKeys();
  makeNumbers();
  for (LevelState& level : levels_) planRoutines(level);
  for (LevelState& level : levels_)
    for (uint32_t unit = 0; unit < program_.units.size(); ++unit)
      if (level.routines[unit].valid()) lowerRoutine(level, unit);
  planParts();
  addTasks();
  return std::move(module_);
}

void ModuleLowering::addSpaces() {
  for (size_t i = 0; i < kAreas.size(); ++i) {
    const network::AreaInfo& info = kAreas[i];
    const ir::SpaceId space = frontend::addSpace(
        *module_, {.name = std::string(1, info.letter), .units = info.bytes, .flags = spaceFlags(info.use)});
    spaces_[i] = space;
    for (LevelState& level : levels_) {
      level.spaces[i] = space;
      level.used[i].assign(info.bytes, false);
    }
    if (info.retained) module_->retains.push_back({space, 0, info.bytes});
  }
  for (LevelState& level : levels_) {
    if (!kLanguage.levels[level.level].latchesInputs()) continue;
    for (size_t i = 0; i < kAreas.size(); ++i)
      if (kAreas[i].use == network::AreaUse::Input)
        level.spaces[i] = hiddenSpace(fmt::format("@{}{}", kAreas[i].letter, level.level + 1), kAreas[i].bytes);
  }
}

void ModuleLowering::addSymbols() {
  for (const network::UserName& symbol : context_.names.ofKind(network::UserName::Kind::Symbol))
    module_->symbols.push_back({.name = std::string(symbol.name),
                                .comment = std::string(symbol.comment),
                                .space = spaces_[indexOf(symbol.address.area)],
                                .byte = symbol.address.byte,
                                .bit = symbol.address.bit,
                                .type = symbol.address.isBit ? RUNG_TYPE_BIT : RUNG_TYPE_I8,
                                .flags = kLanguage.at(symbol.address.area).use == network::AreaUse::Input
                                             ? uint32_t{RUNG_SYMBOL_READONLY}
                                             : 0u});
  frontend::settleSymbols(*module_);
}

void ModuleLowering::addPresets() {
  for (const Preset& preset : presetsOf(options_)) {
    const auto low = static_cast<uint8_t>(preset.value & 0xFF);
    const auto high = static_cast<uint8_t>(preset.value >> 8);
    module_->inits.push_back({spaces_[indexOf(preset.address.area)], preset.address.byte, {low, high}});
  }
}

// Keys are made of the text alone; equal networks of one unit are distinguished by their order. The state of a function
// belongs to the function, whatever its conditions are.
void ModuleLowering::makeKeys() {
  for (const network::Unit& unit : program_.units) {
    std::unordered_map<uint64_t, uint32_t> seen;
    frontend::Numbering alike;
    std::vector<Key>& keys = keys_.emplace_back();
    std::vector<std::string>& prefixes = slotPrefixes_.emplace_back();
    for (const network::Network& network : unit.networks) {
      const uint64_t text = hashBytes(commandText(kLanguage, network), hashBytes(nameOf(kLanguage, unit)));
      const uint32_t copy = seen[text]++;
      keys.push_back({rungKey(text, copy), copy});
      std::string& prefix = prefixes.emplace_back();
      if (network.function.row == nullptr) continue;
      prefix = fmt::format("{}/{}/", nameOf(kLanguage, unit),
                           alike.numbered(identityOf(kLanguage, context_.sources, network.function)));
    }
  }
}

// Every network but the end of a unit is drawn, in the order of the sources, whatever unit it belongs to.
void ModuleLowering::makeNumbers() {
  std::vector<const network::Network*> drawn;
  for (const network::Unit& unit : program_.units)
    for (size_t i = 0; i + 1 < unit.networks.size(); ++i) drawn.push_back(&unit.networks[i]);
  std::ranges::sort(drawn, {}, [](const network::Network* network) { return network->range.begin; });
  for (const network::Network* network : drawn) numbers_.emplace(network, static_cast<uint32_t>(numbers_.size()) + 1);
}

// With the number of the level, counted from 1, where another one runs the unit, too.
std::string ModuleLowering::routineName(const LevelState& level, const network::Unit& unit) const {
  std::string name = nameOf(kLanguage, unit);
  if (std::ranges::count(unit.runBy, true) > 1) name += fmt::format("@{}", level.level + 1);
  return name;
}

void ModuleLowering::planRoutines(LevelState& level) {
  level.routines.resize(program_.units.size());
  for (uint32_t u = 0; u < program_.units.size(); ++u) {
    const network::Unit& unit = program_.units[u];
    if (!unit.runBy[level.level]) continue;
    level.routines[u] = frontend::addRoutine(*module_, routineName(level, unit));
    level.hasClock = level.hasClock || std::ranges::any_of(unit.networks, isTimer);
    level.countsRuns = level.countsRuns || std::ranges::any_of(unit.networks, isWindow);
  }
  const std::vector<network::Network>& own = program_.units[level.level].networks;
  level.straight = options_.given == nullptr && std::none_of(own.begin(), own.end(), jumps) &&
                   (level.level != kLanguage.mainLevel() || program_.jumpTargets.empty());
  planClock(level);
}

void ModuleLowering::planClock(LevelState& level) {
  const std::string name(kLanguage.levels[level.level].name);
  if (level.hasClock) {
    level.clock = slot("@clock/" + name, ir::Type::I64, 0, false);
    level.scanTime = slot("@scan/" + name, ir::Type::I64, 0, false);
  }
  if (level.countsRuns) level.runs = slot("@runs/" + name, ir::Type::I32, 0, false);
}

bool ModuleLowering::mayLeaveAfter(const network::Network& network) const {
  return network.callee != network::kNone && program_.units[network.callee].leaves;
}

void ModuleLowering::lowerRoutine(LevelState& level, uint32_t unitIndex) {
  const network::Unit& unit = program_.units[unitIndex];
  RoutineContext context{&level, unitIndex, {}};
  const bool clock = (level.hasClock || level.countsRuns) && unit.kind != network::UnitKind::Subprogram;
  uint32_t count = clock ? 1 : 0;
  for (const network::Network& network : unit.networks) {
    context.rungOf.push_back(count);
    count += mayLeaveAfter(network) ? 2 : 1;
  }
  ir::Routine& routine = module_->routines[level.routines[unitIndex].index];
  routine.rungs.resize(count);
  if (clock) addClock(routine, level, unit);
  for (uint32_t n = 0; n < unit.networks.size(); ++n) {
    lowerNetwork(context, routine.rungs[context.rungOf[n]], n);
    if (mayLeaveAfter(unit.networks[n])) addLeave(context, routine.rungs[context.rungOf[n] + 1], context.rungOf[n] + 2);
  }
}

// Timers grow by the time between two scans, however long that was (P23); window requests count scans (P48).
void ModuleLowering::addClock(ir::Routine& routine, LevelState& level, const network::Unit& unit) {
  ir::Rung& rung = routine.rungs[0];
  const network::Network& first = unit.networks.front();
  describe(rung, first, {hashBytes("@clock", hashBytes(nameOf(kLanguage, unit))), 0});
  rung.number = 0;
  rung.title.clear();
  rung.sourceText.clear();
  rung.lastLine = rung.begin.line;
  rung.weight = 1;
  ir::RungBuilder b(*module_, rung);
  if (level.countsRuns) b.slotStore(level.runs, b.add(b.slotLoad(level.runs), b.i32(1)));
  if (!level.hasClock) return;
  const ir::ValueId now = b.now();
  b.slotStore(level.scanTime, b.sub(now, b.slotLoad(level.clock)));
  b.slotStore(level.clock, now);
}

// n (P3): from the period, or from the steps of a slot; with both the period counts and must suffice.
void ModuleLowering::planParts() {
  const auto given = partsOf(options_);
  parts_ = given.value_or(1);
  const auto slotSteps = slotStepsOf(options_);
  if (!slotSteps) return;
  uint64_t level1 = 0;
  for (const ir::PartPiece& piece : ir::partPieces(*module_, routineOf(levels_[0]))) level1 += piece.weight;
  if (level1 >= *slotSteps) {
    context_.diagnostics.report(diag::Level1TooLong) << level1 << *slotSteps;
    return;
  }
  const uint64_t room = *slotSteps - level1;
  const std::vector<ir::PartPiece> pieces = ir::partPieces(*module_, routineOf(levels_[1]));
  const uint32_t needed = ir::partsNeeded(pieces, room);
  if (needed == 0) return reportLongRungs(pieces, room);
  if (!given)
    parts_ = needed;
  else if (needed > *given)
    context_.diagnostics.report(diag::PeriodTooShort)
        << *given * kSlotUs / 1000 << level1 + ir::heaviestPart(pieces, *given) << *slotSteps
        << needed * kSlotUs / 1000;
}

void ModuleLowering::reportLongRungs(const std::vector<ir::PartPiece>& pieces, uint64_t room) {
  const std::vector<ir::Rung>& rungs = module_->at(routineOf(levels_[1])).rungs;
  const std::vector<network::Network>& networks = program_.units[levels_[1].level].networks;
  for (const ir::PartPiece& piece : pieces) {
    if (piece.weight <= room) continue;
    const auto network = std::find_if(networks.begin(), networks.end(), [&](const network::Network& n) {
      return n.firstLine == rungs[piece.firstRung].begin.line &&
             fileIndex_.at(n.file.index) == rungs[piece.firstRung].begin.file;
    });
    context_.diagnostics.report(diag::RungTooLong, network == networks.end() ? SourceRange{} : network->range)
        << piece.weight << room;
  }
}

void ModuleLowering::addTasks() {
  for (const LevelState& level : levels_) addTask(level);
  addScan();
}

void ModuleLowering::addTask(const LevelState& level) {
  const network::Level& own = kLanguage.levels[level.level];
  const bool inEverySlot = own.turn == network::Turn::EverySlot;
  const ir::TaskId id{static_cast<uint32_t>(module_->tasks.size())};
  ir::Task& task = module_->tasks.emplace_back(ir::Task{.name = std::string(own.name),
                                                        .entry = routineOf(level),
                                                        .periodUs = kSlotUs * (inEverySlot ? 1 : parts_),
                                                        .budget = kBudget,
                                                        .budgetFault = ir::FaultId{0}});
  if (own.turn == network::Turn::Parts) {
    ir::cutTask(*module_, task, parts_);
    module_->mainTask = id;
  } else {
    addResultRegisters(level);
  }
  if (inEverySlot) module_->fastTask = id;
  if (own.latchesInputs())
    for (size_t i = 0; i < kAreas.size(); ++i)
      if (kAreas[i].use == network::AreaUse::Input) addLatch(level, i);
}

// In every slot the levels in their order, each where it has its turn.
void ModuleLowering::addScan() {
  module_->fast.push_back({.op = RUNG_STEP_ADVANCE, .arg = kSlotUs});
  for (uint32_t part = 0; part < parts_; ++part) {
    if (part != 0) module_->scan.push_back({.op = RUNG_STEP_SLOT});
    module_->scan.push_back({.op = RUNG_STEP_ADVANCE, .arg = kSlotUs});
    for (const LevelState& level : levels_) {
      const network::Turn turn = kLanguage.levels[level.level].turn;
      if (turn == network::Turn::LastSlot && part + 1 != parts_) continue;
      const uint32_t op = turn == network::Turn::Parts && parts_ != 1 ? RUNG_STEP_PART : RUNG_STEP_RUN;
      module_->scan.push_back({.op = op, .task = ir::TaskId{level.level}, .arg = 1});
      if (part == 0 && turn == network::Turn::EverySlot) module_->fast.push_back(module_->scan.back());
    }
  }
}

// What a level reads of an input area is copied when it begins.
void ModuleLowering::addLatch(const LevelState& level, size_t area) {
  std::vector<ir::Copy>& begin = module_->tasks[level.level].begin;
  const std::vector<bool>& used = level.used[area];
  const ir::SpaceId from = spaces_[area];
  const ir::SpaceId to = level.spaces[area];
  for (uint32_t byte = 0; byte < used.size(); ++byte) {
    if (!used[byte]) continue;
    const bool extend =
        !begin.empty() && begin.back().to == to && byte - (begin.back().toByte + begin.back().from.size) < kCopyGap;
    if (extend)
      begin.back().from.size = byte + 1 - begin.back().toByte;
    else
      begin.push_back({.from = {from, byte, 1}, .to = to, .toByte = byte});
  }
}

// P4: a level works on a set of result registers of its own; between its runs R holds that of the main program.
void ModuleLowering::addResultRegisters(const LevelState& level) {
  const auto used = level.used[indexOf(areas::kR)].begin() + kResultFlags;
  if (std::find(used, used + kResultBytes, true) == used + kResultBytes) return;
  ir::Task& task = module_->tasks[level.level];
  const ir::SpaceId relays = spaces_[indexOf(areas::kR)];
  const ir::SpaceId own = hiddenSpace(fmt::format("@R{}", level.level + 1), kResultBytes);
  const ir::SpaceId others = hiddenSpace(fmt::format("@R{}", kLanguage.mainLevel() + 1), kResultBytes);
  task.begin.push_back({.from = {relays, kResultFlags, kResultBytes}, .to = others});
  task.begin.push_back({.from = {own, 0, kResultBytes}, .to = relays, .toByte = kResultFlags});
  task.end.push_back({.from = {relays, kResultFlags, kResultBytes}, .to = own});
  task.end.push_back({.from = {others, 0, kResultBytes}, .to = relays, .toByte = kResultFlags});
}

ir::SlotId ModuleLowering::slot(const std::string& key, ir::Type type, int64_t init, bool transient) {
  const auto [at, isNew] = slots_.emplace(key, ir::SlotId{static_cast<uint32_t>(module_->slots.size())});
  if (isNew) module_->slots.push_back({.type = type, .init = init, .transient = transient, .key = key});
  return at->second;
}

ir::SpaceId ModuleLowering::hiddenSpace(const std::string& name, uint32_t bytes) {
  const auto [at, isNew] = hidden_.emplace(name, ir::SpaceId{});
  if (isNew) at->second = frontend::addSpace(*module_, {.name = name, .units = bytes, .flags = RUNG_SPACE_HIDDEN});
  return at->second;
}

void ModuleLowering::use(LevelState& level, const network::Address& address, uint32_t bytes) {
  std::vector<bool>& used = level.used[indexOf(address.area)];
  for (uint32_t i = 0; i < bytes; ++i) used[address.byte + i] = true;
}

std::unique_ptr<ir::Module> lowerProgram(const network::Program& program, network::Context& context,
                                         std::span<const FileId> files, const frontend::CompileOptions& options) {
  return ModuleLowering(program, context, files, options).run();
}

} // namespace rung::gsk
