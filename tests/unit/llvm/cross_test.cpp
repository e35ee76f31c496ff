// Shared objects for another processor, run in its emulator: each must do, scan by scan, what the interpreter does
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
#include "rtlib/host/file.h"
#include "tests/random/random.h"
#include "tests/support/saboteur.h"
#include "tests/unit/llvm/mini_host.h"

namespace rung::codegen {
namespace {

using namespace ir;
namespace fs = std::filesystem;

constexpr uint32_t kScans = 4;
constexpr const char* kCompile = "aarch64-linux-gnu-gcc -std=c11 -O1 -Irtlib/abi -Itests/unit/llvm "
                                 "tests/unit/llvm/mini_host.c tests/unit/llvm/mini_host_main.c -ldl -o '{}'";
constexpr const char* kRun = "qemu-aarch64-static -L /usr/aarch64-linux-gnu '{}' '{}' {} > '{}'";

bool works(const std::string& command) { return std::system((command + " > /dev/null 2>&1").c_str()) == 0; }

class Aarch64 : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = new fs::path(fs::path(testing::TempDir()) / fmt::format("rung-cross-{}", getpid()));
    fs::create_directories(*folder_);
    toolsThere_ = works("qemu-aarch64-static --version") && works("aarch64-linux-gnu-gcc --version");
    if (toolsThere_) {
      ASSERT_EQ(std::system(fmt::format(kCompile, file("mini_host")).c_str()), 0);
    }
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    delete folder_;
  }
  void SetUp() override {
    if (!toolsThere_)
      GTEST_SKIP()
          << "qemu-user-static, gcc-aarch64-linux-gnu and libc6-dev-arm64-cross are not installed; ./dev setup does it";
  }

  static std::string file(const char* name) { return (*folder_ / name).string(); }

  static std::vector<std::string> hereLines(const Layout& layout) {
    InterpEngine engine(layout, 1);
    std::vector<uint64_t> hashes(kScans);
    EXPECT_EQ(miniHostRun(&engine.program(), engine.context(), kScans, hashes.data()), 0)
        << "too large for the small host";
    std::vector<std::string> lines;
    for (uint64_t hash : hashes) lines.push_back(fmt::format("{:016x}", hash));
    return lines;
  }

  static std::vector<std::string> thereLines(const Layout& layout, const LlvmOptions& options) {
    const Result<std::string> built = buildLlvmSharedObject(layout, 1, options);
    if (!built.ok()) return {built.error()};
    if (std::string wrong = host::replaceFile(file("program.so"), built.value()); !wrong.empty()) return {wrong};
    if (std::system(fmt::format(kRun, file("mini_host"), file("program.so"), kScans, file("out")).c_str()) != 0)
      return {"the emulated host failed"};
    std::ifstream in(file("out"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }

  static inline fs::path* folder_ = nullptr;
  static inline bool toolsThere_ = false;
};

TEST_F(Aarch64, EveryOperation) {
  for (const OpInfo& info : allOps()) {
    const Module module = moduleForOp(info.code);
    const Layout layout(module, {});
    EXPECT_EQ(thereLines(layout, {.level = LlvmLevel::Opt, .target = "aarch64-linux-gnu"}), hereLines(layout))
        << info.name;
  }
}

TEST_F(Aarch64, RandomProgramsFast) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const Module module = randomModule(seed);
    const Layout layout(module, {.cut = {.maxChunkRungs = 4}});
    EXPECT_EQ(thereLines(layout, {.level = LlvmLevel::Fast, .target = "aarch64-linux-gnu"}), hereLines(layout))
        << "seed " << seed;
  }
}

TEST_F(Aarch64, AWrongProgramShows) {
  const Module module = moduleForOp(findOp("add")->code);
  const Layout layout(module, {});
  Module wrong = module;
  sabotage(wrong, findOp("add")->code);
  EXPECT_NE(thereLines(layout.over(wrong), {.target = "aarch64-linux-gnu"}), hereLines(layout));
}

} // namespace
} // namespace rung::codegen
