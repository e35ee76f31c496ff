// The flow of all examples against an independent evaluation: inputs at random, and each pin's power worked out again
// from the rung's operations and what it read from memory.
#include <algorithm>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compiler/project.h"
#include "ir/core/eval.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/diag_render.h"
#include "rtlib/load/ref.h"
#include "tools/replay/flow.h"
#include "tools/report/place_names.h"

namespace rung::replay {
namespace {

struct Example {
  std::optional<compiler::Compiled> compiled;
  compiler::CompileRequest request;
  SourceManager sources;
  std::vector<FileId> files;
};

std::unique_ptr<Example> compileExample(const std::string& folder) {
  auto example = std::make_unique<Example>();
  Diagnostics diagnostics;
  const auto project = compiler::load(example->sources, folder + "/rung.toml", diagnostics);
  EXPECT_TRUE(project) << renderText(diagnostics, example->sources);
  compiler::CompileRequest& request = example->request;
  request.dialect = project->dialect;
  request.name = project->name;
  request.options.includePaths = project->includePaths;
  for (const compiler::Setting& setting : project->config) request.options.config[setting.key] = setting.value;
  request.marks = true;
  request.keepBuilt = true;
  example->files = std::move(compiler::addFiles(example->sources, project->files, request.options.config)).value();
  example->compiled = compiler::compile(example->sources, example->files, request, diagnostics);
  EXPECT_TRUE(example->compiled) << renderText(diagnostics, example->sources);
  return example;
}

// Works values of a run of a rung out, each when it is asked for.
class Evaluation {
public:
  Evaluation(const ir::Rung& rung, std::span<const ir::Access> accesses, const std::map<uint32_t, uint64_t>& others)
      : rung_(rung), others_(others) {
    for (const ir::Access& access : accesses)
      if (!access.writes) reads_[access.operation] = access.value;
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < rung.ops.size(); ++i) {
      const ir::Op& op = rung.ops[i];
      if (op.code == ir::OpCode::EndIf || op.code == ir::OpCode::EndLoop) {
        begin_[i] = open.back();
        if (op.code == ir::OpCode::EndLoop) loops_ = true;
        open.pop_back();
      }
      if (op.code == ir::OpCode::Else) else_[open.back()] = i;
      for (uint32_t r = 0; r < op.resultCount; ++r) {
        made_[op.result.index + r] = i;
        around_[op.result.index + r] = open;
      }
      if (op.code == ir::OpCode::If || op.code == ir::OpCode::Loop) open.push_back(i);
    }
  }

  bool hasLoops() const { return loops_; }
  // Whether the run came to the operation that makes the value.
  bool isReached(uint32_t value) {
    return std::ranges::all_of(around_.at(value), [&](uint32_t opened) {
      const auto otherwise = else_.find(opened);
      const bool isElse = otherwise != else_.end() && made_.at(value) > otherwise->second;
      return (valueOf(argument(rung_.ops[opened], 0)) != 0) != isElse;
    });
  }
  uint64_t valueOf(uint32_t value) {
    const auto known = known_.find(value);
    if (known != known_.end()) return known->second;
    const uint64_t found = compute(made_.at(value), value);
    known_[value] = found;
    return found;
  }

private:
  uint32_t argument(const ir::Op& op, int i) const { return ir::arg(rung_, op, i).index; }
  uint64_t compute(uint32_t index, uint32_t value) {
    const ir::Op& op = rung_.ops[index];
    if (op.code == ir::OpCode::Const) return static_cast<uint64_t>(op.imm);
    if (op.code == ir::OpCode::EndIf) return yielded(index, value - op.result.index);
    if (const auto read = reads_.find(index); read != reads_.end()) return read->second;
    if (op.code == ir::OpCode::LoadAt || op.code == ir::OpCode::LoadBitAt) return 0; // outside the window
    if (op.type == ir::Type::Bit && op.argCount <= 3) {
      switch (op.code) {
      case ir::OpCode::And: return valueOf(argument(op, 0)) != 0 && valueOf(argument(op, 1)) != 0 ? 1 : 0;
      case ir::OpCode::Or: return valueOf(argument(op, 0)) != 0 || valueOf(argument(op, 1)) != 0 ? 1 : 0;
      case ir::OpCode::Not: return valueOf(argument(op, 0)) == 0 ? 1 : 0;
      default: break;
      }
    }
    if (!ir::isEvaluable(ir::opInfo(op.code))) return others_.at(value); // the clock, the host
    uint64_t args[4] = {};
    for (int i = 0; i < op.argCount; ++i) args[i] = valueOf(argument(op, i));
    return ir::evalPure(op.code, op.type, ir::typeOf(rung_, ir::arg(rung_, op, 0)), args);
  }
  uint64_t yielded(uint32_t end, uint32_t number) {
    const uint32_t opened = begin_.at(end);
    const bool taken = valueOf(argument(rung_.ops[opened], 0)) != 0;
    const auto otherwise = else_.find(opened);
    const uint32_t from = taken && otherwise != else_.end() ? otherwise->second : end;
    return valueOf(argument(rung_.ops[from], static_cast<int>(number)));
  }

