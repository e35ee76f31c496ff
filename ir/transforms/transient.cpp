// Removes stores to transient slots, the registers between rungs, that no load reads on any path that control can take:
// within the rung (overwritten first) and over the rungs that follow, up to the end of the task's run.
//
// A slot that a task may read before it has stored it is not changed, because it carries a value from one run to the
// next. Neither is one that is needed where a part of a task may end, if another task stores it, too. Each slot is
// followed backward from its loads only as far as it is needed, so short-lived slots cost little; should all of them
// together take more than some walks over the whole program, the rest is not changed.
//
// Whether a slot is needed is determined from the optimised code; but forces insert code that computes other values,
// and may begin and end between two runs or two parts of one. What one run leaves for another is therefore not
// transient, so that both codes store it (keepCarried, before anything is known about values).
#include <algorithm>

#include "ir/analysis/rung_graph.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {
namespace {

constexpr uint64_t kMaxWalks = 256; // over the whole program

// The accesses of a rung to a slot.
struct Access {
  uint32_t slot;
  uint32_t node;
  bool exposed = false; // may be loaded before this rung stores it
  bool stores = false;
  bool kills = false; // is certainly stored
  bool loadsInLoop = false;
  bool neededAfter = true;
  bool leftAlone = false;
};

// The accesses of all rungs to transient slots.
class AccessList {
public:
  explicit AccessList(const Module& module) : module_(module), indexOf_(module.slots.size(), 0) {
    firstOfNode_.push_back(0);
    for (const Routine& routine : module.routines)
      for (const Rung& rung : routine.rungs) add(rung);
  }
  std::vector<Access>& all() { return all_; }
  std::span<Access> of(uint32_t node) {
    return {all_.data() + firstOfNode_[node], all_.data() + firstOfNode_[node + 1]};
  }

private:
  Access& accessTo(uint32_t slot) {
    const uint32_t first = firstOfNode_.back();
    uint32_t& index = indexOf_[slot];
    if (index < first || index >= all_.size() || all_[index].slot != slot) {
      index = static_cast<uint32_t>(all_.size());
      all_.push_back({.slot = slot, .node = static_cast<uint32_t>(firstOfNode_.size()) - 1});
    }
    return all_[index];
  }

  void add(const Rung& rung) {
    stored_.clear();
    open_.clear();
    uint32_t loops = 0;
    for (const Op& op : rung.ops) {
      if (op.code == OpCode::Loop) ++loops;
      if (op.code == OpCode::EndLoop) --loops;
      if (op.code == OpCode::Else || op.code == OpCode::EndIf || op.code == OpCode::EndLoop) close();
      if (op.code == OpCode::If || op.code == OpCode::Else || op.code == OpCode::Loop) open_.push_back(stored_.size());
      if (opInfo(op.code).attr == Attr::Slot && module_.slots[op.ref].transient) add(op, loops != 0);
    }
    firstOfNode_.push_back(static_cast<uint32_t>(all_.size()));
  }

  // While the walk is in a region, `kills` means: certainly stored when control reaches this point.
  void add(const Op& op, bool inLoop) {
    Access& access = accessTo(op.ref);
    if (op.code == OpCode::SlotLoad) {
      access.exposed = access.exposed || !access.kills;
      access.loadsInLoop = access.loadsInLoop || inLoop;
      return;
    }
    access.stores = true;
    if (!access.kills) stored_.push_back(op.ref);
    access.kills = true;
  }
  void close() {
    for (; stored_.size() > open_.back(); stored_.pop_back()) accessTo(stored_.back()).kills = false;
    open_.pop_back();
  }

