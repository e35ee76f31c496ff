// The rules on declarations, routines and calls (see verify.h).
#include <algorithm>
#include <fmt/format.h>
#include <unordered_set>

#include "ir/core/eval.h"
#include "ir/verify/rules.h"
#include "rung/types.hpp"

namespace rung::ir {

uint64_t byteCount(const Space& space) { return uint64_t{space.units} * space.unitBytes; }

bool ModuleCheck::inside(SpaceId space, uint64_t byte, uint64_t size) const {
  if (space.index >= module.spaces.size()) return false;
  const uint64_t all = byteCount(module.at(space));
  return byte <= all && size <= all - byte;
}

namespace {

constexpr uint64_t kMaxBytes = 1ull << 28; // so that 32 bits can number their bits (BitRange)
constexpr uint32_t kSpaceFlagMask = RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT | RUNG_SPACE_HIDDEN | RUNG_SPACE_ALLOCATED;
constexpr uint32_t kSymbolFlagMask = RUNG_SYMBOL_READONLY | RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST | RUNG_SYMBOL_AREA;

template <class Items, class NameOf>
void checkUnique(ModuleCheck& check, std::string_view kind, const Items& items, NameOf nameOf) {
  std::unordered_set<std::string_view> seen;
  for (const auto& item : items) {
    const std::string_view name = nameOf(item);
    if (name.empty())
      check.fail(Rule::Names, fmt::format("a {} without a name", kind));
    else if (!seen.insert(name).second)
      check.fail(Rule::Names, fmt::format("two {}s are named '{}'", kind, name));
  }
}

void checkNames(ModuleCheck& check) {
  const Module& m = check.module;
  const auto itself = [](const std::string& name) { return std::string_view(name); };
  const auto named = [](const auto& item) { return std::string_view(item.name); };
  checkUnique(check, "file", m.files, itself);
  checkUnique(check, "space", m.spaces, named);
  checkUnique(check, "slot", m.slots, [](const Slot& slot) { return std::string_view(slot.key); });
  checkUnique(check, "routine", m.routines, named);
  checkUnique(check, "task", m.tasks, named);
  checkUnique(check, "fault", m.faults, itself);
  checkUnique(check, "service", m.services, itself);
  std::unordered_set<uint32_t> numbers;
  for (const MessageText& message : m.messages)
    if (!numbers.insert(message.number).second)
      check.fail(Rule::Names, fmt::format("two messages have number {}", message.number));
  for (const Symbol& symbol : m.symbols)
    if (symbol.name.empty()) check.fail(Rule::Names, "a symbol without a name");
}

void checkSpaces(ModuleCheck& check) {
  uint64_t all = 0;
  for (const Space& space : check.module.spaces) {
    const uint32_t unit = space.unitBytes;
    if (unit != 1 && unit != 2 && unit != 4 && unit != 8)
      check.fail(Rule::Spaces, fmt::format("space {} has units of {} bytes", space.name, unit));
    all += byteCount(space);
    if ((space.flags & ~kSpaceFlagMask) != 0)
      check.fail(Rule::Spaces, fmt::format("space {} has unknown flags", space.name));
  }
  if (all > kMaxBytes) check.fail(Rule::Spaces, "the spaces are larger than 256 MB together");
}

void checkSlots(ModuleCheck& check) {
  for (const Slot& slot : check.module.slots) {
    if (slot.type == Type::None)
      check.fail(Rule::Slots, fmt::format("slot \"{}\" has no type", slot.key));
    else if ((static_cast<uint64_t>(slot.init) & ~valueMask(slot.type)) != 0)
      check.fail(Rule::Slots, fmt::format("slot \"{}\" cannot hold its initial value", slot.key));
  }
}

void checkContinuations(ModuleCheck& check) {
  const Module& m = check.module;
  checkUnique(check, "continuation", m.continuations, [](const Continuation& c) { return std::string_view(c.key); });
  for (const Continuation& c : m.continuations) {
    const auto fail = [&](std::string_view what) {
      check.fail(Rule::Slots, fmt::format("continuation \"{}\" {}", c.key, what));
    };
    const auto fits = [&](const Slot& slot) { return slot.type == Type::I32 && !slot.transient; };
    if (c.slot.valid() ? c.slot.index >= m.slots.size() || !fits(m.slots[c.slot.index])
                       : !check.inside(c.space, c.byte, 4))
      fail("is not in a cell of 32 bits");
    if (c.points.empty()) fail("has no points");
    if (std::unordered_set<std::string_view>(c.points.begin(), c.points.end()).size() != c.points.size())
      fail("has two points with one key");
  }
}

void checkTimers(ModuleCheck& check) {
  const Module& m = check.module;
  for (const Timer& timer : m.timers) {
    const auto fail = [&](std::string_view what) {
      check.fail(Rule::Slots, fmt::format("timer \"{}\" {}", timer.name, what));
    };
    const auto isCell = [&](const TimerCell& cell) {
      if (cell.type != Type::I8 && cell.type != Type::I16 && cell.type != Type::I32 && cell.type != Type::I64)
        return false;
      return cell.slot.valid() ? cell.slot.index < m.slots.size() && m.slots[cell.slot.index].type == cell.type &&
                                     !m.slots[cell.slot.index].transient
                               : check.inside(cell.space, cell.byte, byteWidth(cell.type));
    };
    if ((timer.flags & ~(RUNG_TIMER_DOWN | RUNG_TIMER_RUNS)) != 0) fail("has unknown flags");
    if (!isCell(timer.time)) fail("has no cell for its time");
    if (timer.preset.type != Type::None && !isCell(timer.preset)) fail("has no cell for its preset");
    if (timer.unit.type != Type::None && !isCell(timer.unit)) fail("has no cell for its unit");
    if (timer.unitsUs.empty()) fail("has no unit");
    if (!timer.running.valid()) continue;
    if (timer.running.index >= m.slots.size() || m.slots[timer.running.index].type != Type::Bit ||
        m.slots[timer.running.index].transient)
      fail("has no slot that says whether it runs");
  }
}

void checkSymbols(ModuleCheck& check) {
  for (const Symbol& s : check.module.symbols) {
    const auto fail = [&](std::string_view what) {
      check.fail(Rule::Symbols, fmt::format("symbol {} {}", s.name, what));
    };
    const uint64_t bits = elementBits(s.type);
    if (bits == 0) fail("has an unknown type");
    if ((s.flags & ~kSymbolFlagMask) != 0) fail("has unknown flags");
    if (s.bit > 7 || (s.type != RUNG_TYPE_BIT && s.bit != 0)) fail("begins within a byte");
    if (s.count == 0) fail("has no elements");
    if ((s.flags & RUNG_SYMBOL_CONST) != 0 && !s.space.valid()) continue;
    if (!check.inside(s.space, s.byte, (s.bit + bits * s.count + 7) / 8)) fail("lies outside its space");
  }
}

void checkSpans(ModuleCheck& check) {
  for (const Init& init : check.module.inits)
    if (!check.inside(init.space, init.byte, init.data.size()))
      check.fail(Rule::Spans, fmt::format("an initial value at byte {} lies outside its space", init.byte));
  for (const SpaceSpan& span : check.module.retains)
    if (!check.inside(span.space, span.byte, span.size))
      check.fail(Rule::Spans, fmt::format("a retained piece at byte {} lies outside its space", span.byte));
  for (const SpaceSpan& span : check.module.safeSpans)
    if (!check.inside(span.space, span.byte, span.size))
      check.fail(Rule::Spans, fmt::format("a safe piece at byte {} lies outside its space", span.byte));
}

void checkCopy(ModuleCheck& check, const Task& task, const Copy& copy) {
  const auto fail = [&](std::string_view what) {
    check.fail(Rule::Copies, fmt::format("a copy of task {} {}", task.name, what));
  };
  const uint64_t size = copy.from.size;
  if (size == 0) fail("copies nothing");
  if (!check.inside(copy.from.space, copy.from.byte, size)) fail("reads outside its space");
  if (!check.inside(copy.to, copy.toByte, size)) fail("writes outside its space");
  if (copy.masked ? !check.inside(copy.mask, copy.maskByte, size) : copy.mask.valid() || copy.maskByte != 0)
    fail(copy.masked ? "has a mask outside its space" : "has a mask that it does not use");
  if (copy.from.space == copy.to && copy.from.byte < copy.toByte + size && copy.toByte < copy.from.byte + size)
    fail("overlaps itself");
}

void checkCopies(ModuleCheck& check) {
  for (const Task& task : check.module.tasks) {
    for (const Copy& copy : task.begin) checkCopy(check, task, copy);
    for (const Copy& copy : task.end) checkCopy(check, task, copy);
  }
}

// Borders must be rungs after the first one, ascending, and not more than the parts need.
bool hasSoundBorders(const Module& module, const Task& task) {
  if (task.borders.size() >= std::max(task.parts, 1u)) return false;
  uint32_t last = 0;
  for (const uint32_t rung : task.borders) {
    if (rung <= last || rung >= module.at(task.entry).rungs.size()) return false;
    last = rung;
  }
  return true;
}

void checkTasks(ModuleCheck& check) {
  for (const Task& task : check.module.tasks) {
    const auto fail = [&](std::string_view what) {
      check.fail(Rule::Tasks, fmt::format("task {} {}", task.name, what));
    };
    if (task.entry.index >= check.module.routines.size())
      fail("has no entry");
    else if (!hasSoundBorders(check.module, task))
      fail("has borders of parts that are not rungs in order, or too many");
    if (task.budgetFault.index >= check.module.faults.size()) fail("has no fault for its budget");
    if (task.parts == 0) fail("has no parts");
    if (task.budget == 0) fail("has no budget");
  }
}

uint64_t advances(const std::vector<Step>& steps) {
  uint64_t us = 0;
  for (const Step& step : steps) us += step.op == RUNG_STEP_ADVANCE ? step.arg : 0;
  return us;
}

// Whether time passes, so that a real clock waits between two scans.
bool takesTime(const Module& m) {
  if (advances(m.scan) != 0) return true;
  return m.mainTask.index >= m.tasks.size() || m.tasks[m.mainTask.index].periodUs != 0;
}

void checkSchedule(ModuleCheck& check) {
  const Module& m = check.module;
  const size_t errorsBefore = check.errorCount();
  const auto exists = [&](TaskId task) { return task.index < m.tasks.size(); };
  if (!exists(m.mainTask) && (check.mode == Mode::Final || m.mainTask.valid()))
    check.fail(Rule::Schedule, "there is no main task");
  if (!exists(m.fastTask) && m.fastTask.valid()) check.fail(Rule::Schedule, "the fast task does not exist");
  for (const std::vector<Step>* steps : {&m.scan, &m.fast, &m.slices})
    for (const Step& step : *steps) {
      const bool needsTask = step.op == RUNG_STEP_RUN || step.op == RUNG_STEP_PART;
      if (step.op > RUNG_STEP_SLOT)
        check.fail(Rule::Schedule, fmt::format("there is no step {}", step.op));
      else if (needsTask != exists(step.task) || needsTask != step.task.valid())
        check.fail(Rule::Schedule, needsTask ? "a step without its task" : "a step with a task that it does not use");
    }
  if (!m.slices.empty() && advances(m.slices) != advances(m.scan))
    check.fail(Rule::Schedule, "the slices do not take the time of a scan");
  if (check.mode == Mode::Final && check.errorCount() == errorsBefore && !takesTime(m))
    check.fail(Rule::Schedule, "a scan takes no time");
}

void checkRoutines(ModuleCheck& check) {
  for (uint32_t i = 0; i < check.module.routines.size(); ++i)
    if (check.module.routines[i].rungs.empty()) check.fail(Rule::Routines, "there is no rung", RoutineId{i});
}

// Depth-first over the calls, without recursion: a loop of 100,000 routines must not overflow the compiler's stack.
class CallWalk {
public:
  explicit CallWalk(ModuleCheck& check) : check_(check), depth_(check.module.routines.size(), kUnseen) {}