  const ir::Rung& rung_;
  const std::map<uint32_t, uint64_t>& others_;
  std::map<uint32_t, uint64_t> reads_, known_;
  std::map<uint32_t, uint32_t> begin_, else_, made_;
  std::map<uint32_t, std::vector<uint32_t>> around_;
  bool loops_ = false;
};

// Other bytes where the machine, the control and people write, and some in the program's own memory.
void disturb(runtime::Instance& instance, std::mt19937& random) {
  const rung_program& program = instance.program();
  for (uint32_t space = 0; space < program.space_count; ++space) {
    const rung_space& of = program.spaces[space];
    if ((of.flags & RUNG_SPACE_HIDDEN) != 0) continue;
    const uint32_t seldom = (of.flags & RUNG_SPACE_INPUT) != 0 ? 8 : 64;
    for (uint32_t byte = 0; byte < of.byte_count; ++byte)
      if (random() % seldom == 0) instance.memory().writeByte(space, byte, static_cast<uint8_t>(random() & random()));
  }
}

class Flows : public testing::TestWithParam<const char*> {};

TEST_P(Flows, AreWhatTheRungsCompute) {
  const std::unique_ptr<Example> example = compileExample(GetParam());
  const compiler::Compiled& compiled = *example->compiled;
  FlowEngine engine(compiled);
  const Elements& elements = engine.elements();
  std::vector<const ir::Rung*> rungs;
  for (const ir::Routine& routine : compiled.built->routines)
    for (const ir::Rung& rung : routine.rungs) rungs.push_back(&rung);
  ASSERT_EQ(rungs.size(), elements.loweredCount());
  runtime::Instance instance(engine.engine());
  std::mt19937 random(17);
  std::vector<std::array<uint64_t, 3>> seen(elements.pinCount()); // times, by power
  uint64_t looped = 0, notAlone = 0;
  for (int scan = 0; scan < 1000; ++scan) {
    if (instance.faulted()) instance.coldStart();
    disturb(instance, random);
    const Flow& flow = engine.observe(instance, [&] { instance.scan(); });
    for (const RungFlow& run : flow.runs()) {
      const std::span<const Point> points = elements.points(run.lowered);
      if (points.empty() || run.faulted) continue;
      const std::map<uint32_t, uint64_t> none;
      Evaluation evaluation(*rungs[run.lowered], flow.accesses(run), none);
      if (evaluation.hasLoops()) {
        ++looped;
        continue;
      }
      for (size_t i = 0; i < points.size(); ++i) {
        Power expected = Power::NotReached;
        try {
          if (evaluation.isReached(points[i].value))
            expected = evaluation.valueOf(points[i].value) != 0 ? Power::On : Power::Off;
        } catch (const std::out_of_range&) { // follows from the clock or the host
          ++notAlone;
          continue;
        }
        ASSERT_EQ(static_cast<int>(flow.powers(run)[i]), static_cast<int>(expected))
            << "scan " << scan << ", rung " << rungs[run.lowered]->number << ", point " << i << ": "
            << elements.all()[elements.elementOfPin(points[i].pin)].pins[0].text;
        ++seen[points[i].pin][static_cast<size_t>(expected)];
      }
    }
  }
  uint64_t compared = 0, both = 0;
  for (const auto& times : seen) {
    compared += times[0] + times[1] + times[2];
    both += times[1] != 0 && times[2] != 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 1000u);
  EXPECT_GT(both, elements.pinCount() / 10) << "of " << elements.pinCount();
  EXPECT_LT(looped + notAlone, compared / 5);
}

INSTANTIATE_TEST_SUITE_P(Examples, Flows,
                         testing::Values("examples/fanuc-vmc", "examples/gsk-mill", "examples/gsk-panel",
                                         "examples/nct-lathe", "examples/nct-turning-centre",
                                         "examples/technol-machining-centre", "examples/technol-magazine",
                                         "examples/technol-mill"));

class SameProgram : public testing::TestWithParam<const char*> {};

// So that states and recordings of the one are states and recordings of the other.
TEST_P(SameProgram, HasTheMemoryAndChunksOfTheCompiledOne) {
  const std::unique_ptr<Example> marked = compileExample(GetParam());
  compiler::CompileRequest request = marked->request;
  request.marks = false;
  Diagnostics diagnostics;
  const auto plain = compiler::compile(marked->sources, marked->files, request, diagnostics);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->codeHash, marked->compiled->codeHash);
  FlowEngine engine(*marked->compiled);
  const rung_program& program = engine.engine().program();
  EXPECT_EQ(program.code_hash, plain->codeHash);
  EXPECT_EQ(program.layout_hash, plain->layout->memory().hash());
  EXPECT_EQ(program.chunk_count, plain->layout->partition().chunks().size());
}