  const Module& module_;
  std::vector<Access> all_;
  std::vector<uint32_t> firstOfNode_; // by node, plus one entry
  std::vector<uint32_t> indexOf_;     // by slot: its last access
  std::vector<uint32_t> stored_;      // slots that are certainly stored, in the order of their stores
  std::vector<size_t> open_;          // size of stored_ at the beginning of each open region
};

// Follows each slot backward from the rungs that need it to those that store it, and leaves slots unchanged that are
// needed where code other than the rungs before may have stored them.
class SlotFlow {
public:
  enum class Others : uint8_t { Tasks, RunsAndParts };
  SlotFlow(const Module& module, std::vector<Access>& accesses, Others others)
      : module_(module), graph_(module), accesses_(accesses), others_(others) {
    needed_.assign(graph_.nodeCount(), 0);
    neededAfter_.assign(graph_.nodeCount(), 0);
    killed_.assign(graph_.nodeCount(), 0);
    begins_.assign(graph_.nodeCount(), false);
    pauses_.assign(graph_.nodeCount(), false);
    for (const Task& task : module.tasks) {
      begins_[graph_.nodeOf(task.entry, 0)] = true;
      findPauses(task);
    }
    work_ = kMaxWalks * (graph_.nodeCount() + accesses.size());
    findSharedSlots();
  }

  void run() {
    std::vector<uint32_t> first(module_.slots.size() + 1, 0); // accesses in the order of slots
    for (const Access& access : accesses_) ++first[access.slot + 1];
    for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<uint32_t> order(accesses_.size());
    std::vector<uint32_t> next(first.begin(), first.end() - 1);
    for (uint32_t i = 0; i < accesses_.size(); ++i) order[next[accesses_[i].slot]++] = i;
    for (uint32_t slot = 0; slot < module_.slots.size(); ++slot)
      if (first[slot] != first[slot + 1]) follow(slot, {order.data() + first[slot], order.data() + first[slot + 1]});
  }

private:
  // A part ends before the first rung beyond its border that control reaches.
  void findPauses(const Task& task) {
    const auto rungs = static_cast<uint32_t>(module_.at(task.entry).rungs.size());
    const uint32_t first = rungs == 0 ? 0 : graph_.nodeOf(task.entry, 0);
    for (const uint32_t border : task.borders)
      for (uint32_t i = border; i < rungs; ++i)
        if (i == border || std::ranges::any_of(graph_.predecessors(first + i), [&](uint32_t before) {
              return before >= first && before < first + border;
            }))
          pauses_[first + i] = true;
  }

  // The mark of a slot is its number plus one.
  void follow(uint32_t slot, std::span<const uint32_t> accesses) {
    const uint32_t mark = slot + 1;
    leaveAlone_ = false;
    for (uint32_t i : accesses)
      if (accesses_[i].kills) killed_[accesses_[i].node] = mark;
    for (uint32_t i : accesses)
      if (accesses_[i].exposed) need(accesses_[i].node, slot);
    while (!open_.empty()) {
      const uint32_t node = open_.back();
      open_.pop_back();
      for (uint32_t before : graph_.predecessors(node)) {
        if (work_ == 0)
          leaveAlone_ = true;
        else
          --work_;
        neededAfter_[before] = mark;
        if (killed_[before] != mark && !leaveAlone_) need(before, slot);
      }
    }
    for (uint32_t i : accesses) {
      accesses_[i].neededAfter = neededAfter_[accesses_[i].node] == mark;
      accesses_[i].leftAlone = leaveAlone_;
    }
  }

  void need(uint32_t node, uint32_t slot) {
    if (needed_[node] == slot + 1) return;
    needed_[node] = slot + 1;
    open_.push_back(node);
    const bool isOthers = others_ == Others::RunsAndParts || shared_[slot];
    if (begins_[node] || (pauses_[node] && isOthers)) leaveAlone_ = true;
  }

  // Finds slots that the routines of several tasks store.
  void findSharedSlots() {
    constexpr uint32_t kNobody = RUNG_NONE;
    std::vector<uint32_t> taskOf(module_.slots.size(), kNobody); // the last task that stores it
    shared_.assign(module_.slots.size(), false);
    std::vector<uint32_t> routineOfNode;
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      routineOfNode.insert(routineOfNode.end(), module_.routines[r].rungs.size(), r);
    std::vector<std::vector<uint32_t>> storedIn(module_.routines.size());
    for (const Access& access : accesses_)
      if (access.stores) storedIn[routineOfNode[access.node]].push_back(access.slot);
    for (uint32_t t = 0; t < module_.tasks.size(); ++t) {
      for (const RoutineId routine : routinesFrom(module_, module_.tasks[t].entry)) {
        for (uint32_t slot : storedIn[routine.index]) {
          if (taskOf[slot] != kNobody && taskOf[slot] != t) shared_[slot] = true;
          taskOf[slot] = t;
        }
      }
    }
  }