  void run() {
    for (uint32_t i = 0; i < depth_.size(); ++i)
      if (depth_[i] == kUnseen) visit(i);
  }

private:
  static constexpr uint32_t kUnseen = UINT32_MAX;
  static constexpr uint32_t kOpen = UINT32_MAX - 1;
  struct Frame {
    uint32_t routine;
    uint32_t rung;
    uint32_t depth; // depth of calls below this routine, so far
  };

  void visit(uint32_t root) {
    std::vector<Frame> frames;
    open(frames, root);
    while (!frames.empty()) {
      Frame& top = frames.back();
      const std::vector<Rung>& rungs = check_.module.routines[top.routine].rungs;
      if (top.rung == rungs.size()) {
        depth_[top.routine] = top.depth;
        frames.pop_back();
        continue;
      }
      const Transfer& transfer = rungs[top.rung].transfer;
      const uint32_t callee = transfer.callee.index;
      if (transfer.kind != TransferKind::Call)
        ++top.rung;
      else if (depth_[callee] == kUnseen)
        open(frames, callee); // this rung is visited again afterwards
      else {
        follow(top, callee);
        ++top.rung;
      }
    }
  }

  void open(std::vector<Frame>& frames, uint32_t routine) {
    depth_[routine] = kOpen;
    frames.push_back({routine, 0, 0});
  }

