// What the registers hold as far as it shows in the order of the source: values that a wait loses, and reals that are
// calculated with as integers.
#pragma once

#include "frontend/dialects/technol/program.h"

namespace rung::frontend::technol {

// RLO and DR after a wait, when other code has run.
class LostRegisters {
public:
  explicit LostRegisters(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void forget() { rlo_ = dr_ = false; }
  // Before and after the work of a statement; `waits`: control may leave the unit in it.
  void begin(const Statement& statement, bool readsDr);
  void finish(const Row& row, bool waits);

private:
  void reportIf(bool& lost, bool reads, const Statement& statement, std::string_view name);

  Diagnostics& diagnostics_;
  bool rlo_ = false;
  bool dr_ = false;
};

// What an instruction does with the number in DR.
enum class DrUse : uint8_t { LoadInteger, LoadReal, Integer, Real };

// The rules on mixing real and integer arithmetic (man. l.1551).
class Mixing {
public:
  explicit Mixing(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void forget() { state_ = State::No; }
  void note(DrUse kind, const Statement& statement);

private:
  enum class State : uint8_t { No, Real, IntegerOnReal };

  Diagnostics& diagnostics_;
  State state_ = State::No;
  const Statement* integer_ = nullptr; // what worked on the real value
};

} // namespace rung::frontend::technol
