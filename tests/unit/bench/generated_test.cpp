// The bench compares like with like: each generated program of each dialect does what its straight-line forms do.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "codegen/cpp/cpp_emitter.h"
#include "compiler/compile.h"
#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "ir/support/temporary_folder.h"
#include "tools/bench/generated/side.h"

namespace rung {
namespace {

constexpr uint32_t kRungs = 100;
constexpr int kScans = 200;

// A program in the interpreter, with what that one needs to live.
class Interpreted {
public:
  explicit Interpreted(const bench::Program& program) {
    const FileId file = sources_.addBuffer(program.file, program.text);
    compiled_ = compiler::compile(sources_, {&file, 1}, {}, diagnostics_);
    if (!compiled_) {
      error_ = renderText(diagnostics_, sources_);
      return;
    }
    auto engine = compiler::makeEngine(compiler::EngineKind::Interp, *compiled_, {});
    if (engine.ok())
      engine_ = std::move(engine).value();
    else
      error_ = engine.error();
  }
  const std::string& error() const { return error_; }
  runtime::Engine& engine() { return *engine_; }

private:
  SourceManager sources_;
  Diagnostics diagnostics_;
  std::optional<compiler::Compiled> compiled_;
  std::unique_ptr<runtime::Engine> engine_;
  std::string error_;
};

std::unique_ptr<bench::Straight> straightOf(const bench::Work& work, bench::BitForm form, int msAScan,
                                            std::string& error) {
  codegen::CppBuildOptions options;
  options.compiler = "g++";
  options.optimisation = "-O0";
  options.debugInfo = false;
  const auto image = codegen::buildCppSharedObject(straightSource(work, form), options);
  const TemporaryFolder folder;
  const std::string path = (folder / "straight.so").string();
  if (image.ok()) std::ofstream(path, std::ios::binary) << image.value();
  auto loaded = image.ok() ? bench::Straight::load(path, work, form, msAScan) : image.failure();
  if (loaded.ok()) return std::move(loaded).value();
  error = loaded.error();
  return nullptr;
}

class GeneratedProgram : public testing::TestWithParam<const char*> {};

TEST_P(GeneratedProgram, DoesInEachDialectWhatItsStraightLineFormsDo) {
  const bench::Work work = bench::drawWork(*bench::kindFromName(GetParam()), kRungs);
  int dialects = 0;
  for (const std::string_view dialect : bench::kDialects) {
    SCOPED_TRACE(dialect);
    const Result<bench::Program> program = bench::formOf(dialect)->write(work);
    if (!program.ok()) continue; // no such thing there
    ++dialects;
    Interpreted interpreted(program.value());
    ASSERT_EQ(interpreted.error(), "");
    const auto ours = bench::Ours::make(interpreted.engine(), program.value());
    ASSERT_TRUE(ours.ok()) << ours.error();
    for (const auto form : {bench::BitForm::Byte, bench::BitForm::Packed}) {
      std::string error;
      const auto straight = straightOf(work, form, program.value().msAScan, error);
      ASSERT_NE(straight, nullptr) << error;
      bench::Machine machine(work);
      ours.value()->begin(machine);
      straight->begin(machine);
      const bench::Values before = straight->values();
      for (int scan = 0; scan < kScans; ++scan) {
        const bench::Change change = machine.next();
        for (bench::Side* side :
             {static_cast<bench::Side*>(ours.value().get()), static_cast<bench::Side*>(straight.get())}) {
          side->apply(change);
          side->scan();
        }
        ASSERT_EQ(difference(ours.value()->values(), straight->values(), program.value()), "") << "scan " << scan;
      }
      const bool rests = std::string_view(GetParam()).ends_with("idle") || work.kind == bench::Kind::TimersRunning;
      EXPECT_EQ(straight->values() == before, rests) << "something happens, or nothing does";
    }
  }
  EXPECT_GE(dialects, 1);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GeneratedProgram,
                         testing::Values("bits", "arrays", "timers-idle", "timers-running", "counters", "integers",
                                         "reals", "indexed", "signals", "mechanisms-idle", "mechanisms-waiting",
                                         "mechanisms", "full"));

TEST(GeneratedInstructions, CompileAndRunInEachDialect) {
  for (const std::string_view dialect : bench::kDialects) {
    const auto form = bench::formOf(dialect);
    for (const bench::Instruction& row : form->instructions()) {
      SCOPED_TRACE(std::string(dialect) + ": " + row.title);
      const bench::Program program = form->repeat(row.text, 3);
      Interpreted interpreted(program);
      ASSERT_EQ(interpreted.error(), "");
      const auto ours = bench::Ours::make(interpreted.engine(), program);
      ASSERT_TRUE(ours.ok()) << ours.error();
      ours.value()->beginWith(true);
      for (int scan = 0; scan < 3; ++scan) ours.value()->scan();
      EXPECT_FALSE(ours.value()->instance().faulted()) << ours.value()->instance().faultText();
    }
  }
}

} // namespace
} // namespace rung