  void follow(Frame& top, uint32_t callee) {
    const auto op = static_cast<uint32_t>(check_.module.routines[top.routine].rungs[top.rung].ops.size());
    if (depth_[callee] == kOpen)
      return check_.fail(Rule::Calls, "routines call each other in a loop", RoutineId{top.routine}, top.rung, op);
    top.depth = std::max(top.depth, depth_[callee] + 1);
    // Reported where it is first exceeded; for callers the depth is limited, so they do not report it again.
    if (top.depth <= kLimit) return;
    check_.fail(Rule::Calls, fmt::format("calls are nested more than {} deep", kLimit), RoutineId{top.routine},
                top.rung, op);
    top.depth = kLimit;
  }

  // One entry of the stack belongs to the host.
  static constexpr uint32_t kLimit = RUNG_STACK_DEPTH - 1;

  ModuleCheck& check_;
  std::vector<uint32_t> depth_; // depth of calls below each routine
};

} // namespace

bool checkModule(ModuleCheck& check) {
  for (void (*rule)(ModuleCheck&) : {checkNames, checkSpaces, checkSlots, checkContinuations, checkTimers, checkSymbols,
                                     checkSpans, checkCopies, checkTasks, checkSchedule, checkRoutines})
    rule(check);
  return check.errorCount() == 0;
}

void checkCalls(ModuleCheck& check) { CallWalk(check).run(); }

} // namespace rung::ir
