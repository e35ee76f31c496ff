// The passes: functions for tests, and a table of them by name, used by the pipeline and `rungc opt`. Each keeps a
// module valid that is not instrumented; each is described in its file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ir/core/marks.h"
#include "ir/core/module.h"

namespace rung::ir {

// Which rungs a pass need not visit again, because it would not change them. A pass of single rungs visits the others,
// and returns the new state of each:
//
//   fold, reuse   A changed rung may give all passes more to do. Reuse itself is settled, unless it moved a store
//                 out of a loop: a loop that writes nothing hides nothing that was read before it.
//   dead          Settled. It removes what is not used, except stores: no operand and no existing value.
//   transient     It removes stores, from which folding learns nothing. Their operands may be unused now, and
//                 loops without them may write nothing.
//   versions      A rung that gets versions is a new one.

// The state of one rung: a set of passes that would not change it.
enum Settles : uint8_t {
  kNothingSettled = 0,
  kFolded = 1,
  kReused = 2,
  kDeadRemoved = 4,
};

class Settled {
public:
  explicit Settled(const Module& module) {
    size_t rungs = 0;
    for (const Routine& routine : module.routines) rungs += routine.rungs.size();
    rungs_.assign(rungs, kNothingSettled);
  }

  // Calls visit(rung, number in the routine, settled passes) in order for each rung that `pass` has not settled, with
  // kNothingSettled for all rungs; the visit returns the new state. The module must have the rungs that it had when
  // this was made.
  template <class Visit>
  void eachOpen(Module& module, Settles pass, Visit visit) {
    uint8_t* settled = rungs_.data();
    for (Routine& routine : module.routines)
      for (uint32_t i = 0; i < routine.rungs.size(); ++i, ++settled)
        if ((*settled & pass) == 0) *settled = visit(routine.rungs[i], i, *settled);
  }

private:
  std::vector<uint8_t> rungs_;
};

// Not in the pipeline: for a module as its front end built it, before its uses are determined. `marks` and `given` (or
// null) are updated with it.
void orderOperations(Module& module, Marks* marks = nullptr, GivenNumbers* given = nullptr);
void readSourcesOfLatches(Module& module); // reads what a task copies at its beginning from the source of the copy

void inlineRoutines(Module& module);  // inlines a routine with one caller
void keepCarried(Module& module);     // clears `transient` of registers that a run, or a part of one, leaves to another
void instrumentRungs(Module& module); // measures each rung

// These visit rungs that are not settled.
void foldConstants(Module& module, Settled& settled); // constants, algebra, branches with known conditions
void reuseValues(Module& module, Settled& settled);   // reuses values of equal operations, loads and stores above
void removeDeadOps(Module& module, Settled& settled); // removes unused results and regions without effect
void removeTransientStores(Module& module, Settled& settled); // removes stores to registers that no rung reads
void versionRanges(Module& module, Settled& settled);         // versions of a rung for likely indices

// A row of the table, with one of two functions: the first may change the set of rungs, the second visits rungs that
// are not settled.
struct Pass {
  std::string_view name; // as in `rungc opt --passes`
  std::string_view doc;  // its effect, in one sentence
  void (*overModule)(Module&) = nullptr;
  void (*overRungs)(Module&, Settled&) = nullptr;
  bool last = false; // no other pass accepts a module after it
};
std::span<const Pass> allPasses();
// Null if there is no pass of this name.
const Pass* findPass(std::string_view name);

// Runs passes one after another.
class PassRunner {
public:
  // Called after each pass; may be empty.
  using Observer = std::function<void(const Pass& pass, const Module& module)>;

  // The module must outlive the runner.
  explicit PassRunner(Module& module, Observer observer = {}) : module_(module), observer_(std::move(observer)) {}
  void run(const Pass& pass);

private:
  Module& module_;
  Observer observer_;
  std::optional<Settled> settled_; // of the present rungs
};

} // namespace rung::ir
