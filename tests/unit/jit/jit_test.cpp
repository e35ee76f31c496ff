// The JIT as an engine, its units and threads, and its cache of object files. That it computes what the interpreter
// computes is the differential tests' matter.
#include "codegen/jit/jit_engine.h"
#include "codegen/jit/object_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <unistd.h>

#include <fmt/format.h>

#include "ir/core/builder.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/instance.h"
#include "tests/unit/llvm/sample_module.h"

namespace rung::codegen {
namespace {

using namespace ir;
namespace fs = std::filesystem;
using testing::HasSubstr;

std::unique_ptr<JitEngine> compiled(const Layout& layout, const JitOptions& options, uint64_t codeHash = 1) {
  Result<std::unique_ptr<JitEngine>> engine = compileJit(layout, codeHash, options);
  if (engine.ok()) return std::move(engine).value();
  ADD_FAILURE() << engine.error();
  return nullptr;
}

// Rung i copies bit i of A to bit i of B, inverted in every other rung.
Module copyModule(uint32_t rungs) {
  Module m = sampleModule();
  m.spaces.push_back({.name = "A", .unitBytes = 1, .units = rungs / 8 + 1});
  m.spaces.push_back({.name = "B", .unitBytes = 1, .units = rungs / 8 + 1});
  m.routines[0].rungs.assign(rungs, {});
  for (uint32_t i = 0; i < rungs; ++i) {
    m.routines[0].rungs[i].begin = {FileIndex{0}, i + 1, 1};
    RungBuilder b(m, m.routines[0].rungs[i]);
    const ValueId bit = b.load(Type::Bit, {SpaceId{3}, i / 8, i % 8});
    b.store({SpaceId{4}, i / 8, i % 8}, i % 2 == 0 ? bit : b.not_(bit));
  }
  m.tasks[0].budget = 10 * rungs;
  return m;
}

class JitLevels : public testing::TestWithParam<LlvmLevel> {};

TEST_P(JitLevels, RunsCallsAndTraps) {
  std::unique_ptr<JitEngine> engine;
  {
    const Module module = sampleModule();
    const Layout layout(module, {});
    engine = compiled(layout, {.code = {.level = GetParam(), .target = {}}});
    ASSERT_NE(engine, nullptr);
    EXPECT_EQ(engine->program().layout_hash, layout.memory().hash());
  } // the engine needs neither
  EXPECT_EQ(engine->name(), "jit");
  runtime::Instance instance(engine->program());
  EXPECT_EQ(instance.write(*nc::resolve(instance.program(), "X0.0"), 1), std::nullopt);
  instance.scan();
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "LAMP")), 1u);
  instance.scan();
  instance.scan();
  EXPECT_TRUE(instance.faulted());
  EXPECT_EQ(instance.fault().line, 11u);
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D4:2")), 2u);
}

INSTANTIATE_TEST_SUITE_P(Both, JitLevels, testing::Values(LlvmLevel::Fast, LlvmLevel::Opt),
                         [](const auto& test) { return test.param == LlvmLevel::Fast ? "Fast" : "Opt"; });

TEST(Jit, ManyPiecesOnTwoThreads) {
  constexpr uint32_t kRungs = 10'000;
  const Module module = copyModule(kRungs);
  const Layout layout(module, {});
  const auto engine = compiled(layout, {.code = {.level = LlvmLevel::Fast, .target = {}}, .threads = 2});
  ASSERT_NE(engine, nullptr);
  EXPECT_GT(engine->report().modules, 2u);
  runtime::Instance instance(engine->program());
  for (uint32_t i = 0; i < kRungs; i += 3) instance.memory().writeBit(3, i / 8, i % 8, true);
  instance.scan();
  ASSERT_FALSE(instance.faulted()) << instance.faultText();
  for (uint32_t i = 0; i < kRungs; ++i)
    ASSERT_EQ(instance.memory().readBit(4, i / 8, i % 8), (i % 3 == 0) != (i % 2 != 0)) << i;
}

TEST(Jit, OnlyThisMachine) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const auto engine = compileJit(layout, 1, {.code = {.target = "aarch64-linux-gnu"}});
  ASSERT_FALSE(engine.ok());
  EXPECT_THAT(engine.error(), HasSubstr("this machine"));
}

TEST(Jit, TellsADebugger) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  EXPECT_NE(compiled(layout, {.code = {}, .gdb = true}), nullptr);
}

class JitCache : public testing::Test {
protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  uint32_t taken(const LlvmOptions& code, uint64_t codeHash = 1) {
    const auto engine = compiled(layout_, {.code = code, .cacheFolder = folder_.string()}, codeHash);
    if (engine == nullptr) return 1000;
    EXPECT_EQ(engine->report().cacheTrouble, "");
    runtime::Instance instance(engine->program());
    EXPECT_EQ(instance.write(*nc::resolve(instance.program(), "X0.0"), 1), std::nullopt);
    instance.scan();
    EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D4:2")), 1u);
    return engine->report().fromCache;
  }
  std::vector<fs::path> files() const { return {fs::directory_iterator(folder_), fs::directory_iterator()}; }

