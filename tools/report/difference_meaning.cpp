// The meaning of a rung as a hash (see difference_meaning.h).
#include "tools/report/difference_meaning.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "ir/core/memory_use.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/hash.h"
#include "ir/support/put.h"
#include "ir/transforms/passes.h"

namespace rung::report {
namespace {

using namespace ir;

// The ordinal ("~1") among similar instructions depends on the others, and says nothing about the instruction.
std::string withoutOrdinals(std::string_view key) {
  std::string text;
  for (size_t at = 0; at < key.size();) {
    const size_t digits = key[at] == '~' ? key.find_first_not_of("0123456789", at + 1) : at;
    const size_t end = std::min(digits, key.size());
    const bool isOrdinal = end > at + 1 && (end == key.size() || key[end] == '/');
    if (isOrdinal)
      at = end;
    else
      text += key[at++];
  }
  return text;
}

// ---- names of places ---------------------------------------------------------------------------------------------

class PlaceTexts {
public:
  PlaceTexts(const Module& module, const FormerNames& former) : module_(module) {
    for (const Symbol& symbol : module.symbols)
      if (symbol.space.valid() && isAllocated(symbol.space)) add(symbol, former);
    for (const Task& task : module.tasks)
      for (const Copy& copy : task.begin)
        if (!copy.masked && isHidden(copy.to) && !isHidden(copy.from.space)) latches_.push_back(&copy);
  }

  bool isAllocated(SpaceId space) const { return (module_.at(space).flags & RUNG_SPACE_ALLOCATED) != 0; }

  // If the compiler assigns addresses: for a bit, the name that begins there; otherwise the variable that begins before
  // it, and the distance. A latch has the name of its source.
  std::string of(SpaceId space, uint64_t bit, bool isBit = false) const {
    for (const Copy* copy : latches_)
      if (copy->to == space && bit / 8 >= copy->toByte && bit / 8 - copy->toByte < copy->from.size)
        return of(copy->from.space, bit - 8 * uint64_t{copy->toByte} + 8 * uint64_t{copy->from.byte}, isBit);
    const auto names = names_.find(space.index);
    if (names == names_.end()) return fmt::format("{}+{}", module_.at(space).name, bit);
    const auto& [variables, bits] = names->second;
    const Names &first = isBit ? bits : variables, &second = isBit ? variables : bits;
    for (const Names* alike : {&first, &second})
      if (const auto at = alike->find(bit); at != alike->end())
        return fmt::format("{}+0", withoutOrdinals(at->second.text));
    const auto next = variables.upper_bound(bit);
    if (next == variables.begin()) return fmt::format("+{}", bit);
    const auto& [begin, name] = *std::prev(next);
    return fmt::format("{}+{}", withoutOrdinals(name.text), bit - begin);
  }

private:
  // Of several at one place, one that both versions have is chosen.
  struct Name {
    bool isNew = false;
    std::string text;
    auto operator<=>(const Name&) const = default;
  };
  using Names = std::map<uint64_t, Name>; // by bit
  struct SpaceNames {
    Names variables;
    Names bits;
  };

  void add(const Symbol& symbol, const FormerNames& former) {
    const auto known = former.find(symbol.name);
    const Name name{known == former.end(), known == former.end() ? symbol.name : known->second};
    SpaceNames& names = names_[symbol.space.index];
    Names& alike = symbol.type == RUNG_TYPE_BIT ? names.bits : names.variables;
    const auto [at, isFirst] = alike.emplace(uint64_t{symbol.byte} * 8 + symbol.bit, name);
    if (!isFirst) at->second = std::min(at->second, name);
  }

  bool isHidden(SpaceId space) const { return (module_.at(space).flags & RUNG_SPACE_HIDDEN) != 0; }

  const Module& module_;
  std::map<uint32_t, SpaceNames> names_; // by allocated space
  std::vector<const Copy*> latches_;
};

// ---- rungs of the module and rungs as drawn -----------------------------------------------------------------------

class Drawing {
public:
  explicit Drawing(const Module& module) : module_(module) {
    for (uint32_t r = 0; r < module.routines.size(); ++r)
      for (uint32_t i = 0; i < module.routines[r].rungs.size(); ++i) add(r, i);
  }

  struct Part {
    uint32_t routine = 0;
    uint32_t rung = 0;
  };
  // In the order of their first parts.
  const std::vector<std::vector<Part>>& rungs() const { return rungs_; }

  // The exit that leads to a rung of the module.
  Exit exitTo(uint32_t routine, uint32_t target) const {
    const std::vector<Rung>& rungs = module_.routines[routine].rungs;
    while (target < rungs.size() && rungs[target].number == 0) ++target;
    if (target >= rungs.size()) return {.to = Exit::To::End, .index = routine};
    const uint32_t drawn = drawn_.at(rungs[target].number);
    uint32_t part = 0; // within its routine: another routine may have the same rungs
    for (const Part& p : rungs_[drawn])
      if (p.routine == routine && p.rung < target) ++part;
    return {.to = Exit::To::Rung, .index = drawn, .part = part};
  }

