// The bench compares like with like: each generated program of each dialect does what its straight-line forms do.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

#include "codegen/cpp/cpp_emitter.h"
#include "ir/support/diag_render.h"
#include "ir/support/temporary_folder.h"
#include "tools/bench/generated/side.h"
#include "tools/compiler/compile.h"
#include "tools/compiler/engines.h"

namespace rung {
namespace {

constexpr uint32_t kRungs = 100;
constexpr int kScans = 200;

std::unique_ptr<host::Engine> engineOf(const bench::Program& program, std::string& error) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer(program.file, program.text);
  const auto compiled = compiler::compile(sources, {&file, 1}, {}, diagnostics);
  if (!compiled) {
    error = renderText(diagnostics, sources);
    return nullptr;
  }
  auto engine = compiler::makeEngine(compiler::EngineKind::Interp, *compiled, {});
  if (!engine.ok()) {
    error = engine.error();
    return nullptr;
  }
  return std::move(engine).value();
}

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
    std::string error;
    const auto engine = engineOf(program.value(), error);
    ASSERT_NE(engine, nullptr) << error;
    const auto ours = bench::Ours::make(*engine, program.value());
    ASSERT_TRUE(ours.ok()) << ours.error();
    for (const auto form : {bench::BitForm::Byte, bench::BitForm::Packed}) {
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
                         testing::Values("bits", "timers-idle", "timers-running", "counters", "integers", "reals",
                                         "indexed", "signals", "mechanisms-idle", "mechanisms-waiting", "mechanisms",
                                         "full"));

TEST(GeneratedInstructions, CompileAndRunInEachDialect) {
  for (const std::string_view dialect : bench::kDialects) {
    const auto form = bench::formOf(dialect);
    for (const bench::Instruction& row : form->instructions()) {
      SCOPED_TRACE(std::string(dialect) + ": " + row.title);
      const bench::Program program = form->repeat(row.text, 3);
      std::string error;
      const auto engine = engineOf(program, error);
      ASSERT_NE(engine, nullptr) << error;
      const auto ours = bench::Ours::make(*engine, program);
      ASSERT_TRUE(ours.ok()) << ours.error();
      ours.value()->beginWith(true);
      for (int scan = 0; scan < 3; ++scan) ours.value()->scan();
      EXPECT_FALSE(ours.value()->instance().faulted()) << ours.value()->instance().faultText();
    }
  }
}

} // namespace
} // namespace rung
