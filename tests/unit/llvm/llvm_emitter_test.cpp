// The LLVM back end's outputs: the text of a small program, objects for every target, and a shared object that runs.
#include "codegen/llvm/llvm_emitter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <elf.h>
#include <filesystem>
#include <llvm/Support/ErrorHandling.h>
#include <stdexcept>
#include <unistd.h>

#include "ir/core/builder.h"
#include "ir/core/ops.h"
#include "ir/support/check.h"
#include "rtlib/load/seal.h"
#include "rtlib/load/so_engine.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"
#include "tests/unit/llvm/sample_module.h"

namespace rung::codegen {
namespace {

using namespace ir;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A name for this process alone; the file goes away with it.
struct TemporaryFile {
  explicit TemporaryFile(const std::string& name)
      : path((std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + name)).string()) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string path;
};

// The definition of a function, without notes on attributes and debug information.
std::string functionText(const std::string& ir, const std::string& name) {
  const size_t begin = ir.find("define internal i32 @" + name + "(");
  if (begin == std::string::npos) return "no function " + name;
  return ir.substr(begin, ir.find("\n}\n", begin) + 3 - begin);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TEST(LlvmEmitter, FastTextIsTheRungsAsTheyStand) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const Result<std::string> ir =
      emitLlvmIr(layout, 42, {.level = LlvmLevel::Fast, .debugInfo = false, .target = "x86_64-linux-gnu"});
  ASSERT_TRUE(ir.ok()) << ir.error();
  const std::string place = "i64 " + std::to_string(layout.memory().byte(SpaceId{2}, 4));
  EXPECT_EQ(replaced(functionText(ir.value(), "COUNT.0"), place, "i64 COUNT_PLACE"),
            R"(define internal i32 @COUNT.0(ptr noalias %mem, ptr %ctx, i32 %chunk) #0 {
entry:
  %0 = getelementptr inbounds i8, ptr %mem, i64 COUNT_PLACE
  %1 = load i16, ptr %0, align 2
  %2 = add i16 %1, 1
  %3 = icmp eq i16 %2, 3
  %4 = zext i1 %3 to i8
  br i1 %3, label %fault, label %go, !prof !3

fault:                                            ; preds = %entry
  %5 = getelementptr inbounds %rung_ctx, ptr %ctx, i32 0, i32 5
  %6 = getelementptr inbounds %rung_fault, ptr %5, i32 0, i32 0
  store i32 0, ptr %6, align 4
  %7 = getelementptr inbounds %rung_fault, ptr %5, i32 0, i32 1
  store i32 2, ptr %7, align 4
  %8 = getelementptr inbounds %rung_fault, ptr %5, i32 0, i32 2
  store i32 11, ptr %8, align 4
  ret i32 -2

go:                                               ; preds = %entry
  %9 = getelementptr inbounds i8, ptr %mem, i64 COUNT_PLACE
  store i16 %2, ptr %9, align 2
  %10 = getelementptr inbounds %rung_ctx, ptr %ctx, i32 0, i32 6
  %11 = load i32, ptr %10, align 4
  %12 = sub i32 %11, 1
  store i32 %12, ptr %10, align 4
  %13 = zext i32 %12 to i64
  %14 = getelementptr inbounds %rung_ctx, ptr %ctx, i32 0, i32 8
  %15 = getelementptr inbounds i32, ptr %14, i64 %13
  %16 = load i32, ptr %15, align 4
  ret i32 %16
}
)");
}

TEST(LlvmEmitter, OnlyTheProgramIsExported) {
  const Module module = moduleForOp(OpCode::FDiv);
  const Layout layout(module, {});
  const Result<std::string> ir = emitLlvmIr(layout, 42, {.level = LlvmLevel::Fast});
  ASSERT_TRUE(ir.ok()) << ir.error();
  EXPECT_THAT(ir.value(), HasSubstr("\n@rung_program_table = constant %rung_program"));
  EXPECT_THAT(ir.value(), HasSubstr("define internal double @rung_sem_fdiv_f64("));
  EXPECT_THAT(ir.value(), HasSubstr("call double @rung_sem_fdiv_f64("));
  EXPECT_THAT(ir.value(), Not(HasSubstr("\ndefine i32")));
  EXPECT_THAT(ir.value(), Not(HasSubstr("\ndeclare double")));
}