INSTANTIATE_TEST_SUITE_P(Examples, SameProgram,
                         testing::Values("examples/fanuc-vmc", "examples/gsk-mill", "examples/nct-turning-centre",
                                         "examples/technol-machining-centre"));

// Both engines from the same state: the same memory after each scan.
TEST_P(SameProgram, DoesTheSame) {
  const std::unique_ptr<Example> example = compileExample(GetParam());
  FlowEngine engine(*example->compiled);
  ir::InterpEngine optimised(*example->compiled->layout, example->compiled->codeHash);
  runtime::Instance flowing(engine.engine()), running(optimised);
  std::mt19937 random(5);
  std::vector<uint8_t> state(size_t{1} << 20);
  for (int scan = 0; scan < 200; ++scan) {
    if (running.faulted()) running.coldStart();
    disturb(running, random);
    core::Saver saver(state);
    ASSERT_TRUE(running.save(saver) && saver.fits());
    core::Loader loader(std::span(state).first(saver.size()));
    ASSERT_EQ(flowing.load(loader), runtime::LoadResult::Loaded);
    running.scan();
    engine.observe(flowing, [&] { flowing.scan(); });
    ASSERT_EQ(flowing.faulted(), running.faulted());
    const rung_program& program = running.program();
    for (uint32_t space = 0; space < program.space_count; ++space)
      for (uint32_t byte = 0; byte < program.spaces[space].byte_count; ++byte)
        ASSERT_EQ(flowing.memory().readByte(space, byte), running.memory().readByte(space, byte))
            << "scan " << scan << ", " << program.spaces[space].name << " " << byte;
  }
}

TEST(Flow, SaysWhatEachElementDidAndWhichRungsDidNotRun) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer("t.pmc", "dialect gsk\nFUNC END1\n"
                                                 "LD X0.0\nFUNC JMPB\nPRM L1\n"
                                                 "LD X0.1\nOUT R0.0\n"
                                                 "FUNC LBL\nPRM L1\n"
                                                 "LD X0.2\nANI X0.3\nOUT R0.1\nFUNC END2\n");
  compiler::CompileRequest request;
  request.marks = true;
  const FileId files[] = {file};
  const auto compiled = compiler::compile(sources, files, request, diagnostics);
  ASSERT_TRUE(compiled) << renderText(diagnostics, sources);
  FlowEngine engine(*compiled);
  runtime::Instance instance(engine.engine());
  const uint32_t x = runtime::findSpace(instance.program(), "X");
  instance.memory().writeByte(x, 0, 0b0101);
  const Flow& flow = engine.observe(instance, [&] { instance.scan(); });
  std::string text;
  const std::vector<std::optional<Power>> powers = flow.lastPowers();
  const std::vector<uint32_t> times = flow.timesRun();
  for (uint32_t r = 0; r < engine.elements().rungs().size(); ++r) {
    const SourceRung& rung = engine.elements().rungs()[r];
    text += fmt::format("rung {} line {} x{}:", rung.number, rung.line, times[r]);
    for (uint32_t e = 0; e < rung.elementCount; ++e) {
      const Element& element = engine.elements().all()[rung.firstElement + e];
      for (uint32_t p = 0; p < element.pins.size(); ++p) {
        const std::optional<Power>& power = powers[element.firstPin + p];
        text += fmt::format(" {}:{} {} {};", element.line, element.column, element.pins[p].text,
                            !power                ? "-"
                            : *power == Power::On ? "on"
                                                  : "off");
      }
    }
    text += "\n";
  }
  EXPECT_EQ(text, "rung 1 line 3 x1: 3:1 LD X0.0 on; 4:1 JMPB L1 on;\n"
                  "rung 2 line 6 x0: 6:1 LD X0.1 -; 7:1 OUT R0.0 -;\n"
                  "rung 3 line 8 x1:\n"
                  "rung 4 line 10 x1: 10:1 LD X0.2 on; 11:1 ANI X0.3 on; 12:1 OUT R0.1 on;\n");
  std::string accesses;
  const auto drawnLast =
      std::ranges::find_if(flow.runs(), [&](const RungFlow& run) { return engine.rung(run.lowered).number == 4; });
  ASSERT_NE(drawnLast, flow.runs().end());
  for (const ir::Access& access : flow.accesses(*drawnLast))
    if (const auto place = engine.knownPlace(access))
      accesses += fmt::format("{} {} = {}; ", access.writes ? "write" : "read",
                              report::shownName(instance.program(), report::refAt(*place)), engine.shownValue(access));
  EXPECT_EQ(accesses, "read KEY_MDI (X0.2) = 1; read KEY_MANUAL (X0.3) = 0; write R0.1 = 1; ");
  const ir::BitRange bit{ir::SpaceId{x}, 3, 1};
  EXPECT_EQ(valueOf(flow.accesses(*drawnLast), bit), 0u);
}

} // namespace
} // namespace rung::replay
