// The passes: functions for tests, and a table of them by name, from which the pipeline and `rungc opt` take theirs.
// Each keeps a module valid that is not instrumented; what each does is said in its file.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "ir/core/given_numbers.h"
#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "ir/transforms/settled.h"

namespace rung::ir {

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
