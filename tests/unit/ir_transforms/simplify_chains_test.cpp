// Chains of two and three operations with constants, as instructions and inlined boxes make them, give for every value
// of a byte the same with simplifications as without: a rule that holds only for some values shows here.
#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

#include "ir/transforms/passes.h"
#include "ir/transforms/pipeline.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "tests/unit/ir_interp/machine.h"

namespace rung::ir {
namespace {

constexpr uint32_t kChains = 256; // of a module
constexpr int kConstants[] = {0, 1, -1, 2, 7, 127, -128};
constexpr std::string_view kTypes[] = {"bit", "i8", "i16", "i32", "i64"};

struct ValueOp {
  std::string_view name;
  std::string_view types;
  std::string_view signature;
  std::string_view result;
};

// All operations that only make a value; those of f64 are left out below.
constexpr ValueOp kValueOps[] = {
#define RUNG_OP(...)
#define RUNG_VALUE_OP(code, name, types, signature, result, ...) {#name, #types, #signature, #result},
#include "ir/core/ops.def"
};

bool isOf(const ValueOp& op, std::string_view type) {
  if (op.types == "Ints") return type != "bit";
  if (op.types == "BitsAndInts" || op.types == "AllTypes") return true;
  return op.types == "BitToI32" && type != "i64";
}

// A value of a chain: the number of its operation, and its type.
struct Value {
  uint32_t id = 0;
  std::string_view type;
};

// The lines of a rung.
class Lines {
public:
  Value add(std::string_view type, const std::string& operation) {
    text_ += fmt::format("%{}:{} = {}\n", next_, type, operation);
    return {next_++, type};
  }
  Value constant(std::string_view type, int value) {
    return add(type, fmt::format("const {}", type == "bit" ? value & 1 : value));
  }
  void store(const Value& value, uint32_t chain) {
    text_ += fmt::format("store.{} R[{}{}], %{}\n", value.type, chain * 8, value.type == "bit" ? ".0" : "", value.id);
  }
  const std::string& text() const { return text_; }

private:
  std::string text_;
  uint32_t next_ = 0;
};

// One step of a chain: an operation, the constant beside the value, and on which side the value is.
struct Step {
  const ValueOp* op = nullptr;
  int constant = 0;
  bool valueIsRight = false;
  std::string_view to = {}; // of a conversion
};

// All steps from a value of a type.
std::vector<Step> stepsFrom(std::string_view type) {
  std::vector<Step> steps;
  for (const ValueOp& op : kValueOps) {
    if (op.signature == "Unary" && isOf(op, type)) steps.push_back({&op});
    if (op.signature == "FromNarrower" || op.signature == "FromWider")
      for (const std::string_view to : kTypes) {
        const bool wider = std::ranges::find(kTypes, to) > std::ranges::find(kTypes, type);
        if (to != type && wider == (op.signature == "FromNarrower") && isOf(op, to))
          steps.push_back({&op, 0, false, to});
      }
    if (op.signature != "Binary" && op.signature != "Shift" && op.signature != "Choice") continue;
    if (!isOf(op, type)) continue;
    for (const int constant : kConstants) {
      if (type == "bit" && (constant < 0 || constant > 1)) continue;
      steps.push_back({&op, constant});
      if (op.signature != "Shift") steps.push_back({&op, constant, true});
    }
  }
  return steps;
}

// `other` instead of the constant where it is given and has the type.
Value apply(Lines& lines, const Step& step, const Value& x, const std::optional<Value>& other = {}) {
  const ValueOp& op = *step.op;
  const std::string_view result = op.result == "Bit" ? "bit" : step.to.empty() ? x.type : step.to;
  if (op.signature != "Binary" && op.signature != "Shift" && op.signature != "Choice")
    return lines.add(result, fmt::format("{} %{}", op.name, x.id));
  const bool useOther = other && other->type == x.type && op.signature != "Shift";
  const Value y = useOther ? *other : lines.constant(op.signature == "Shift" ? "i32" : x.type, step.constant);
  const std::string operands =
      step.valueIsRight ? fmt::format("%{}, %{}", y.id, x.id) : fmt::format("%{}, %{}", x.id, y.id);
  if (op.signature != "Choice")
    return lines.add(result,
                     fmt::format("{}{} {}", op.name, op.result == "Bit" ? fmt::format(".{}", x.type) : "", operands));
  const Value condition = lines.add("bit", "load X[2.0]");
  return lines.add(result, fmt::format("select %{}, {}", condition.id, operands));
}

Module moduleOfLines(const Lines& lines) {
  return moduleFromText(fmt::format(R"(module "test" dialect "test"
file "t.lad"
space X unit 1 units 8
space R unit 1 units {}
fault F
routine R {{
rung 0 "" loc("t.lad":1:1-1) key(1) weight 1 {{
{}}}
}}
task T0 entry R period 1000 budget 1000000 fault F parts 1 {{
}}
schedule main T0 fast -
step scan advance - 1000
step scan run T0 1
)",
                                    kChains * 8, lines.text()));
}

// Runs a rung as it is and optimised, for all values of X[0], both of the bit X[2.0] and some of X[1].
void compare(const Lines& lines) {
  Module plain = moduleOfLines(lines);
  Module simplified = plain;
  runPasses(simplified, {.optimise = true, .instrument = false, .verifyEach = false});
  const std::vector<VerifyError> errors = verify(simplified, Mode::Final);
  ASSERT_TRUE(errors.empty()) << render(simplified, errors);
  Machine a(std::move(plain)), b(std::move(simplified));
  bool anyResult = false;
  for (uint64_t x = 0; x < 256; ++x)
    for (const uint64_t y : {x * 73 & 255, x ^ 1}) {
      for (Machine* machine : {&a, &b}) {
        const std::pair<uint32_t, uint64_t> inputs[] = {{0, x}, {1, y}, {2, y & 1}};
        for (const auto& [byte, value] : inputs)
          ASSERT_EQ((*machine)->write(runtime::intRef(0, byte, 8), value), std::nullopt);
        (*machine)->scan();
        ASSERT_FALSE((*machine)->faulted());
      }
      for (uint32_t byte = 0; byte < kChains * 8; ++byte) anyResult = anyResult || a->memory().readByte(1, byte) != 0;
      const std::optional<std::string> found = runtime::firstDifference(*a, *b, nc::describe);
      ASSERT_EQ(found, std::nullopt) << "x = " << x << ", y = " << y << ":\n" << lines.text();
    }
  EXPECT_TRUE(anyResult) << "nothing ran";
}

// Collects chains to modules.
class Chains {
public:
  void add(std::string_view type, const auto& make) {
    const Value x = type == "i8" ? lines_.add("i8", "load X[0]") : lines_.add("bit", "load X[0.0]");
    lines_.store(make(lines_, x), count_);
    if (++count_ == kChains) finish();
  }
  void finish() {
    if (count_ > 0) compare(lines_);
    lines_ = {};
    count_ = 0;
  }

private:
  Lines lines_;
  uint32_t count_ = 0;
};

TEST(SimplifyChains, OfTwoWithConstants) {
  Chains chains;
  for (const std::string_view type : {"bit", "i8"})
    for (const Step& first : stepsFrom(type)) {
      Lines nowhere;
      for (const Step& second : stepsFrom(apply(nowhere, first, {0, type}).type)) {
        chains.add(type, [&](Lines& lines, const Value& x) { return apply(lines, second, apply(lines, first, x)); });
        if (testing::Test::HasFailure()) return;
      }
    }
  chains.finish();
}

// With the value itself, an earlier one or another in the place of some constants.
TEST(SimplifyChains, OfThreeAtRandom) {
  std::mt19937 random(1);
  const auto below = [&random](size_t limit) { return random() % limit; };
  Chains chains;
  for (int i = 0; i < 40 * static_cast<int>(kChains); ++i) {
    const std::string_view type = below(3) == 0 ? "bit" : "i8";
    chains.add(type, [&](Lines& lines, const Value& x) {
      std::vector<Value> known{x, type == "bit" ? lines.add("bit", "load X[1.0]") : lines.add("i8", "load X[1]")};
      Value value = x;
      for (int length = 0; length < 3; ++length) {
        const std::vector<Step> steps = stepsFrom(value.type);
        const std::optional<Value> other = below(2) == 0 ? std::optional(known[below(known.size())]) : std::nullopt;
        value = apply(lines, steps[below(steps.size())], value, other);
        known.push_back(value);
      }
      return value;
    });
    if (testing::Test::HasFailure()) return;
  }
}

} // namespace
} // namespace rung::ir