  const Module& module_;
  RungGraph graph_;
  std::vector<Access>& accesses_;
  const Others others_;
  std::vector<uint32_t> needed_;      // by node: mark of the slot that is needed at its beginning
  std::vector<uint32_t> neededAfter_; // by node: at its end
  std::vector<uint32_t> killed_;      // by node: certainly stored there
  std::vector<bool> begins_;          // by node: a task begins with this rung
  std::vector<bool> pauses_;          // by node: a part of a task may end before this rung
  std::vector<bool> shared_;          // by slot
  std::vector<uint32_t> open_;
  uint64_t work_ = 0;
  bool leaveAlone_ = false;
};

// Removes the dead stores of one rung.
class StoreRemover {
public:
  explicit StoreRemover(const Module& module) : module_(module), state_(module.slots.size()) {}

  // Whether it has removed any.
  bool run(Rung& rung, std::span<const Access> accesses) {
    bool stores = false;
    for (const Access& access : accesses) {
      state_[access.slot] = {.needed = access.neededAfter || access.leftAlone,
                             .leftAlone = access.leftAlone,
                             .loadsInLoop = access.loadsInLoop};
      stores = stores || (access.stores && !access.leftAlone);
    }
    if (!stores || !findDead(rung)) return false;
    writer_.start(rung);
    for (size_t i = 0; i < rung.ops.size(); ++i)
      if (dead_[i] == 0) writer_.copy(rung.ops[i]);
    writer_.finish(rung);
    return true;
  }

private:
  struct State {
    bool needed = true; // at the current point of the walk
    bool leftAlone = false;
    bool loadsInLoop = false;
  };

  // Walks backward. A store in a region does not make earlier ones dead, and what one region needs also counts for the
  // other.
  bool findDead(const Rung& rung) {
    dead_.assign(rung.ops.size(), 0);
    bool any = false;
    uint32_t regions = 0;
    uint32_t loops = 0;
    for (size_t i = rung.ops.size(); i-- > 0;) {
      const Op& op = rung.ops[i];
      if (op.code == OpCode::EndIf || op.code == OpCode::EndLoop) ++regions;
      if (op.code == OpCode::If || op.code == OpCode::Loop) --regions;
      if (op.code == OpCode::EndLoop) ++loops;
      if (op.code == OpCode::Loop) --loops;
      if (opInfo(op.code).attr != Attr::Slot || !module_.slots[op.ref].transient) continue;
      State& state = state_[op.ref];
      if (op.code == OpCode::SlotLoad) {
        state.needed = true;
      } else if (!state.needed && !(loops != 0 && state.loadsInLoop)) {
        dead_[i] = 1;
        any = true;
      } else if (regions == 0 && !state.leftAlone) {
        state.needed = false;
      }
    }
    return any;
  }

  const Module& module_;
  RungRewriter writer_;
  std::vector<State> state_; // by slot; set for those that the rung accesses
  std::vector<uint8_t> dead_;
};

} // namespace

void keepCarried(Module& module) {
  AccessList accesses(module);
  if (accesses.all().empty()) return;
  SlotFlow(module, accesses.all(), SlotFlow::Others::RunsAndParts).run();
  for (const Access& access : accesses.all())
    if (access.leftAlone) module.slots[access.slot].transient = false;
}

void removeTransientStores(Module& module, Settled& settled) {
  AccessList accesses(module);
  if (accesses.all().empty()) return;
  SlotFlow(module, accesses.all(), SlotFlow::Others::Tasks).run();
  StoreRemover remover(module);
  uint32_t node = 0;
  settled.eachOpen(module, kNothingSettled, [&](Rung& rung, uint32_t, uint8_t before) -> uint8_t {
    return remover.run(rung, accesses.of(node++)) ? before & kFolded : before;
  });
}

} // namespace rung::ir
