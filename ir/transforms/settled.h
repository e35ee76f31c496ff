// Which rungs a pass need not look at again, as it would leave them as they are. A pass of single rungs goes over the
// others, and says of each what holds then:
//
//   fold, reuse   What changed a rung may have made more to do, for all passes. Reuse itself is done, but where it took
//                 a store out of a loop: a loop that writes nothing hides nothing that was read before it.
//   dead          Done. It takes away what nobody uses, stores apart: no operand and no value that is there already.
//   transient     It takes stores away: folding asks for none. Their operands may be unused now, and loops without
//                 them may write nothing.
//   versions      A rung that gets versions is a new one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

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

} // namespace rung::ir