  Module module_ = sampleModule();
  Layout layout_{module_, {}};
  fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("rung-cache-{}", getpid());
};

TEST_F(JitCache, TakesWhatIsTheSame) {
  EXPECT_EQ(taken({}), 0u);
  EXPECT_EQ(taken({}), 1u);
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(JitCache, LeavesWhatDiffers) {
  EXPECT_EQ(taken({}), 0u);
  EXPECT_EQ(taken({}, 2), 0u) << "another program";
  EXPECT_EQ(taken({.level = LlvmLevel::Fast}), 0u);
  EXPECT_EQ(taken({.debugInfo = false}), 0u);
  layout_ = Layout(module_, {.partition = {.maxChunkRungs = 1}});
  EXPECT_EQ(taken({}), 0u) << "other chunks";
  EXPECT_EQ(files().size(), 5u);
}

TEST_F(JitCache, LeavesWhatIsDamaged) {
  EXPECT_EQ(taken({}), 0u);
  const fs::path file = files().at(0);
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_EQ(taken({}), 0u) << "cut";
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(100).put('!');
  EXPECT_EQ(taken({}), 0u) << "changed";
  EXPECT_EQ(taken({}), 1u) << "written anew";
}

TEST_F(JitCache, LeavesWhatOthersCouldHaveWritten) {
  EXPECT_EQ(taken({}), 0u);
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
  fs::permissions(files().at(0), fs::perms::others_write, fs::perm_options::add);
  EXPECT_EQ(taken({}), 0u);
  EXPECT_EQ(taken({}), 1u) << "written anew";
  fs::permissions(folder_, fs::perms::others_write, fs::perm_options::add);
  const auto engine = compiled(layout_, {.code = {}, .cacheFolder = folder_.string()});
  ASSERT_NE(engine, nullptr);
  EXPECT_EQ(engine->report().fromCache, 0u);
  EXPECT_THAT(engine->report().cacheTrouble, testing::HasSubstr("every user may write to it"));
}

// What the file of one key holds goes under the name of another.
class JitCacheOfOthers : public JitCache {
protected:
  // Compiles with `other` and then with `own`; gives the two files.
  std::pair<fs::path, fs::path> filesOf(const std::function<void()>& other, const std::function<void()>& own) {
    other();
    const fs::path first = files().at(0);
    own();
    for (const fs::path& file : files())
      if (file != first) return {first, file};
    ADD_FAILURE() << "both have one key";
    return {first, first};
  }
  static void overwrite(const fs::path& file, const fs::path& by) {
    fs::copy_file(by, file, fs::copy_options::overwrite_existing);
  }
  static std::string bytesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::string keyOf(const fs::path& file) {
    std::string key;
    for (const std::string name = file.stem().string(); key.size() < name.size() / 2;)
      key += static_cast<char>(std::stoi(name.substr(2 * key.size(), 2), nullptr, 16));
    return key;
  }
};

TEST_F(JitCacheOfOthers, AnotherProgram) {
  const auto [other, own] = filesOf([&] { taken({}, 2); }, [&] { taken({}); });
  overwrite(own, other);
  EXPECT_EQ(taken({}), 0u) << "compiled again";
  EXPECT_EQ(taken({}), 1u) << "and kept";
}

TEST_F(JitCacheOfOthers, AnotherCut) {
  const auto [other, own] = filesOf(
      [&] {
        layout_ = Layout(module_, {.partition = {.maxChunkRungs = 1}});
        taken({});
      },
      [&] {
        layout_ = Layout(module_, {});
        taken({});
      });
  overwrite(own, other);
  EXPECT_EQ(taken({}), 0u);
}

// The key is in the object too; with it changed, as another version of the compiler would have written it, or with
// another number of chunks, and a right checksum, the object is not taken.
TEST_F(JitCacheOfOthers, AnotherIdentity) {
  EXPECT_EQ(taken({}), 0u);
  const fs::path file = files().at(0);
  const std::string sound = bytesOf(file);
  const std::string key = keyOf(file);
  const size_t at = sound.find(key);
  ASSERT_NE(at, std::string::npos) << "the object holds its key";
  for (const size_t place : {size_t{0}, size_t{31}, key.size()}) {
    std::string object = sound.substr(0, sound.rfind("rung-object "));
    object[at + place] ^= 1;
    std::ofstream(file, std::ios::binary) << object << cacheSeal(object);
    EXPECT_EQ(taken({}), 0u) << place;
  }
  std::ofstream(file, std::ios::binary) << cacheSeal("");
  EXPECT_EQ(taken({}), 0u) << "not an object";
  EXPECT_EQ(taken({}), 1u);
}

// What makes code is in the key, each by itself.
TEST(CacheKeys, CoverWhatMakesCode) {
  Module module = copyModule(64);
  const Layout layout(module, {.partition = {.maxChunkRungs = 16}});
  const ModulePart whole{.chunkCount = 4};
  const auto keyOf = [&](const Layout& own, const ModulePart& unit, std::string_view version = "1",
                         std::string_view machine = "m") { return CacheKeys(own, 1, {}, machine, version).of(unit); };
  const CacheKey key = keyOf(layout, whole);
  EXPECT_EQ(keyOf(layout, whole), key);
  EXPECT_NE(keyOf(layout, whole, "2"), key) << "version of the compiler";
  EXPECT_NE(keyOf(layout, whole, "1", "n"), key) << "machine";
  EXPECT_NE(keyOf(layout, {.firstChunk = 2, .chunkCount = 2}), keyOf(layout, {.firstChunk = 1, .chunkCount = 2}));
  EXPECT_NE(keyOf(layout, {.firstChunk = 2, .chunkCount = 2}), keyOf(layout, {.firstChunk = 2, .chunkCount = 1}));
  EXPECT_NE(keyOf(Layout(module, {.partition = {.maxChunkRungs = 8}}), whole), key) << "other chunks";
  EXPECT_NE(keyOf(Layout(module, {.partition = {.maxChunkRungs = 16}, .expandBits = false}), whole), key)
      << "other memory";
  module.routines[0].rungs[0].begin.line = 99;
  EXPECT_NE(keyOf(layout, whole), key) << "another text: debug information";
}

// A rung that is edited changes the key of its own unit alone, where the memory stays as it is.
TEST(CacheKeys, AreThoseOfPieces) {
  Module module = copyModule(64);
  const LlvmOptions code{.debugInfo = false, .target = {}};
  const ModulePart first{.chunkCount = 2};
  const ModulePart second{.firstChunk = 2, .chunkCount = 2};
  const auto keyOf = [&](const ModulePart& unit) {
    const Layout layout(module, {.partition = {.maxChunkRungs = 16}});
    return CacheKeys(layout, 1, code, "m", "1").of(unit);
  };
  const CacheKey before = keyOf(first);
  const CacheKey beforeSecond = keyOf(second);
  Rung& edited = module.routines[0].rungs[5];
  edited = {};
  RungBuilder b(module, edited);
  b.store({SpaceId{4}, 0, 5}, b.load(Type::Bit, {SpaceId{3}, 0, 6}));
  EXPECT_NE(keyOf(first), before);
  EXPECT_EQ(keyOf(second), beforeSecond);
  const CacheKey after = keyOf(first);
  edited.begin.line = 70; // no code names it
  EXPECT_EQ(keyOf(first), after);
  b.trap(b.bit(true), FaultId{0});
  const CacheKey withFault = keyOf(first);
  EXPECT_NE(withFault, after);
  edited.begin.line = 71;
  EXPECT_EQ(keyOf(first), withFault) << "a fault names the line, which the linker puts in";
}

// What is inserted above moves a unit and changes the numbers of its chunks, rungs and lines.
TEST(CacheKeys, AreTheSameWhereverThePieceIs) {
  Module module = copyModule(64);
  std::vector<Rung>& rungs = module.routines[0].rungs;
  for (const uint32_t rung : {20U, 40U}) {
    RungBuilder b(module, rungs[rung]);
    b.trap(b.bit(false), FaultId{0});
    b.message(0, b.i32(1), b.i32(0), b.i32(0), b.constant(Type::I64, 0));
  }
  const LlvmOptions code{.debugInfo = false, .target = {}};
  const auto keyOf = [&](const ModulePart& unit) {
    const Layout layout(module, {.partition = {.maxChunkRungs = 16}});
    return CacheKeys(layout, 1, code, "m", "1").of(unit);
  };
  const CacheKey before = keyOf({.firstChunk = 1, .chunkCount = 3});
  const std::vector<Rung> more(rungs.begin(), rungs.begin() + 16);
  rungs.insert(rungs.begin(), more.begin(), more.end());
  for (uint32_t i = 0; i < rungs.size(); ++i) rungs[i].begin.line = i + 1;
  EXPECT_EQ(keyOf({.firstChunk = 2, .chunkCount = 3}), before);
  EXPECT_NE(keyOf({.firstChunk = 1, .chunkCount = 3}), before);
}

// Weights that another version of the layout calculates from the same program.
TEST(CacheKeys, CoverTheWeightsOfWays) {
  Module module = copyModule(3);
  module.routines[0].rungs[0].transfer = {.kind = TransferKind::Goto, .cond = ValueId{0}, .target = 2};
  const Layout before(module, {});
  module.routines[0].rungs[2].weight = 7;
  const Layout after(module, {}); // both belong to this module: they differ in what they have calculated
  const ModulePart whole{.chunkCount = 1};
  EXPECT_EQ(before.memory().text(), after.memory().text());
  EXPECT_NE(CacheKeys(before, 1, {}, "m", "1").of(whole), CacheKeys(after, 1, {}, "m", "1").of(whole));
}

TEST(CacheKeys, TheVersionIsOfTheSources) { EXPECT_EQ(codeVersion().size(), 64u); }

TEST_F(JitCache, RunsWithoutIt) {
  std::ofstream(folder_) << "a file where the folder should be";
  const auto engine = compiled(layout_, {.code = {}, .cacheFolder = folder_.string()});
  ASSERT_NE(engine, nullptr);
  EXPECT_NE(engine->report().cacheTrouble, "");
}

} // namespace
} // namespace rung::codegen
