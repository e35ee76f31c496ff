// A decision of a rung (the power into a coil) as a function of its conditions (its contacts), derived from the rung's
// operations: and, or, exclusive or, not and select of bits. Every other value is held constant. Sixty-three conditions
// are flipped at a time, each in its own lane of a 64-bit word, so finding the deciding ones costs about as much as
// running the rung.
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
#include "tools/report/guards.h"

namespace rung::report {

class Expression {
public:
  // `conditions` are values of the rung; those on which `root` depends become its conditions.
  Expression(const ir::Rung& rung, ir::ValueId root, std::span<const ir::ValueId> conditions);

  // Indices into the given conditions, in the order in which their values are computed.
  const std::vector<uint32_t>& conditions() const { return conditions_; }
  // Calls decides(i) for each i in conditions() that decides alone: flipping it flips the root. `values` are the
  // rung's.
  void findDeciding(std::span<const uint64_t> values, const std::function<void(size_t i)>& decides) const;

private:
  enum class Kind : uint8_t { Condition, Held, And, Or, Xor, Not, Select };
  // Operands are nodes; those of Condition and Held are (in `a`) an index of conditions_ and a value of the rung.
  struct Node {
    Kind kind = Kind::Held;
    uint32_t a = 0;
    uint32_t b = 0;
    uint32_t c = 0;
    uint32_t value = 0; // of a Condition
  };
  static bool isLogic(const ir::Op& op);
  static Kind kindOf(ir::OpCode code);
  uint64_t evaluate(std::span<const uint64_t> values, size_t first, std::vector<uint64_t>& lanes) const;

  std::vector<uint32_t> conditions_;
  std::vector<Node> nodes_; // operands come first; the last is the root
};

// Counts the runs, contacts and coils of a program's rungs while the interpreter runs them.

// Observes one program that one thread runs. It keeps no reference to the module.
class CoverageCollector final : public ir::RungObserver {
public:
  // `module`: not changed by any pass. Rungs without a number were added by the compiler and do not count. One rung of
  // the source (one number) may be several rungs of the module: the further ones in its routine are its parts, and a
  // part that another routine has, too, is the same code lowered once more.
  CoverageCollector(const ir::Module& module, const ir::Marks& marks);

  void rungRan(uint32_t number, std::span<const uint64_t> values) override;
  Program program() const;

private:
  struct Watched {
    uint32_t value = 0;
    uint32_t index = 0; // index of a condition, output or decision of the rung
    std::vector<Guard> guards;
    bool reached(std::span<const uint64_t> values) const { return report::reached(guards, values); }
  };
  // What is counted of one rung of the module.
  struct Plan {
    uint32_t rung = UINT32_MAX; // index in Program::rungs
    bool counts = true;         // whether its runs count as runs of the rung of the source
    std::vector<Watched> conditions;
    std::vector<Watched> outputs;
    std::vector<Watched> decisions;
    std::vector<Expression> expressions; // of its decisions
    std::vector<uint64_t> last;          // values of the last run
  };
  // A part of a rung of the source: where its conditions, outputs and decisions begin.
  struct Part {
    uint32_t routine = 0; // the first routine that has it
    const ir::Rung* code = nullptr;
    std::span<const ir::Mark> marks;
    uint32_t rung = 0; // index in Program::rungs
    uint32_t conditions = 0;
    uint32_t outputs = 0;
    uint32_t decisions = 0;
    bool first = false;
  };
  static bool isSame(const Part& a, const Part& b);
  bool locate(const ir::Module& module, Part& part, std::vector<Part>& known);
  Plan planOf(const ir::Module& module, Part part, std::vector<Part>& known);
  void addMarks(const Part& part, const Plan& plan, const std::vector<std::vector<uint32_t>>& outputs);
  void decide(const Plan& plan, size_t decision, std::span<const uint64_t> values);

  Program program_;         // rungs in the order of the module
  std::vector<Plan> plans_; // by rung number over all routines
};

// The counts of all observers that it made. Several threads may use it at a time.
class Collection {
public:
  // The observer adds its counts to the collection when it is destroyed. The collection must outlive it.
  std::unique_ptr<ir::RungObserver> observe(const ir::Module& module, const ir::Marks& marks);
  void add(const Program& program);
  CoverageReport report() const;

private:
  mutable std::mutex mutex_; // protects the report
  CoverageReport report_;
};

} // namespace rung::report
