// What a generated program does, without a dialect: a list of elements over numbered bits, words and reals. Each
// dialect writes it in its own language (form.h), and straight.h as the C++ that a programmer would write by hand.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace rung::bench {

enum class Op : uint8_t {
  Logic,    // coil := (first AND|OR second) AND third
  Timer,    // coil: `first` has been 1 for `preset` milliseconds
  Counter,  // ring of 0 to `preset`: counts rising edges of `first`, `second` resets it to 0; coil: it is at `preset`
  Add,      // while `first` is 1: words[to] := words[a] + words[b], modulo 2^32
  Subtract, // the same with a difference
  Multiply, // the same with a product
  Less,     // coil := first AND words[a] < words[b]
  RealAdd,  // while `first` is 1: reals[to] := reals[a] + reals[b]
  RealSubtract,
  RealMultiply,
  TableRead,  // while `first` is 1: words[to] := tables[b][words[a]]
  TableWrite, // while `first` is 1: tables[b][words[a]] := words[to]
  Mechanism,  // `first` starts it: coil := 1, waits for `second`, coil := 0, waits for its fall, ends
};

struct Contact {
  uint32_t bit = 0; // inputs, then coils
  bool negated = false;
};

struct Element {
  Op op = Op::Logic;
  bool parallel = false; // Logic: first OR second
  Contact first{}, second{}, third{};
  uint32_t coil = 0;
  uint32_t a = 0, b = 0, to = 0;
  uint32_t number = 0; // among the elements of its kind that have state
  uint32_t preset = 0;
};

enum class Kind : uint8_t {
  Bits,
  Arrays, // alarms that stay until they are reset, and their lamps: isomorphic rungs over neighbouring bits
  TimersIdle,
  TimersRunning,
  Counters,
  Integers,
  Reals,
  Indexed,
  Signals, // as Bits, but inputs and coils are those of the control's interface
  MechanismsIdle,
  MechanismsWaiting,
  Mechanisms,
  Full, // bits, and for each ten of them a timer, a counter and two integer operations
};

struct KindRow {
  Kind kind;
  const char* name; // as on the command line
  const char* title;
};
std::optional<Kind> kindFromName(std::string_view name);
const KindRow& rowOf(Kind kind);

constexpr uint32_t kTables = 4;
constexpr uint32_t kEntries = 16;

struct Work {
  Kind kind = Kind::Bits;
  std::vector<Element> elements;
  uint32_t inputs = 0;   // number of bits that only the machine writes
  uint32_t coils = 0;    // number of bits after the inputs
  uint32_t indices = 0;  // number of words that only the machine writes; the first ones hold values below kEntries
  uint32_t operands = 0; // number of words after the indices that only the machine writes
  uint32_t results = 0;  // number of words after the operands
  uint32_t realOperands = 0;
  uint32_t realResults = 0;
  uint32_t timers = 0, counters = 0, mechanisms = 0;
  bool hasTables = false;
  bool changes = true; // whether the machine changes inputs from scan to scan
  // Constant values of the first and of the second half of the inputs, if nothing changes.
  bool firstHalf = false, secondHalf = false;

  uint32_t bits() const { return inputs + coils; }
  uint32_t words() const { return indices + operands + results; }
  uint32_t reals() const { return realOperands + realResults; }
};

// The work for these arguments. It must never change: published figures are of these programs.
Work drawWork(Kind kind, uint32_t size);

} // namespace rung::bench
