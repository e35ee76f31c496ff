// Generated C++: a small program built by hand goes through g++ and clang++ into a shared object and runs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

#include "codegen/cpp/cpp_emitter.h"
#include "codegen/cpp/table_writer.h"
#include "ir/core/builder.h"
#include "ir/core/regions.h"
#include "rtlib/load/seal.h"
#include "rtlib/load/so_engine.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/instance.h"

namespace rung::codegen {
namespace {

using namespace ir;

// MAIN: Y0.0 := X0.0 and not X0.1; a counter word counts passes while Y0.0 is on, by a call; a trap when it reaches 3.
Module sampleModule() {
  Module m;
  m.name = "sample";
  m.dialect = "gsk";
  m.files = {"sample.pmc"};
  m.faults = {"limit reached", "dead-loop"};
  m.spaces = {{.name = "X", .unitBytes = 1, .units = 4, .flags = RUNG_SPACE_INPUT, .packedOnly = false},
              {.name = "Y", .unitBytes = 1, .units = 4, .flags = RUNG_SPACE_OUTPUT, .packedOnly = false},
              {.name = "D", .unitBytes = 1, .units = 16, .flags = 0, .packedOnly = false}};
  m.symbols.push_back({.name = "LAMP", .comment = "", .space = SpaceId{1}, .byte = 0, .bit = 0});
  m.safeSpans.push_back({SpaceId{1}, 0, 4});
  m.routines.resize(2);
  m.routines[0].name = "MAIN";
  m.routines[0].rungs.resize(2);
  m.routines[1].name = "COUNT";
  m.routines[1].rungs.resize(1);
  const Place lamp{SpaceId{1}, 0, 0};
  const Place count{SpaceId{2}, 4, 0};
  Rung& first = m.routines[0].rungs[0];
  first.title = "lamp \"one\"";
  first.sourceText = "LD X0.0\nANI X0.1\nOUT Y0.0";
  first.begin = {FileIndex{0}, 3, 1};
  {
    RungBuilder b(m, first);
    b.store(lamp, b.and_(b.load(Type::Bit, {SpaceId{0}, 0, 0}), b.not_(b.load(Type::Bit, {SpaceId{0}, 0, 1}))));
  }
  {
    RungBuilder b(m, m.routines[0].rungs[1]);
    b.call(RoutineId{1}, b.load(Type::Bit, lamp));
  }
  {
    RungBuilder b(m, m.routines[1].rungs[0]);
    b.setLine(9);
    const ValueId next = b.add(b.load(Type::I16, count), b.constant(Type::I16, 1));
    b.trap(b.eq(next, b.constant(Type::I16, 3)), FaultId{0});
    b.store(count, next);
  }
  m.tasks.push_back({.name = "MAIN",
                     .entry = RoutineId{0},
                     .periodUs = 8000,
                     .budget = 1000,
                     .budgetFault = FaultId{1},
                     .begin = {},
                     .end = {}});
  m.mainTask = TaskId{0};
  m.scan = {{RUNG_STEP_ADVANCE, {}, 8000}, {RUNG_STEP_RUN, TaskId{0}, 1}, {RUNG_STEP_SLOT, {}, 0}};
  return m;
}

// Of this process alone: tests run side by side.
std::string temporaryFile(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + name)).string();
}

class BuiltWith : public testing::TestWithParam<const char*> {};

TEST_P(BuiltWith, RunsCallsAndTraps) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const std::string path = temporaryFile("rung_cpp_test.so");
  CppBuildOptions options;
  options.compiler = GetParam();
  const Result<std::string> built = buildCppSharedObject(emitCpp(layout, 42, {}), options);
  ASSERT_TRUE(built.ok()) << built.error();
  std::string error = runtime::replaceFile(path, runtime::sealed(built.value()));
  const auto engine = runtime::SoEngine::open(path, error);
  std::filesystem::remove(path); // it is loaded
  ASSERT_NE(engine, nullptr) << error;
  EXPECT_EQ(engine->program().code_hash, 42u);
  EXPECT_EQ(engine->program().layout_hash, layout.memory().hash());
  runtime::Instance instance(engine->program());
  instance.scan();
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "Y0.0")), 0u);
  EXPECT_EQ(instance.write(*nc::resolve(instance.program(), "X0.0"), 1), std::nullopt);
  instance.scan();
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "LAMP")), 1u);
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D4:2")), 1u);
  instance.scan();
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D4:2")), 2u);
  instance.scan();
  EXPECT_TRUE(instance.faulted());
  EXPECT_EQ(instance.fault().line, 9u);
  EXPECT_NE(instance.faultText().find("limit reached"), std::string::npos);
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D4:2")), 2u) << "the trap comes before the store";
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "LAMP")), 0u) << "outputs go to their safe state";
}