  // For a routine that exists once for each level, the first one.
  uint32_t homeOf(uint32_t routine) const {
    for (const Rung& rung : module_.routines[routine].rungs)
      if (rung.number != 0) return rungs_[drawn_.at(rung.number)][0].routine;
    return routine;
  }

private:
  void add(uint32_t routine, uint32_t rung) {
    const uint32_t number = module_.routines[routine].rungs[rung].number;
    if (number == 0) return;
    const auto [at, isNew] = drawn_.emplace(number, static_cast<uint32_t>(rungs_.size()));
    if (isNew) rungs_.emplace_back();
    rungs_[at->second].push_back({routine, rung});
  }

  const Module& module_;
  std::vector<std::vector<Part>> rungs_;
  std::unordered_map<uint32_t, uint32_t> drawn_; // by number
};

// ---- cells that select paths ---------------------------------------------------------------------------------------

// The targets of a switch on the number in a cell: what is stored there selects a path.
struct Paths {
  uint32_t routine = 0;
  const std::vector<uint32_t>* targets = nullptr;
};

class PathCells {
public:
  explicit PathCells(const Module& module) {
    for (uint32_t r = 0; r < module.routines.size(); ++r)
      for (const Rung& rung : module.routines[r].rungs)
        if (const Op* op = cellOf(rung)) cells_.try_emplace(cellKey(*op), Paths{r, &rung.transfer.targets});
  }

  // The load whose value the rung's switch uses.
  static const Op* cellOf(const Rung& rung) {
    if (rung.transfer.kind != TransferKind::Switch) return nullptr;
    for (const Op& op : rung.ops)
      if ((op.code == OpCode::SlotLoad || op.code == OpCode::Load) && op.result == rung.transfer.value) return &op;
    return nullptr;
  }
  // Null: no path depends on what the operation stores.
  const Paths* storedBy(const Op& op) const {
    if (op.code != OpCode::SlotStore && op.code != OpCode::Store) return nullptr;
    const auto at = cells_.find(cellKey(op));
    return at == cells_.end() ? nullptr : &at->second;
  }

private:
  using Key = std::tuple<bool, uint32_t, int64_t>;
  static Key cellKey(const Op& op) {
    const bool isSlot = op.code == OpCode::SlotLoad || op.code == OpCode::SlotStore;
    return {isSlot, op.ref, isSlot ? 0 : op.imm};
  }

  std::map<Key, Paths> cells_;
};

// ---- owners of slots ---------------------------------------------------------------------------------------------

// The uses of a slot in drawn rungs: those in rungs that the compiler added follow from them.
class SlotUses {
public:
  void add(const Rung& rung, const Op& op) {
    if (rung.number == 0) return;
    rungs_.insert(rung.number);
    lines_.emplace(rung.begin.file.index, op.line);
    isWritten_ |= op.code == OpCode::SlotStore;
  }
  // An instruction that ends a rung and begins the next one, as one that waits does, is still in one line. A slot that
  // no drawn rung writes is the compiler's own, such as those of its clocks.
  bool ofOneInstruction() const { return isWritten_ && (rungs_.size() == 1 || lines_.size() == 1); }

private:
  std::set<uint32_t> rungs_;
  std::set<std::pair<uint32_t, uint32_t>> lines_; // with their files
  bool isWritten_ = false;
};

// By slot, whether it is the state of more than one instruction.
std::vector<bool> sharedSlots(const Module& module) {
  std::vector<SlotUses> uses(module.slots.size());
  for (const Routine& routine : module.routines)
    for (const Rung& rung : routine.rungs)
      for (const Op& op : rung.ops)
        if (opInfo(op.code).attr == Attr::Slot) uses[op.ref].add(rung, op);
  std::vector<bool> shared;
  for (size_t i = 0; i < uses.size(); ++i) {
    const Slot& slot = module.slots[i];
    shared.push_back(slot.transient || slot.key.starts_with('@') || !uses[i].ofOneInstruction());
  }
  return shared;
}

// ---- meanings ----------------------------------------------------------------------------------------------------

class Meanings {
public:
  Meanings(const Module& module, const GivenNumbers& given, const FormerNames& former, std::vector<bool> shared)
      : module_(module), given_(given), former_(former), drawing_(module), pathCells_(module), places_(module, former),
        shared_(std::move(shared)) {}

