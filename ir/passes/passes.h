// The passes one by one, for the pipeline and for tests. Each keeps the module valid; what each does is said in its
// file.
#pragma once
#include "ir/core/given_numbers.h"
#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "ir/passes/settled.h"

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
void guardIndices(Module& module, Settled& settled);          // short ways through a rung, for likely indices

} // namespace rung::ir
