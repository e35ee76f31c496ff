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
      constants_(*module_) {}

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
  levels_[1].isLevel2 = true;
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
    for (LevelState& level : levels_) {
      level.spaces[i] = space;
      level.used[i].assign(info.bytes, false);
    }
    if (info.retained) module_->retains.push_back({space, 0, info.bytes});
  }
  for (network::Area area : {areas::kX, areas::kF})
    levels_[1].spaces[indexOf(area)] =
        addHidden(fmt::format("@{}2", kLanguage.at(area).letter), kLanguage.at(area).bytes);
}

void ModuleLowering::addSymbols() {
  for (const network::UserName& symbol : context_.names.ofKind(network::UserName::Kind::Symbol))
    module_->symbols.push_back({.name = std::string(symbol.name),
                                .comment = std::string(symbol.comment),
                                .space = levels_[0].spaces[indexOf(symbol.address.area)],
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
    module_->inits.push_back({levels_[0].spaces[indexOf(preset.address.area)], preset.address.byte, {low, high}});
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

void ModuleLowering::planRoutines(LevelState& level) {
  level.routines.resize(program_.units.size());
  for (uint32_t u = 0; u < program_.units.size(); ++u) {
    const network::Unit& unit = program_.units[u];
    if (!(level.isLevel2 ? unit.fromLevel2 : unit.fromLevel1)) continue;
    const bool twice = unit.fromLevel1 && unit.fromLevel2;
    level.routines[u] =
        frontend::addRoutine(*module_, nameOf(kLanguage, unit) + (twice ? (level.isLevel2 ? "@2" : "@1") : ""));
    level.hasClock = level.hasClock || std::any_of(unit.networks.begin(), unit.networks.end(), isTimer);
    level.countsRuns = level.countsRuns || std::any_of(unit.networks.begin(), unit.networks.end(), isWindow);
  }
  const std::vector<network::Network>& own =
      program_.units[level.isLevel2 ? network::kLevel2 : network::kLevel1].networks;
  level.straight = options_.given == nullptr && std::none_of(own.begin(), own.end(), jumps) &&
                   (!level.isLevel2 || program_.jumpTargets.empty());
  planClock(level);
}

void ModuleLowering::planClock(LevelState& level) {
  const std::string name(kLanguage.levels[level.isLevel2 ? network::kLevel2 : network::kLevel1]);
  if (level.hasClock) {
    level.clock = slot("@clock/" + name, ir::Type::I64, 0, false);
    level.scanTime = slot("@scan/" + name, ir::Type::I64, 0, false);
  }
  if (level.countsRuns) level.runs = slot("@runs/" + name, ir::Type::I32, 0, false);
}

bool ModuleLowering::mayLeaveAfter(const RoutineContext& routine, const network::Network& network) const {
  return routine.level->isLevel2 && network.callee != network::kNone && program_.units[network.callee].leaves;
}

void ModuleLowering::lowerRoutine(LevelState& level, uint32_t unitIndex) {
  const network::Unit& unit = program_.units[unitIndex];
  RoutineContext context{&level, unitIndex, {}};
  const bool clock = (level.hasClock || level.countsRuns) && unit.kind != network::UnitKind::Subprogram;
  uint32_t count = clock ? 1 : 0;
  for (const network::Network& network : unit.networks) {
    context.rungOf.push_back(count);
    count += mayLeaveAfter(context, network) ? 2 : 1;
  }
  ir::Routine& routine = module_->routines[level.routines[unitIndex].index];
  routine.rungs.resize(count);
  if (clock) addClock(routine, level, unit);
  for (uint32_t n = 0; n < unit.networks.size(); ++n) {
    lowerNetwork(context, routine.rungs[context.rungOf[n]], n);
    if (mayLeaveAfter(context, unit.networks[n]))
      addLeave(context, routine.rungs[context.rungOf[n] + 1], context.rungOf[n] + 2);
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
  for (const ir::PartPiece& piece : ir::partPieces(*module_, levels_[0].routines[network::kLevel1]))
    level1 += piece.weight;
  if (level1 >= *slotSteps) {
    context_.diagnostics.report(diag::Level1TooLong) << level1 << *slotSteps;
    return;
  }
  const uint64_t room = *slotSteps - level1;
  const ir::RoutineId level2 = levels_[1].routines[network::kLevel2];
  const std::vector<ir::PartPiece> pieces = ir::partPieces(*module_, level2);
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
  const std::vector<ir::Rung>& rungs = module_->at(levels_[1].routines[network::kLevel2]).rungs;
  const std::vector<network::Network>& networks = program_.units[network::kLevel2].networks;
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
  module_->tasks.push_back({.name = std::string(kLanguage.levels[network::kLevel1]),
                            .entry = levels_[0].routines[network::kLevel1],
                            .periodUs = kSlotUs,
                            .budget = kBudget,
                            .budgetFault = ir::FaultId{0}});
  module_->tasks.push_back({.name = std::string(kLanguage.levels[network::kLevel2]),
                            .entry = levels_[1].routines[network::kLevel2],
                            .periodUs = kSlotUs * parts_,
                            .budget = kBudget,
                            .budgetFault = ir::FaultId{0}});
  ir::cutTask(*module_, module_->tasks[1], parts_);
  module_->fastTask = ir::TaskId{0};
  module_->mainTask = ir::TaskId{1};
  addResultRegisters(module_->tasks[0]);
  addLatch(module_->tasks[1], areas::kX);
  addLatch(module_->tasks[1], areas::kF);
  const ir::Step advance{.op = RUNG_STEP_ADVANCE, .arg = kSlotUs};
  const ir::Step level1{.op = RUNG_STEP_RUN, .task = module_->fastTask, .arg = 1};
  const uint32_t runOrPart = parts_ == 1 ? RUNG_STEP_RUN : RUNG_STEP_PART;
  const ir::Step level2{.op = runOrPart, .task = module_->mainTask, .arg = 1};
  for (uint32_t part = 0; part < parts_; ++part) {
    if (part != 0) module_->scan.push_back({.op = RUNG_STEP_SLOT});
    module_->scan.insert(module_->scan.end(), {advance, level1, level2});
  }
  module_->fast = {advance, level1};
}

// What Level 2 reads of an input area is copied when it begins.
void ModuleLowering::addLatch(ir::Task& task, network::Area area) {
  const std::vector<bool>& used = levels_[1].used[indexOf(area)];
  const ir::SpaceId from = levels_[0].spaces[indexOf(area)];
  const ir::SpaceId to = levels_[1].spaces[indexOf(area)];
  for (uint32_t byte = 0; byte < used.size(); ++byte) {
    if (!used[byte]) continue;
    const bool extend = !task.begin.empty() && task.begin.back().to == to &&
                        byte - (task.begin.back().toByte + task.begin.back().from.size) < kCopyGap;
    if (extend)
      task.begin.back().from.size = byte + 1 - task.begin.back().toByte;
    else
      task.begin.push_back({.from = {from, byte, 1}, .to = to, .toByte = byte});
  }
}

// P4: Level 1 works on a set of result registers of its own; between its runs R holds that of Level 2.
void ModuleLowering::addResultRegisters(ir::Task& task) {
  const std::vector<bool>& used = levels_[0].used[indexOf(areas::kR)];
  if (std::find(used.begin() + kResultFlags, used.begin() + kResultFlags + kResultBytes, true) ==
      used.begin() + kResultFlags + kResultBytes)
    return;
  const ir::SpaceId relays = levels_[0].spaces[indexOf(areas::kR)];
  const ir::SpaceId level1 = addHidden("@R1", kResultBytes);
  const ir::SpaceId level2 = addHidden("@R2", kResultBytes);
  task.begin.push_back({.from = {relays, kResultFlags, kResultBytes}, .to = level2});
  task.begin.push_back({.from = {level1, 0, kResultBytes}, .to = relays, .toByte = kResultFlags});
  task.end.push_back({.from = {relays, kResultFlags, kResultBytes}, .to = level1});
  task.end.push_back({.from = {level2, 0, kResultBytes}, .to = relays, .toByte = kResultFlags});
}

ir::SlotId ModuleLowering::slot(const std::string& key, ir::Type type, int64_t init, bool transient) {
  const auto [at, isNew] = slots_.emplace(key, ir::SlotId{static_cast<uint32_t>(module_->slots.size())});
  if (isNew) module_->slots.push_back({.type = type, .init = init, .transient = transient, .key = key});
  return at->second;
}

// The NC writes it before each slot; a program that does not look at positions has none.
ir::SpaceId ModuleLowering::machinePositions() {
  if (!positions_.valid()) positions_ = addHidden("@MPOS", 4 * kMachineAxes);
  return positions_;
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
