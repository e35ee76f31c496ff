// The passes: functions for tests, and a table of them by name, from which the pipeline and `rungc opt` take theirs.
// Each keeps a module valid that is not instrumented; what each does is said in its file.
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

// Which rungs a pass need not look at again, as it would leave them as they are. A pass of single rungs goes over the
// others, and says of each what holds then:
//
//   fold, reuse   What changed a rung may have made more to do, for all passes. Reuse itself is done, but where it took
//                 a store out of a loop: a loop that writes nothing hides nothing that was read before it.
//   dead          Done. It takes away what is not used, except stores: no operand and no value that is there already.
//   transient     It takes stores away: folding asks for none. Their operands may be unused now, and loops without
//                 them may write nothing.
//   versions      A rung that gets versions is a new one.

// Of one rung: a set of passes that would leave it as it is.
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

  // Calls visit(rung, its number in the routine, what is settled) for each rung where `pass` is not, in order, and for
  // each of all where that is nothing; the visit gives what is settled then. The module has the rungs that it had when
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

// Not in the pipeline: for a module as its front end built it, before anybody asks what its rungs use. `marks` and
// `given` (or null) go along.
void orderOperations(Module& module, Marks* marks = nullptr, GivenNumbers* given = nullptr);
void readSourcesOfLatches(Module& module); // what a task copies when it begins is read where it comes from

void inlineRoutines(Module& module);  // a routine with one caller takes the place of the call
void keepCarried(Module& module);     // registers that a run, or a part of one, leaves for another are none any more
void instrumentRungs(Module& module); // measures each rung

// These go over rungs that are not settled.
void foldConstants(Module& module, Settled& settled);         // constants, algebra, branches that are known
void reuseValues(Module& module, Settled& settled);           // an equal operation, load or stored value above is used
void removeDeadOps(Module& module, Settled& settled);         // results that nothing uses, regions without effect
void removeTransientStores(Module& module, Settled& settled); // values of registers between rungs that nothing reads
void versionRanges(Module& module, Settled& settled);         // versions of a rung for likely indices

// A row of the table. One of the two functions: the first may change which rungs there are, the second goes over rungs
// that are not settled.
struct Pass {
  std::string_view name; // in `rungc opt --passes`
  std::string_view doc;  // what it does, one sentence
  void (*overModule)(Module&) = nullptr;
  void (*overRungs)(Module&, Settled&) = nullptr;
  bool last = false; // the others take no module that it has changed
};
std::span<const Pass> allPasses();
// Null: no pass has this name.
const Pass* findPass(std::string_view name);

// Runs passes one after the other.
class PassRunner {
public:
  // Called after each pass; may be empty.
  using Observer = std::function<void(const Pass& pass, const Module& module)>;

  // The module outlives the runner.
  explicit PassRunner(Module& module, Observer observer = {}) : module_(module), observer_(std::move(observer)) {}
  void run(const Pass& pass);

private:
  Module& module_;
  Observer observer_;
  std::optional<Settled> settled_; // of the rungs that there are now
};

} // namespace rung::ir