// Y0.0 := X0.0 and X0.1 and X0.0 and … of 2,500 contacts.
Module longModule() {
  Module m = sampleModule();
  Rung& rung = m.routines[0].rungs[0];
  rung = {};
  rung.begin = {FileIndex{0}, 3, 1};
  RungBuilder b(m, rung);
  ValueId power = b.load(Type::Bit, {SpaceId{0}, 0, 0});
  for (uint32_t i = 1; i < 2'500; ++i)
    power = b.and_(power, b.load(Type::Bit, {SpaceId{0}, 0, static_cast<uint8_t>(i % 2)}));
  b.store({SpaceId{1}, 0, 0}, power);
  return m;
}

size_t stretchesIn(const std::string& text) {
  size_t count = 0;
  for (size_t at = text.find("asm goto"); at != std::string::npos; at = text.find("asm goto", at + 1)) ++count;
  return count;
}

TEST_P(BuiltWith, ALongRungIsBuiltInStretches) {
  const Module module = longModule();
  const Layout layout(module, {});
  const std::string text = emitCpp(layout, 42, {});
  EXPECT_EQ(stretchesIn(text), (module.routines[0].rungs[0].ops.size() - 1) / kStretch);
  const Module usual = sampleModule();
  EXPECT_EQ(stretchesIn(emitCpp(Layout(usual, {}), 42, {})), 0u);
  const std::string path = temporaryFile("rung_cpp_long_test.so");
  CppBuildOptions options;
  options.compiler = GetParam();
  const Result<std::string> built = buildCppSharedObject(text, options);
  ASSERT_TRUE(built.ok()) << built.error();
  std::string error = runtime::replaceFile(path, runtime::sealed(built.value()));
  const auto engine = runtime::SoEngine::open(path, error);
  std::filesystem::remove(path); // it is loaded
  ASSERT_NE(engine, nullptr) << error;
  runtime::Instance instance(engine->program());
  for (const bool on : {true, false}) {
    EXPECT_EQ(instance.write(*nc::resolve(instance.program(), "X0.0"), 1), std::nullopt);
    EXPECT_EQ(instance.write(*nc::resolve(instance.program(), "X0.1"), on), std::nullopt);
    instance.scan();
    EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "LAMP")), on ? 1u : 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Compilers, BuiltWith, testing::Values("g++", "clang++-19"), [](const auto& tested) {
  return std::string(tested.param).substr(0, 1) == "g" ? "Gcc" : "Clang";
});

