// Plug-ins: one that is not there, one of another build, and LLVM's back end, which is loaded when it is needed.
#include "rtlib/load/plugin.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "codegen/plugin/functions.h"

namespace rung {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

bool isLoaded(const std::string& library) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    if (line.find(library) != std::string::npos) return true;
  return false;
}

[[noreturn]] void loadAndExit() {
  const bool before = isLoaded("libLLVM");
  const bool found = codegen::sectionOf("no object", ".rung.ir").value().has_value();
  std::fprintf(stderr, "before %d, found %d, after %d", before, found, isLoaded("libLLVM"));
  std::exit(0);
}

// In a process that begins anew, as what is loaded stays.
TEST(Plugin, LlvmIsLoadedWhenItIsNeeded) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(loadAndExit(), testing::ExitedWithCode(0), "before 0, found 0, after 1");
}

TEST(Plugin, ThatIsNotThere) {
  const runtime::Plugin plugin("no-such.so", "any");
  EXPECT_FALSE(plugin.ok());
  EXPECT_THAT(plugin.problem(), HasSubstr("/lib/rung/no-such.so: cannot open shared object file"));
}

TEST(Plugin, OfAnotherBuildIsRefused) {
  const runtime::Plugin plugin(codegen::kLlvmPlugin, "another build");
  EXPECT_FALSE(plugin.ok());
  EXPECT_THAT(plugin.problem(),
              EndsWith("rung-llvm.so: it is of another build than this program; install both together"));
}

// What fails in there does not end the program, nor is it thrown through the library.
TEST(Plugin, WhatFailsInItIsAFailure) {
  codegen::JitOptions options;
  options.code.target = "riscv64-linux-gnu";
  EXPECT_EQ(codegen::makeJitCode(options).error(), "the JIT makes code for this machine only");
}

} // namespace
} // namespace rung
