// Builds the module that contains the networks: spaces, routines, tasks and the schedule of slots.
#include "frontend/network/lower/lower_module.h"

#include <algorithm>

#include <fmt/format.h>

#include "ir/core/parts.h"
#include "ir/support/hash.h"
#include "rung/types.hpp"

namespace rung::frontend::network {
namespace {

// Input bytes with a smaller gap between them are copied as one block.
constexpr uint32_t kCopyGap = 8;

uint32_t spaceFlags(AreaUse use) {
  switch (use) {
  case AreaUse::Input: return RUNG_SPACE_INPUT;
  case AreaUse::Output: return RUNG_SPACE_OUTPUT;
  case AreaUse::Memory: return 0;
  }
  return 0;
}

size_t indexOf(Area area) { return static_cast<size_t>(area); }

bool asks(const Unit& unit, LoweredRow::Asks what) {
  return std::ranges::any_of(unit.networks, [what](const Network& network) {
    return network.function.row != nullptr && loweredRow(*network.function.row).asks == what;
  });
}

bool jumps(const Network& network) {
  const Control control = controlOf(network);
  return control == Control::Jmp || control == Control::Jmpb || control == Control::Jmpc;
}

std::string stemOf(std::string_view path) {
  const size_t slash = path.find_last_of('/');
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  return std::string(path.substr(0, path.find_last_of('.')));
}

} // namespace

void LevelState::use(const Address& address, uint32_t bytes) {
  std::vector<bool>& area = used[indexOf(address.area)];
  for (uint32_t i = 0; i < bytes; ++i) area[address.byte + i] = true;
}

ModuleLowering::ModuleLowering(const Program& program, Context& context, std::span<const FileId> files,
                               const Execution& execution, ir::Marks* marks, bool compared)
    : program_(program), context_(context), language_(context.language), execution_(execution), marks_(marks),
      compared_(compared), module_(std::make_unique<ir::Module>()), constants_(*module_),
      levels_(language_.levels.size()) {
  for (uint32_t level = 0; level < levels_.size(); ++level) levels_[level].level = level;
  module_->name = files.empty() ? "" : stemOf(context_.sources.name(files[0]));
  module_->dialect = language_.name;
  module_->faults.emplace_back(execution_.overrunFault);
  fileIndex_ = frontend::addFiles(*module_, context_.sources, files);
  addSpaces();
  addSymbols();
}

void ModuleLowering::lowerUnits() {
  makeKeys();
  makeNumbers();
  for (LevelState& level : levels_) planRoutines(level);
  for (LevelState& level : levels_)
    for (uint32_t unit = 0; unit < program_.units.size(); ++unit)
      if (level.routines[unit].valid()) lowerRoutine(level, unit);
}

void ModuleLowering::addSpaces() {
  for (const AreaInfo& info : language_.areas) {
    for (LevelState& level : levels_) level.used.emplace_back(info.bytes, false);
    if (info.bytes == 0) {
      spaces_.emplace_back();
      continue;
    }
    const ir::SpaceId space = frontend::addSpace(
        *module_, {.name = std::string(1, info.letter), .units = info.bytes, .flags = spaceFlags(info.use)});
    spaces_.push_back(space);
    if (info.retained) module_->retains.push_back({space, 0, info.bytes});
  }
  for (LevelState& level : levels_) {
    level.spaces = spaces_;
    if (!language_.levels[level.level].latchesInputs()) continue;
    for (size_t i = 0; i < spaces_.size(); ++i)
      if (const AreaInfo& info = language_.areas[i]; info.use == AreaUse::Input && info.bytes != 0)
        level.spaces[i] = hiddenSpace(fmt::format("@{}{}", info.letter, level.level + 1), info.bytes);
  }
}

void ModuleLowering::addSymbols() {
  for (const UserName& symbol : context_.names.ofKind(UserName::Kind::Symbol)) {
    const bool exists = language_.at(symbol.address.area).room(symbol.address.byte) > 0;
    if (!exists || splitAddress(language_, symbol.name)) continue; // an address is always that
    module_->symbols.push_back(
        {.name = std::string(symbol.name),
         .comment = std::string(symbol.comment),
         .space = spaces_[indexOf(symbol.address.area)],
         .byte = symbol.address.byte,
         .bit = symbol.address.bit,
         .type = symbol.address.isBit ? RUNG_TYPE_BIT : RUNG_TYPE_I8,
         .flags = language_.at(symbol.address.area).use == AreaUse::Input ? uint32_t{RUNG_SYMBOL_READONLY} : 0u});
  }
  frontend::settleSymbols(*module_);
}

// Keys depend on the text alone; identical networks of a unit are distinguished by their order. The state of a function
// is keyed by the function, independent of its conditions.
void ModuleLowering::makeKeys() {
  for (const Unit& unit : program_.units) {
    std::unordered_map<uint64_t, uint32_t> seen;
    frontend::Numbering alike;
    std::vector<Key>& keys = keys_.emplace_back();
    std::vector<std::string>& prefixes = slotPrefixes_.emplace_back();
    for (const Network& network : unit.networks) {
      const uint64_t text = hashBytes(commandText(language_, network), hashBytes(nameOf(language_, unit)));
      const uint32_t copy = seen[text]++;
      keys.push_back({rungKey(text, copy), copy});
      for (const LogicStep& step : network.logic)
        if (step.contact == Contact::Falling)
          edgeKeys_[&step] = fmt::format("{}/{}/edge", nameOf(language_, unit),
                                         alike.numbered("contact " + textOf(language_, step.bit)));
      std::string& prefix = prefixes.emplace_back();
      if (network.function.row == nullptr) continue;
      prefix = fmt::format("{}/{}/", nameOf(language_, unit),
                           alike.numbered(identityOf(language_, context_.sources, network.function)));
    }
  }
}

// Numbers all networks but the ends of units in source order, across all units.
void ModuleLowering::makeNumbers() {
  std::vector<const Network*> drawn;
  for (const Unit& unit : program_.units)
    for (size_t i = 0; i + 1 < unit.networks.size(); ++i) drawn.push_back(&unit.networks[i]);
  std::ranges::sort(drawn, {}, [](const Network* network) { return network->range.begin; });
  for (const Network* network : drawn) numbers_.emplace(network, static_cast<uint32_t>(numbers_.size()) + 1);
}

// The unit's name, with the number of the level (counted from 1) if several levels run the unit.
std::string ModuleLowering::routineName(const LevelState& level, const Unit& unit) const {
  std::string name = nameOf(language_, unit);
  if (std::ranges::count(unit.runBy, true) > 1) name += fmt::format("@{}", level.level + 1);
  return name;
}

bool ModuleLowering::isAbsent(uint32_t level) const {
  return language_.levels[level].optional && withoutEnd(program_.units[level]).empty();
}

uint32_t ModuleLowering::lastLevel() const {
  uint32_t level = static_cast<uint32_t>(levels_.size()) - 1;
  while (isAbsent(level)) --level;
  return level;
}

void ModuleLowering::planRoutines(LevelState& level) {
  level.routines.resize(program_.units.size());
  if (isAbsent(level.level)) return;
  for (uint32_t u = 0; u < program_.units.size(); ++u) {
    const Unit& unit = program_.units[u];
    if (!unit.runBy[level.level]) continue;
    level.routines[u] = frontend::addRoutine(*module_, routineName(level, unit));
    level.hasClock = level.hasClock || asks(unit, LoweredRow::Asks::Time);
    level.countsRuns = level.countsRuns || asks(unit, LoweredRow::Asks::Count);
  }
  const std::vector<Network>& own = program_.units[level.level].networks;
  level.straight = !compared_ && std::none_of(own.begin(), own.end(), jumps) &&
                   (level.level != language_.mainLevel() || program_.jumpTargets.empty());
  planClock(level);
}

void ModuleLowering::planClock(LevelState& level) {
  const std::string name(language_.levels[level.level].name);
  if (level.hasClock) {
    level.clock = slot("@clock/" + name, ir::Type::I64, 0, false);
    level.scanTime = slot("@scan/" + name, ir::Type::I64, 0, false);
  }
  if (level.countsRuns) level.runs = slot("@runs/" + name, ir::Type::I32, 0, false);
}

bool ModuleLowering::mayLeaveAfter(const Network& network) const {
  return network.callee != kNone && program_.units[network.callee].leaves;
}

void ModuleLowering::lowerRoutine(LevelState& level, uint32_t unitIndex) {
  const Unit& unit = program_.units[unitIndex];
  RoutineContext context{&level, unitIndex, {}};
  const bool begins = unit.kind != UnitKind::Subprogram && level.level == 0 && execution_.eachSlot;
  const bool clock = begins || ((level.hasClock || level.countsRuns) && unit.kind != UnitKind::Subprogram);
  uint32_t count = clock ? 1 : 0;
  for (const Network& network : unit.networks) {
    context.rungOf.push_back(count);
    count += mayLeaveAfter(network) ? 2 : 1;
  }
  ir::Routine& routine = module_->routines[level.routines[unitIndex].index];
  routine.rungs.resize(count);
  if (clock) addClock(routine, context, unit);
  for (uint32_t n = 0; n < unit.networks.size(); ++n) {
    lowerNetwork(context, routine.rungs[context.rungOf[n]], n);
    if (mayLeaveAfter(unit.networks[n])) addLeave(context, routine.rungs[context.rungOf[n] + 1], context.rungOf[n] + 2);
  }
}

// Rung that runs first in a level. Timers advance by the time between two scans, however long it was (P23); window
// requests count scans (P48).
void ModuleLowering::addClock(ir::Routine& routine, RoutineContext& context, const Unit& unit) {
  const LevelState& level = *context.level;
  ir::Rung& rung = routine.rungs[0];
  const Network& first = unit.networks.front();
  describe(rung, first, {hashBytes("@clock", hashBytes(nameOf(language_, unit))), 0});
  rung.number = 0;
  rung.title.clear();
  rung.sourceText.clear();
  rung.lastLine = rung.begin.line;
  rung.weight = 1;
  ir::RungBuilder b(*module_, rung);
  if (level.countsRuns) b.slotStore(level.runs, b.add(b.slotLoad(level.runs), b.i32(1)));
  if (level.level == 0 && execution_.eachSlot) byControl(execution_.eachSlot, context, b, first);
  if (!level.hasClock) return;
  const ir::ValueId now = b.now();
  b.slotStore(level.scanTime, b.sub(now, b.slotLoad(level.clock)));
  b.slotStore(level.clock, now);
}

void ModuleLowering::byControl(const std::function<void(Lowering&)>& add, RoutineContext& routine, ir::RungBuilder& b,
                               const Network& network) {
  Lowering f(*this, routine, b, network, {}, {});
  add(f);
}

std::optional<bool> Execution::constantAt(const Address& bit) const {
  for (const auto& [address, value] : constants)
    if (address == bit) return value;
  return std::nullopt;
}

const Network* ModuleLowering::networkOf(uint32_t unit, const ir::Rung& rung) const {
  const std::vector<Network>& networks = program_.units[unit].networks;
  const auto at = std::ranges::find_if(networks, [&](const Network& network) {
    return network.firstLine == rung.begin.line && fileIndex_.at(network.file.index) == rung.begin.file;
  });
  return at == networks.end() ? nullptr : &*at;
}

void ModuleLowering::addTasks(uint32_t parts) {
  for (const LevelState& level : levels_)
    if (!isAbsent(level.level)) addTask(level, parts);
  addScan(parts);
}

void ModuleLowering::addTask(const LevelState& level, uint32_t parts) {
  const Level& own = language_.levels[level.level];
  const bool inEverySlot = own.turn == Turn::EverySlot;
  const ir::TaskId id{static_cast<uint32_t>(module_->tasks.size())};
  ir::Task& task = module_->tasks.emplace_back(ir::Task{.name = std::string(own.name),
                                                        .entry = level.entry(),
                                                        .periodUs = execution_.slotUs * (inEverySlot ? 1 : parts),
                                                        .budget = execution_.budget,
                                                        .budgetFault = ir::FaultId{0}});
  if (own.turn == Turn::Parts) {
    ir::cutTask(*module_, task, parts);
    module_->mainTask = id;
  } else {
    addResultRegisters(level);
  }
  if (inEverySlot) module_->fastTask = id;
  if (own.latchesInputs())
    for (size_t i = 0; i < spaces_.size(); ++i)
      if (language_.areas[i].use == AreaUse::Input) addLatch(level, i);
}

// Builds the schedule: each slot runs the levels that are due, in order.
void ModuleLowering::addScan(uint32_t parts) {
  const ir::Step advance{.op = RUNG_STEP_ADVANCE, .arg = execution_.slotUs};
  module_->fast.push_back(advance);
  for (uint32_t part = 0; part < parts; ++part) {
    if (part != 0) module_->scan.push_back({.op = RUNG_STEP_SLOT});
    module_->scan.push_back(advance);
    for (const LevelState& level : levels_) {
      const Turn turn = language_.levels[level.level].turn;
      if (isAbsent(level.level) || (turn == Turn::LastSlot && part + 1 != parts)) continue;
      const uint32_t op = turn == Turn::Parts && parts != 1 ? RUNG_STEP_PART : RUNG_STEP_RUN;
      module_->scan.push_back({.op = op, .task = ir::TaskId{level.level}, .arg = 1});
      if (part == 0 && turn == Turn::EverySlot) module_->fast.push_back(module_->scan.back());
    }
  }
}

// Copies the input bytes that the level reads into its latch when the level begins.
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

// P4: each level works on its own set of result registers; between its runs the registers hold those of the main
// program.
void ModuleLowering::addResultRegisters(const LevelState& level) {
  const auto [area, first] = std::pair(indexOf(execution_.results.area), execution_.results.byte);
  const uint32_t bytes = execution_.resultBytes;
  const auto used = level.used[area].begin() + first;
  if (std::find(used, used + bytes, true) == used + bytes) return;
  const ir::SpaceId own = hiddenSpace(resultSpace(level.level), bytes);
  const ir::SpaceId others = hiddenSpace(resultSpace(language_.mainLevel()), bytes);
  const ir::SpaceSpan results{spaces_[area], first, bytes};
  ir::Task& task = module_->tasks[level.level];
  task.begin.push_back({.from = results, .to = others});
  task.begin.push_back({.from = {own, 0, bytes}, .to = results.space, .toByte = first});
  task.end.push_back({.from = results, .to = own});
  task.end.push_back({.from = {others, 0, bytes}, .to = results.space, .toByte = first});
}

std::string ModuleLowering::resultSpace(uint32_t level) const {
  return fmt::format("@{}{}", language_.at(execution_.results.area).letter, level + 1);
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

} // namespace rung::frontend::network
