// Passes on modules in the text form: what is inside of `rung … { }` goes in and comes out.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/core/module.h"
#include "ir/transforms/passes.h"

namespace rung::ir {

using PassFunction = void (*)(Module&);
using SettlingPass = void (*)(Module&, Settled&);

// Over all rungs.
template <SettlingPass pass>
void overAll(Module& module) {
  Settled nothing(module);
  pass(module, nothing);
}
inline void foldConstants(Module& module) { overAll<foldConstants>(module); }
inline void reuseValues(Module& module) { overAll<reuseValues>(module); }
inline void removeDeadOps(Module& module) { overAll<removeDeadOps>(module); }
inline void removeTransientStores(Module& module) { overAll<removeTransientStores>(module); }
inline void versionRanges(Module& module) { overAll<versionRanges>(module); }

// One rung: its lines and its transfer, from `}` on ("} goto 2 if %3").
struct RungText {
  std::string lines;
  std::string transfer = "}";
};
struct RoutineText {
  std::string name;
  std::vector<RungText> rungs;
};

// Spaces: B (bytes), D (double words); slots: $0 i32, $1 i32 transient, $2 bit transient; fault F; service S. A task
// for each of `entries`; `parts` of the first. Fails the test, and gives an empty module, when the text is not valid.
Module moduleOf(const std::vector<RoutineText>& routines, const std::vector<std::string>& entries, uint32_t parts = 1);

// A module with one routine R of one rung.
Module moduleOf(std::string_view lines, std::string_view transfer = "}");

// The operations (one a line, without indentation) and the transfer, as far as there is one.
std::string bodyOf(const Module& module, RoutineId routine = RoutineId{0}, uint32_t rung = 0);

// The body after one pass; the verifier has nothing to say about the result.
std::string after(PassFunction pass, std::string_view lines, std::string_view transfer = "}");

} // namespace rung::ir
