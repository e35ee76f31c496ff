// A latch that a task copies at its beginning is read from its source instead, as long as the source has the same
// value: nothing writes it until the task has ended. A latch without reads is no longer copied.
//
// Only for a task whose run is undivided: between two parts of a run the machine, the NC and other tasks write.
#include <algorithm>

#include "ir/core/memory_use.h"
#include "ir/transforms/passes.h"

namespace rung::ir {
namespace {

constexpr uint32_t kNoTask = RUNG_NONE;
constexpr uint32_t kSeveralTasks = RUNG_NONE - 1;

bool contains(const BitRange& whole, const BitRange& part) {
  return whole.space == part.space && whole.first <= part.first && part.first + part.count <= whole.first + whole.count;
}

struct Latch {
  uint32_t task = kNoTask; // the task that copies it
  BitRange source;
  BitRange held;

  bool isMadeBy(const Copy& copy) const {
    return !copy.masked && source == bitsOf(copy.from) && held == targetOf(copy);
  }
};

// Only rungs know its name, and its bits are numbered like those of its source.
bool isLatch(const Module& module, const Copy& copy) {
  const Space& to = module.at(copy.to);
  return !copy.masked && (to.flags & RUNG_SPACE_HIDDEN) != 0 && to.unitBytes == module.at(copy.from.space).unitBytes &&
         copy.from.byte % to.unitBytes == copy.toByte % to.unitBytes;
}

template <class Visit>
void forCopies(const Module& module, Visit visit) {
  for (const Task& task : module.tasks)
    for (const std::vector<Copy>* copies : {&task.begin, &task.end})
      for (const Copy& copy : *copies) visit(copy);
}

// Latches whose source is not written while they are valid.
std::vector<Latch> latchesOf(const Module& module) {
  std::vector<Latch> latches;
  for (uint32_t t = 0; t < module.tasks.size(); ++t) {
    if (module.tasks[t].parts != 1) continue;
    for (const Copy& copy : module.tasks[t].begin)
      if (isLatch(module, copy)) latches.push_back({t, bitsOf(copy.from), targetOf(copy)});
  }
  const auto written = [&](const BitRange& bits, const Copy* by = nullptr) {
    std::erase_if(latches, [&](const Latch& latch) {
      const bool isItself = by != nullptr && latch.isMadeBy(*by);
      return !isItself && (overlap(latch.source, bits) || overlap(latch.held, bits));
    });
  };
  forCopies(module, [&](const Copy& copy) {
    written(targetOf(copy), &copy);
    if (copy.masked) written(bitsOf({copy.mask, copy.maskByte, copy.from.size})); // the copy clears the mask
  });
  if (latches.empty()) return latches; // the usual case
  for (const Routine& routine : module.routines)
    forUses(module, routine, [&](const Use& use) {
      if (use.writes) written(use.place);
    });
  return latches;
}

// By routine: the only task that runs it.
std::vector<uint32_t> tasksOf(const Module& module) {
  std::vector<uint32_t> tasks(module.routines.size(), kNoTask);
  for (uint32_t t = 0; t < module.tasks.size(); ++t)
    for (const RoutineId routine : routinesFrom(module, module.tasks[t].entry)) {
      uint32_t& task = tasks[routine.index];
      task = task == kNoTask ? t : kSeveralTasks;
    }
  return tasks;
}

void readSource(const Module& module, const std::vector<Latch>& latches, uint32_t task, Op& op) {
  const std::optional<Use> use = useOf(module, op);
  if (!use || use->writes) return;
  const auto latch = std::ranges::find_if(
      latches, [&](const Latch& any) { return any.task == task && contains(any.held, use->place); });
  if (latch == latches.end()) return;
  op.ref = latch->source.space.index;
  op.imm += int64_t{latch->source.first} - latch->held.first;
}

void removeUnread(Module& module, std::vector<Latch> latches) {
  const auto read = [&](const BitRange& bits) {
    std::erase_if(latches, [&](const Latch& latch) { return overlap(latch.held, bits); });
  };
  for (const Routine& routine : module.routines) forUses(module, routine, [&](const Use& use) { read(use.place); });
  forCopies(module, [&](const Copy& copy) { read(bitsOf(copy.from)); });
  for (const SpaceSpan& span : module.retains) read(bitsOf(span));
  for (Task& task : module.tasks)
    std::erase_if(task.begin, [&](const Copy& copy) {
      return std::ranges::any_of(latches, [&](const Latch& latch) { return latch.isMadeBy(copy); });
    });
}

} // namespace

void readSourcesOfLatches(Module& module) {
  const std::vector<Latch> latches = latchesOf(module);
  if (latches.empty()) return;
  const std::vector<uint32_t> tasks = tasksOf(module);
  for (uint32_t r = 0; r < module.routines.size(); ++r)
    for (Rung& rung : module.routines[r].rungs)
      for (Op& op : rung.ops) readSource(module, latches, tasks[r], op);
  removeUnread(module, latches);
}

} // namespace rung::ir