  std::vector<DrawnRung> run() {
    std::vector<DrawnRung> drawn;
    for (const std::vector<Drawing::Part>& parts : drawing_.rungs()) drawn.push_back(meaningOf(parts));
    return drawn;
  }

private:
  // A unit that two levels run exists twice: parts that both have count once.
  DrawnRung meaningOf(const std::vector<Drawing::Part>& parts) {
    DrawnRung drawn;
    drawn.routine = &module_.routines[parts[0].routine];
    drawn.rung = &longestOf(parts);
    std::set<std::string> seen;
    std::string all;
    for (size_t i = 0; i < parts.size();) {
      const uint32_t routine = parts[i].routine;
      std::string text;
      std::vector<Exit> exits;
      own_.clear();
      ownCells_.clear();
      for (; i < parts.size() && parts[i].routine == routine; ++i) add(routine, parts[i].rung, text, exits);
      if (!seen.insert(text).second) continue;
      all += text;
      drawn.exits.insert(drawn.exits.end(), exits.begin(), exits.end());
    }
    drawn.meaning = hashBytes(all);
    return drawn;
  }

  // All parts begin in the same line. The one that ends last has the lines of all others, too.
  const Rung& longestOf(const std::vector<Drawing::Part>& parts) const {
    const std::vector<Rung>& rungs = module_.routines[parts[0].routine].rungs;
    const Rung* longest = &rungs[parts[0].rung];
    for (const Drawing::Part& part : parts)
      if (part.routine == parts[0].routine && rungs[part.rung].lastLine > longest->lastLine)
        longest = &rungs[part.rung];
    return *longest;
  }

  void add(uint32_t routine, uint32_t number, std::string& out, std::vector<Exit>& exits) {
    const Rung& rung = module_.routines[routine].rungs[number];
    routine_ = ir::homeOf(module_.routines[routine], rung);
    numbers_.clear();
    for (const GivenNumber& given : given_.of(RoutineId{routine}, number)) numbers_.emplace(given.value.index, &given);
    findExits(rung);
    for (const Op& op : rung.ops)
      if (op.code != OpCode::Note) addOp(rung, op, out, exits);
    addTransfer(routine, rung, out, exits);
    out += '\n';
  }

  // Constants that may be stored in a cell that selects paths, also as one of several alternatives.
  void findExits(const Rung& rung) {
    pathsOf_.clear();
    std::unordered_map<uint32_t, const Op*> definitions;
    for (const Op& op : rung.ops)
      if (op.resultCount == 1) definitions.emplace(op.result.index, &op);
    for (const Op& op : rung.ops) {
      const Paths* paths = pathCells_.storedBy(op);
      if (paths == nullptr) continue;
      std::vector<ValueId> open{arg(rung, op, 0)};
      while (!open.empty()) {
        const auto at = definitions.find(open.back().index);
        open.pop_back();
        if (at == definitions.end()) continue;
        const Op& source = *at->second;
        if (source.code == OpCode::Const) pathsOf_.emplace(source.result.index, paths);
        if (source.code == OpCode::Select) open.insert(open.end(), {arg(rung, source, 1), arg(rung, source, 2)});
      }
    }
  }

  void addTransfer(uint32_t routine, const Rung& rung, std::string& out, std::vector<Exit>& exits) const {
    const Transfer& transfer = rung.transfer;
    put(out, "{} {}", static_cast<int>(transfer.kind), transfer.cond.index);
    if (transfer.kind == TransferKind::Call)
      exits.push_back({.to = Exit::To::Routine, .index = drawing_.homeOf(transfer.callee.index)});
    if (transfer.kind == TransferKind::Goto) exits.push_back(drawing_.exitTo(routine, transfer.target));
    // The exits are those of the rungs that store the number.
    if (transfer.kind != TransferKind::Switch || PathCells::cellOf(rung) != nullptr) return;
    put(out, " {} of {}", transfer.value.index, transfer.targets.size());
    for (const uint32_t target : transfer.targets) exits.push_back(drawing_.exitTo(routine, target));
  }

  void addOp(const Rung& rung, const Op& op, std::string& out, std::vector<Exit>& exits) {
    put(out, "{} {}", static_cast<int>(op.code), static_cast<int>(op.type));
    for (int i = 0; i < op.argCount; ++i) put(out, " %{}", arg(rung, op, i).index);
    if (op.code == OpCode::Const)
      addNumber(op, out, exits);
    else
      addAttribute(op, out);
    out += '\n';
  }

