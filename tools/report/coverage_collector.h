// A decision of a rung (the power into a coil) as a function of its conditions (its contacts), read off the rung's
// operations: and, or, exclusive or, not and select of bits. Every other value is held still. Sixty-three conditions
// are flipped at a time, each in a lane of its own of one 64-bit word, so asking which of them decide costs about as
// much as running the rung.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "ir/interp/interp.h"
#include "tools/report/coverage_report.h"

namespace rung::report {

class Expression {
public:
  // `conditions` are values of the rung; those that `root` follows from become its conditions.
  Expression(const ir::Rung& rung, ir::ValueId root, std::span<const ir::ValueId> conditions);

  // Indices into the conditions given, in the order in which their values are computed.
  const std::vector<uint32_t>& conditions() const { return conditions_; }
  // Calls decides(i) for each i in conditions() that alone decides: flipped, it flips the root. `values` are the
  // rung's.
  void findDeciding(std::span<const uint64_t> values, const std::function<void(size_t i)>& decides) const;

private:
  enum class Kind : uint8_t { Condition, Held, And, Or, Xor, Not, Select };
  // Operands are nodes, those of Condition and Held (a) a condition of ours and a value of the rung.
  struct Node {
    Kind kind = Kind::Held;
    uint32_t a = 0;
    uint32_t b = 0;
    uint32_t c = 0;
    uint32_t value = 0; // Condition
  };
  static bool isLogic(const ir::Op& op);
  static Kind kindOf(ir::OpCode code);
  uint64_t evaluate(std::span<const uint64_t> values, size_t first, std::vector<uint64_t>& lanes) const;

  std::vector<uint32_t> conditions_;
  std::vector<Node> nodes_; // operands come first; the last is the root
};

// Counts what a program's rungs do while the interpreter runs them.

// Of one program that one thread runs. It keeps nothing of the module, which may go.
class CoverageCollector final : public ir::RungObserver {
public:
  // A module that no pass has changed, and its marks. Rungs without a number are the compiler's own: they do not count.
  // What the source calls one rung (one number) may be several rungs of the module: the further ones of its routine are
  // parts of it, and a part that another routine has, too, is the same code lowered once more.
  CoverageCollector(const ir::Module& module, const ir::Marks& marks);

  void rungRan(uint32_t number, std::span<const uint64_t> values) override;
  Program program() const;

private:
  // Whether the operation that makes a value was reached: each condition of the regions around it must have this value.
  struct Guard {
    uint32_t value = 0;
    bool wanted = true;
  };
  struct Watched {
    uint32_t value = 0;
    uint32_t index = 0; // among the conditions, outputs or decisions of the rung
    std::vector<Guard> guards;
    bool reached(std::span<const uint64_t> values) const;
  };
  // A rung of the module.
  struct Plan {
    uint32_t rung = UINT32_MAX; // in Program::rungs
    bool counts = true;         // its runs are those of the rung
    std::vector<Watched> conditions;
    std::vector<Watched> outputs;
    std::vector<Watched> decisions;
    std::vector<Expression> expressions; // of the decisions
    std::vector<uint64_t> last;          // values of the last run
  };
  // A part of what the source calls a rung, where its conditions, outputs and decisions begin.
  struct Part {
    uint32_t routine = 0; // that has it first
    const ir::Rung* code = nullptr;
    std::span<const ir::Mark> marks;
    uint32_t rung = 0; // in Program::rungs
    uint32_t conditions = 0;
    uint32_t outputs = 0;
    uint32_t decisions = 0;
    bool first = false;
  };
  static std::vector<std::vector<Guard>> guardsOf(const ir::Rung& rung);
  static bool isSame(const Part& a, const Part& b);
  bool locate(const ir::Module& module, Part& part, std::vector<Part>& known);
  Plan planOf(const ir::Module& module, Part part, std::vector<Part>& known);
  void addMarks(const Part& part, const Plan& plan, const std::vector<std::vector<uint32_t>>& outputs);
  void decide(const Plan& plan, size_t decision, std::span<const uint64_t> values);

  Program program_;         // rungs in the order of the module
  std::vector<Plan> plans_; // by number over all routines
};

// What all observers that it gave have counted. Safe to use by several threads.
class Collection {
public:
  // Counts until it goes, and then hands over what it has counted. The collection outlives it.
  std::unique_ptr<ir::RungObserver> observe(const ir::Module& module, const ir::Marks& marks);
  void add(const Program& program);
  CoverageReport report() const;

private:
  mutable std::mutex mutex_; // of the report
  CoverageReport report_;
};

} // namespace rung::report
