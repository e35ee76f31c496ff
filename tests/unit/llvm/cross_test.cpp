// Shared objects for other processors, run in their emulators: each must do, scan by scan, what the interpreter does
// here. The host is the same plain C on both sides (mini_host.c).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <fmt/format.h>

#include "codegen/llvm/llvm_emitter.h"
#include "ir/core/op_info.h"
#include "ir/interp/interp.h"
#include "rtlib/load/file.h"
#include "tests/random/random.h"
#include "tests/support/saboteur.h"
#include "tests/unit/llvm/mini_host.h"

namespace rung::codegen {
namespace {

using namespace ir;
namespace fs = std::filesystem;

constexpr uint32_t kScans = 4;
constexpr const char* kCompile = "{}-gcc -std=c11 -O1 -Irtlib/abi -Itests/unit/llvm "
                                 "tests/unit/llvm/mini_host.c tests/unit/llvm/mini_host_main.c -ldl -o '{}'";
constexpr const char* kRun = "{} -L /usr/{} '{}' '{}' {} > '{}'";

struct Processor {
  const char* target; // of Rung
  const char* tools;  // what the names of its compiler and its libraries' folder begin with
  const char* emulator;
};
constexpr Processor kProcessors[] = {
    {"aarch64-linux-gnu", "aarch64-linux-gnu", "qemu-aarch64-static"},
    {"armv7-linux-gnueabihf", "arm-linux-gnueabihf", "qemu-arm-static"},
};

bool works(const std::string& command) { return std::system((command + " > /dev/null 2>&1").c_str()) == 0; }

class Cross : public testing::TestWithParam<Processor> {
protected:
  void SetUp() override {
    const Processor& to = GetParam();
    if (!works(fmt::format("{} --version", to.emulator)) || !works(fmt::format("{}-gcc --version", to.tools)))
      GTEST_SKIP() << "qemu-user-static and the compilers of other processors are not installed; ./dev setup does it";
    fs::create_directories(folder_);
    ASSERT_EQ(std::system(fmt::format(kCompile, to.tools, file("mini_host")).c_str()), 0);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const char* name) const { return (folder_ / name).string(); }

  static std::vector<std::string> hereLines(const Layout& layout) {
    InterpEngine engine(layout, 1);
    std::vector<uint64_t> hashes(kScans);
    EXPECT_EQ(miniHostRun(&engine.program(), engine.context(), kScans, hashes.data()), 0)
        << "too large for the small host";
    std::vector<std::string> lines;
    for (uint64_t hash : hashes) lines.push_back(fmt::format("{:016x}", hash));
    return lines;
  }

  std::vector<std::string> thereLines(const Layout& layout, LlvmOptions options) const {
    options.target = GetParam().target;
    const Result<std::string> built = buildLlvmSharedObject(layout, 1, options);
    if (!built.ok()) return {built.error()};
    if (std::string wrong = runtime::replaceFile(file("program.so"), built.value()); !wrong.empty()) return {wrong};
    const Processor& to = GetParam();
    if (std::system(fmt::format(kRun, to.emulator, to.tools, file("mini_host"), file("program.so"), kScans, file("out"))
                        .c_str()) != 0)
      return {"the emulated host failed"};
    std::ifstream in(file("out"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }

private:
  const fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("rung-cross-{}", getpid());
};
INSTANTIATE_TEST_SUITE_P(Processors, Cross, testing::ValuesIn(kProcessors),
                         [](const auto& info) { return std::string(info.param.target, 5); });

TEST_P(Cross, EveryOperation) {
  for (const OpInfo& info : allOps()) {
    const Module module = moduleForOp(info.code);
    const Layout layout(module, {});
    EXPECT_EQ(thereLines(layout, {.level = LlvmLevel::Opt}), hereLines(layout)) << info.name;
  }
}

TEST_P(Cross, RandomProgramsFast) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const Module module = randomModule(seed);
    const Layout layout(module, {.partition = {.maxChunkRungs = 4}});
    EXPECT_EQ(thereLines(layout, {.level = LlvmLevel::Fast}), hereLines(layout)) << "seed " << seed;
  }
}

TEST_P(Cross, AWrongProgramShows) {
  const Module module = moduleForOp(findOp("add")->code);
  const Layout layout(module, {});
  Module wrong = module;
  sabotage(wrong, findOp("add")->code);
  EXPECT_NE(thereLines(layout.over(wrong), {}), hereLines(layout));
}

} // namespace
} // namespace rung::codegen