TEST(LlvmEmitter, OptInlinesTheSemantics) {
  const Module module = moduleForOp(OpCode::FDiv);
  const Layout layout(module, {});
  for (const std::string_view target : llvmTargets()) {
    const Result<std::string> ir = emitLlvmIr(layout, 42, {.level = LlvmLevel::Opt, .target = std::string(target)});
    ASSERT_TRUE(ir.ok()) << ir.error();
    EXPECT_THAT(ir.value(), Not(HasSubstr("@rung_sem_"))) << target;
  }
}

TEST(LlvmEmitter, NegationsAreInFlags) {
  constexpr uint32_t kRungs = 8;
  Module module = sampleModule();
  module.routines.push_back({.name = "LOGIC", .rungs = std::vector<Rung>(kRungs)});
  module.spaces.push_back({.name = "L", .unitBytes = 1, .units = 4 * kRungs / 8});
  const SpaceId bits{static_cast<uint32_t>(module.spaces.size() - 1)};
  for (uint32_t i = 0; i < kRungs; ++i) {
    RungBuilder b(module, module.routines.back().rungs[i]);
    const auto bit = [&](uint32_t array) { return Place{bits, (array * kRungs + i) / 8, i % 8}; };
    const ValueId open = b.and_(b.load(Type::Bit, bit(0)), b.load(Type::Bit, bit(1)));
    const ValueId closed = b.not_(b.load(Type::Bit, bit(2)));
    b.store(bit(3), i % 2 == 0 ? b.and_(open, closed) : b.or_(open, closed));
  }
  const Layout layout(module, {});
  const LlvmOptions options{.level = LlvmLevel::Opt, .debugInfo = false, .target = "x86_64-linux-gnu"};
  const Result<std::string> code = emitAssembly(layout, 42, options);
  ASSERT_TRUE(code.ok()) << code.error();
  EXPECT_THAT(code.value(), AllOf(HasSubstr("setb"), HasSubstr("setae")));
}

TEST(LlvmEmitter, LinesOfTheSource) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const Result<std::string> with = emitLlvmIr(layout, 42, {.level = LlvmLevel::Fast});
  ASSERT_TRUE(with.ok()) << with.error();
  EXPECT_THAT(with.value(), HasSubstr("DIFile(filename: \"sample.lad\""));
  EXPECT_THAT(with.value(), HasSubstr("distinct !DISubprogram(name: \"MAIN.0\""));
  EXPECT_THAT(with.value(), HasSubstr("!DILocation(line: 11,"));
  const Result<std::string> without = emitLlvmIr(layout, 42, {.level = LlvmLevel::Fast, .debugInfo = false});
  ASSERT_TRUE(without.ok()) << without.error();
  EXPECT_THAT(without.value(), Not(HasSubstr("DILocation")));
}

TEST(LlvmEmitter, MemoryForDebuggers) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const Result<std::string> with = emitLlvmIr(layout, 42, {.level = LlvmLevel::Opt});
  ASSERT_TRUE(with.ok()) << with.error();
  EXPECT_THAT(with.value(), HasSubstr("DILocalVariable(name: \"mem\""));
  EXPECT_THAT(with.value(), HasSubstr("DILocalVariable(name: \"this\""));
  EXPECT_THAT(with.value(), HasSubstr("store volatile ptr %mem"));
  EXPECT_THAT(with.value(), HasSubstr("fence syncscope(\"singlethread\") seq_cst"));
  const Result<std::string> without = emitLlvmIr(layout, 42, {.level = LlvmLevel::Opt, .debugInfo = false});
  ASSERT_TRUE(without.ok()) << without.error();
  EXPECT_THAT(without.value(), Not(HasSubstr("fence")));
  EXPECT_THAT(without.value(), Not(HasSubstr("volatile")));
}

TEST(LlvmEmitter, TheSameInputGivesTheSameBytes) {
  const Module module = randomModule(3);
  const Layout layout(module, {});
  EXPECT_EQ(emitObject(layout, 42, {}).value(), emitObject(layout, 42, {}).value());
  EXPECT_EQ(emitAssembly(layout, 42, {}).value(), emitAssembly(layout, 42, {}).value());
}

TEST(LlvmEmitter, AnUnknownTargetIsAnError) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const Result<std::string> object = emitObject(layout, 42, {.target = "pdp11"});
  ASSERT_FALSE(object.ok());
  EXPECT_THAT(object.error(), HasSubstr("pdp11"));
  EXPECT_THAT(object.error(), HasSubstr("aarch64-linux-gnu"));
}