TEST(CppEmitter, TextIsReadable) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const std::string text = emitCpp(layout, 42, {});
  EXPECT_NE(text.find(R"(
// MAIN.0 "lamp \"one\""
//   LD X0.0
//   ANI X0.1
//   OUT Y0.0
{
#line 3 "sample.pmc"
RUNG_LINE(
  const bool v0 = RUNG_FLAG()"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("// LAMP Y[0.0]"), std::string::npos);
  EXPECT_NE(text.find("const rung_program rung_program_table = {sizeof(rung_program), 7u, "), std::string::npos)
      << "the size on the machine that it is compiled for";
}

// What comes from outside does not leave its comment.
TEST(CppEmitter, NamesOfFilesAreNoCode) {
  Module module = sampleModule();
  module.name = "x\n#include <cstdio>\nstruct Hi {}; \\";
  module.files = {module.name};
  const Layout layout(module, {});
  const std::string text = emitCpp(layout, 42, {});
  EXPECT_TRUE(text.starts_with("// PLC program x\n// #include <cstdio>\n// struct Hi {}; \\ (gsk), generated by"))
      << text.substr(0, 200);
  EXPECT_NE(text.find("\n// from x\n// from #include <cstdio>\n// from struct Hi {};\n"), std::string::npos) << text;
}

// Names that overlap, that are no names of C++, that are mapped to one, and an address without a name.
TEST(CppEmitter, MemoryForDebuggers) {
  Module module = sampleModule();
  const SpaceId d{2};
  module.symbols.push_back({.name = "WORD", .comment = "", .space = d, .byte = 0, .type = RUNG_TYPE_I16});
  module.symbols.push_back({.name = "LOW", .comment = "", .space = d, .byte = 0, .type = RUNG_TYPE_I8});
  module.symbols.push_back({.name = "BIT9", .comment = "", .space = d, .byte = 1, .bit = 1});
  module.symbols.push_back({.name = "*ESP", .comment = "", .space = d, .byte = 2, .bit = 0});
  module.symbols.push_back({.name = "_ESP", .comment = "", .space = d, .byte = 2, .bit = 2});
  module.symbols.push_back({.name = "+ESP", .comment = "", .space = d, .byte = 2, .bit = 3});
  module.symbols.push_back({.name = "2x", .comment = "", .space = d, .byte = 3, .type = RUNG_TYPE_I8});
  module.symbols.push_back({.name = "new", .comment = "", .space = d, .byte = 6, .type = RUNG_TYPE_TEXT, .count = 2});
  module.symbols.push_back({.name = "REAL", .comment = "", .space = d, .byte = 8, .type = RUNG_TYPE_F64});
  module.symbols.push_back({.name = "LIMIT", .comment = "", .space = {}, .flags = RUNG_SYMBOL_CONST});
  module.symbols.push_back({.name = "@DR", .comment = "", .space = d, .byte = 4, .flags = RUNG_SYMBOL_HIDDEN});
  const Layout layout(module, {.expandBits = false});
  const std::string text = emitCpp(layout, 42, {.debugInfo = true});
  EXPECT_NE(text.find(R"(
struct __attribute__((packed)) rung_memory {
bool X0_0 : 1;
bool X0_1 : 1;
long long : 6;
char $gap_0[63];
bool LAMP : 1;
long long : 7;
char $gap_1[63];
union {
struct __attribute__((packed)) {
int LOW : 8;
long long : 1;
bool BIT9 : 1;
};
struct __attribute__((packed)) {
short WORD;
};
};
bool _ESP_2 : 1;
long long : 1;
bool _ESP : 1;
bool _ESP_3 : 1;
long long : 4;
int _2x : 8;
short D4_i16;
char new_[2];
double REAL;
)"),
            std::string::npos)
      << text;
  for (const char* compiler : {"g++", "clang++-19"}) {
    CppBuildOptions options;
    options.compiler = compiler;
    const Result<std::string> built = buildCppSharedObject(text, options);
    EXPECT_TRUE(built.ok()) << built.error();
  }
  EXPECT_EQ(emitCpp(layout, 42, {}).find("rung_memory"), std::string::npos);
}

// Macros of the compilers, also those that are defined before the first line.
TEST(CppEmitter, NamesOfTheCompilerForDebuggers) {
  Module module = sampleModule();
  uint8_t bit = 0;
  for (const char* name : {"__FILE__", "__LINE__", "__x86_64__", "_GNU_SOURCE", "_LP64", "linux", "unix"})
    module.symbols.push_back({.name = name, .comment = "", .space = SpaceId{2}, .byte = 0, .bit = bit++});
  const Layout layout(module, {.expandBits = false});
  const std::string text = emitCpp(layout, 42, {.debugInfo = true});
  EXPECT_NE(text.find("bool __FILE___ : 1;\nbool __LINE___ : 1;\n"), std::string::npos) << text;
  for (const char* compiler : {"g++", "clang++-19"}) {
    CppBuildOptions options;
    options.compiler = compiler;
    const Result<std::string> built = buildCppSharedObject(text, options);
    EXPECT_TRUE(built.ok()) << built.error();
  }
}

TEST(CppEmitter, AMissingCompilerIsAnErrorOfTheEnvironment) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  CppBuildOptions options;
  options.compiler = "no-such-compiler";
  const Result<std::string> built = buildCppSharedObject(emitCpp(layout, 0, {}), options);
  ASSERT_FALSE(built.ok());
  EXPECT_NE(built.error().find("no-such-compiler"), std::string::npos);
}

TEST(CppString, EscapesWhatALiteralCannotHold) {
  EXPECT_EQ(cppString("a\"b\\c\n\x01?"), R"("a\"b\\c\012\001\?")");
  EXPECT_EQ(cppString("\xC3\xA9"
                      "1"),
            R"("\303\2511")");
}

} // namespace
} // namespace rung::codegen
