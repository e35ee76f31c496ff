// The logic equation and its stack, as far as the language determines them statically, in the order of the source (man.
// l.225-275).
#pragma once

#include <vector>

#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/read/macros.h"

namespace rung::frontend::technol {

class Equation {
public:
  explicit Equation(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Called before and after the statement's work.
  StackUse begin(const Statement& statement);
  void finish(const Row& row) { open_ = open_ && !row.info.terminating; }
  // An unknown statement: it may end the equation, push a value or pop one.
  void unknown() { hasUnknown_ = lostTrack_ = true; }
  // The flags of a macro override what its statements did (man. l.20536).
  StackUse beginMacro(const Statement& statement);
  void endMacro(const Statement& statement);
  // Positions where the stack must be empty: CHECK, and the ends of units, which also end the equation.
  void checkBalance(SourceRange at, std::string_view where);
  void end(SourceRange at, std::string_view where);

private:
  // State before a macro that declares its own effect.
  struct MacroState {
    std::vector<SourceRange> stored;
    bool open = false;
    size_t errors = 0;
  };

  void loadRlo(SourceRange at, StackUse& use);
  uint32_t pop(const Statement& statement);
  uint32_t depth() const { return static_cast<uint32_t>(stored_.size()); }

  Diagnostics& diagnostics_;
  bool open_ = false;
  bool hasUnknown_ = false;         // of the open equation
  bool lostTrack_ = false;          // since the stack was last known to be empty
  SourceRange begin_;               // of the open equation
  std::vector<SourceRange> stored_; // values on the stack, as the statements that pushed them
  uint32_t lost_ = 0;               // number of values popped from an empty stack
  std::vector<MacroState> macros_;
};

} // namespace rung::frontend::technol