TEST(LlvmSharedObject, RunsCallsAndTraps) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const TemporaryFile file("rung_llvm_test.so");
  const Result<std::string> built = buildLlvmSharedObject(layout, 42, {});
  ASSERT_TRUE(built.ok()) << built.error();
  std::string error = runtime::replaceFile(file.path, runtime::sealed(built.value()));
  const auto engine = runtime::SoEngine::open(file.path, error);
  ASSERT_NE(engine, nullptr) << error;
  EXPECT_EQ(engine->program().code_hash, 42u);
  EXPECT_EQ(engine->program().layout_hash, layout.memory().hash());
  runtime::Instance instance(engine->program());
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D6")), 7u) << "an initial value";
  EXPECT_EQ(instance.write(*nc::resolve(instance.program(), "X0.0"), 1), std::nullopt);
  instance.scan();
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "LAMP")), 1u);
  instance.scan();
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D4:2")), 2u);
  instance.scan();
  EXPECT_TRUE(instance.faulted());
  EXPECT_EQ(instance.fault().line, 11u);
  EXPECT_THAT(instance.faultText(), HasSubstr("limit reached"));
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "D4:2")), 2u) << "the trap comes before the store";
  EXPECT_EQ(instance.read(*nc::resolve(instance.program(), "LAMP")), 0u) << "outputs go to their safe state";
}

TEST(LlvmSharedObject, AMissingTemporaryFolderIsAnErrorOfTheEnvironment) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before != nullptr ? before : "";
  setenv("TMPDIR", "/no-such-folder", 1);
  const Result<std::string> built = buildLlvmSharedObject(layout, 42, {});
  before != nullptr ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
  ASSERT_FALSE(built.ok());
  EXPECT_THAT(built.error(), HasSubstr("temporary folder"));
  EXPECT_TRUE(buildLlvmSharedObject(layout, 42, {}).ok());
}

struct Machine {
  std::string_view target;
  uint16_t elfMachine;
};
constexpr Machine kMachines[] = {{"x86_64-linux-gnu", EM_X86_64},
                                 {"aarch64-linux-gnu", EM_AARCH64},
                                 {"armv7-linux-gnueabihf", EM_ARM},
                                 {"riscv64-linux-gnu", EM_RISCV}};

TEST(LlvmSharedObject, ForEveryTarget) {
  const Module module = randomModule(5);
  const Layout layout(module, {});
  EXPECT_EQ(llvmTargets().size(), std::size(kMachines));
  for (const Machine& machine : kMachines)
    for (const LlvmLevel level : {LlvmLevel::Fast, LlvmLevel::Opt}) {
      const Result<std::string> built =
          buildLlvmSharedObject(layout, 42, {.level = level, .target = std::string(machine.target)});
      ASSERT_TRUE(built.ok()) << machine.target << ": " << built.error();
      const std::string& bytes = built.value();
      ASSERT_EQ(bytes.substr(0, SELFMAG), ELFMAG);
      uint16_t kind = 0;
      std::memcpy(&kind, bytes.data() + offsetof(Elf64_Ehdr, e_machine),
                  sizeof kind); // at the same place in 32-bit files
      EXPECT_EQ(kind, machine.elfMachine);
      const runtime::ElfObject object = runtime::readElf(bytes);
      EXPECT_EQ(object.problem, "");
      EXPECT_THAT(machine.target, testing::StartsWith(object.machine));
      EXPECT_THAT(object.exported, testing::ElementsAre(RUNG_PROGRAM_SYMBOL));
      const bool isArm = machine.elfMachine == EM_ARM;
      EXPECT_EQ(object.needed, isArm ? std::vector<std::string>{"libgcc_s.so.1"} : std::vector<std::string>{});
    }
}

// What ends a compiler does not end its host.
TEST(Llvm, FatalErrorsAreThrownInALibrary) {
  const Module module = randomModule(5);
  ASSERT_TRUE(buildLlvmSharedObject(Layout(module, {}), 42, {}).ok());
  const ThrowingChecks throwing;
  EXPECT_THROW(llvm::report_fatal_error("cannot select: something"), std::logic_error);
  EXPECT_TRUE(buildLlvmSharedObject(Layout(module, {}), 42, {}).ok()) << "and it goes on";
}

} // namespace
} // namespace rung::codegen
