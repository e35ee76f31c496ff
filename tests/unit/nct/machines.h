// One NCT program on all engines, its memory by word number, one run of MAIN at a time (no NC beside it).
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "compiler/engines.h"

namespace rung::frontend::nct::test {

class Machine {
public:
  Machine(const compiler::Compiled& compiled, compiler::EngineKind kind);
  uint32_t word(uint32_t number) const;
  // What a program finds there: in the NC area the time-slice memory comes first.
  void setWord(uint32_t number, uint32_t value);
  double real(uint32_t number) const;
  void setReal(uint32_t number, double value);
  // The time-slice memory's copy of an NC word.
  uint32_t slice(uint32_t number) const;
  bool bit(uint32_t number, uint32_t bit) const { return (word(number) >> bit & 1) != 0; }
  void run();  // MAIN, and its transfers; no time passes
  void scan(); // a cycle: T_PLC passes
  void fast(); // a time slice: INT0 alone
  int64_t nowUs() const { return instance_->nowUs(); }
  const runtime::Instance& instance() const { return *instance_; }
  runtime::Instance& instance() { return *instance_; }
  const std::string& name() const { return name_; }

private:
  std::unique_ptr<runtime::Engine> engine_;
  std::unique_ptr<runtime::Instance> instance_;
  std::string name_;
  uint32_t memory_ = 0;
  uint32_t slice_ = 0;
};

inline constexpr uint32_t kNcEnd = 4000; // PLCNVRAM by default

// `body` stands in module MAIN. The first machine is the interpreter.
class Machines {
public:
  explicit Machines(const std::string& body, const std::vector<compiler::EngineKind>& kinds = everyEngine());
  static std::vector<compiler::EngineKind> everyEngine();
  static std::vector<compiler::EngineKind> interpreterAndJit();
  std::vector<Machine>& all() { return machines_; }
  // A difference between the interpreter and another engine; empty: none.
  std::string difference() const;

private:
  compiler::Compiled compiled_;
  std::vector<Machine> machines_;
};

} // namespace rung::frontend::nct::test