  void addNumber(const Op& op, std::string& out, std::vector<Exit>& exits) {
    if (const auto at = pathsOf_.find(op.result.index); at != pathsOf_.end()) {
      const std::vector<uint32_t>& targets = *at->second->targets;
      const auto path = static_cast<uint64_t>(op.imm);
      exits.push_back(drawing_.exitTo(at->second->routine, path < targets.size() ? targets[path] : targets.at(0)));
      return put(out, " path");
    }
    const auto at = numbers_.find(op.result.index);
    if (at == numbers_.end()) return put(out, " {}", op.imm);
    const GivenNumber& given = *at->second;
    if (given.routine.valid()) {
      exits.push_back({.to = Exit::To::Routine, .index = drawing_.homeOf(given.routine.index)});
      return put(out, " routine");
    }
    if (!given.space.valid()) return;
    out += " at";
    addPlace(given.space, given.byte * uint64_t{8} + given.bit, false, out);
    put(out, "+{}", given.distance);
  }

  void addAttribute(const Op& op, std::string& out) {
    switch (opInfo(op.code).attr) {
    case Attr::Place: return addPlace(SpaceId{op.ref}, static_cast<uint64_t>(op.imm), op.type == Type::Bit, out);
    case Attr::Window: return addWindow(op, out);
    case Attr::Slot: return addSlot(op.ref, out);
    case Attr::Service: return put(out, " {}", module_.services[op.ref]);
    case Attr::Fault: return put(out, " {}", module_.faults[op.ref]);
    case Attr::Literal:
    case Attr::ResultNo: return put(out, " {}", op.imm);
    case Attr::Count: return put(out, " {}", op.count);
    case Attr::MessageOp: return put(out, " {}", op.ref);
    case Attr::BranchWeights:
    case Attr::Text:
    case Attr::None: return;
    }
  }

  // A window that covers everything that the compiler assigns grows with it.
  void addWindow(const Op& op, std::string& out) {
    const SpaceId id{op.ref};
    const Space& space = module_.at(id);
    const uint32_t bytes = space.unitBytes * space.units;
    const bool isBit = op.code == OpCode::LoadBitAt || op.code == OpCode::StoreBitAt;
    const uint32_t width = isBit ? 1 : byteWidth(op.type);
    if (places_.isAllocated(id) && op.imm == 0 && space.unitBytes == 1 && op.count + width - 1 == bytes)
      return put(out, " {}", space.name);
    addPlace(id, static_cast<uint64_t>(op.imm), isBit, out);
    put(out, " {}", op.count);
  }

  // Private cells of an instruction are identified by their order, as its slots are.
  void addPlace(SpaceId space, uint64_t bit, bool isBit, std::string& out) {
    const std::string text = places_.of(space, bit, isBit);
    const bool own = places_.isAllocated(space) && (module_.at(space).flags & RUNG_SPACE_HIDDEN) != 0;
    if (own)
      put(out, " own cell {}", ownCells_.emplace(text, ownCells_.size()).first->second);
    else
      put(out, " {}", text);
  }

  void addSlot(uint32_t slot, std::string& out) {
    const Slot& info = module_.slots[slot];
    if (shared_[slot]) {
      if (const auto known = former_.find(info.key); known != former_.end()) return put(out, " {}", known->second);
      std::string_view key = info.key;
      if (key.starts_with(routine_)) key.remove_prefix(routine_.size()); // equal for a subroutine of another name
      return put(out, " {}", withoutOrdinals(key));
    }
    const auto number = own_.emplace(slot, own_.size()).first->second;
    put(out, " own {} {} {}", number, static_cast<int>(info.type), info.init);
  }

  const Module& module_;
  const GivenNumbers& given_;
  const FormerNames& former_;
  const Drawing drawing_;
  const PathCells pathCells_;
  const PlaceTexts places_;
  const std::vector<bool> shared_; // by slot
  // Of the current rung.
  std::string_view routine_;
  std::map<uint32_t, size_t> own_; // the rung's private slots, in the order of first use
  std::map<std::string, size_t> ownCells_;
  std::unordered_map<uint32_t, const GivenNumber*> numbers_;
  std::unordered_map<uint32_t, const Paths*> pathsOf_; // constants that select paths
};

} // namespace

// In a module, source lines determine the order of operations. Here they are in the order in which they are needed.
std::vector<DrawnRung> drawnRungs(const Module& module, const GivenNumbers& given, const FormerNames& former) {
  std::vector<bool> shared = sharedSlots(module);
  Module ordered = module;
  GivenNumbers numbers = given;
  for (Routine& routine : ordered.routines)
    for (Rung& rung : routine.rungs)
      for (Op& op : rung.ops) op.line = 0;
  orderOperations(ordered, nullptr, &numbers);
  std::vector<DrawnRung> drawn = Meanings(ordered, numbers, former, std::move(shared)).run();
  for (DrawnRung& rung : drawn) {
    const Routine& routine = module.routines[static_cast<size_t>(rung.routine - ordered.routines.data())];
    rung.rung = &routine.rungs[static_cast<size_t>(rung.rung - rung.routine->rungs.data())];
    rung.routine = &routine;
  }
  return drawn;
}

} // namespace rung::report
