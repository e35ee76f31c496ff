// The structs of the ABI lie on every target where that target's C compiler puts them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <unistd.h>

#include <fmt/format.h>

#include "codegen/llvm/llvm_emitter.h"
#include "ir/image/abi_fields.h"
#include "ir/support/put.h"
#include "tests/unit/llvm/sample_module.h"

namespace rung::codegen {
namespace {

using namespace ir;
namespace fs = std::filesystem;
using testing::HasSubstr;

size_t pointerBytes(std::string_view target) { return target.starts_with("armv7") ? 4 : 8; }

// Assertions on all structs that hang below `info`.
void assertStruct(const StructInfo& info, size_t pointer, std::set<std::string_view>& done, std::string& out) {
  if (!done.insert(info.name).second) return;
  const TargetStruct there = targetStruct(info, pointer);
  put(out, "_Static_assert(sizeof({}) == {}, \"\");\n", info.name, there.size);
  for (size_t i = 0; i < info.fields.size(); ++i) {
    put(out, "_Static_assert(offsetof({}, {}) == {}, \"\");\n", info.name, info.fields[i].name, there.offsets[i]);
    if (info.fields[i].element != nullptr) assertStruct(*info.fields[i].element, pointer, done, out);
  }
}

// Code reaches these by field; the back end stops when they lie elsewhere (abi_types.cpp).
constexpr const char* kContext = R"(
_Static_assert(offsetof(rung_ctx, host) == 8 && offsetof(rung_ctx, prof) == 8 + 2 * {0}, "");
_Static_assert(offsetof(rung_ctx, fault) == 8 + 4 * {0} && offsetof(rung_ctx, sp) == 24 + 4 * {0}, "");
_Static_assert(offsetof(rung_ctx, extra_weight) == 28 + 4 * {0} && offsetof(rung_ctx, stack) == 32 + 4 * {0}, "");
_Static_assert(sizeof(rung_ctx) == 544 + 4 * {0}, "");
_Static_assert(offsetof(rung_host_api, message) == 8 && offsetof(rung_host_api, service_result) == 8 + 3 * {0}, "");
_Static_assert(offsetof(rung_fault, task) == 12, "");
_Static_assert(offsetof(rung_message, value) == 16 && sizeof(rung_message) == 32, "");
_Static_assert(offsetof(rung_prof, started) == 24 && sizeof(rung_prof) == 32, "");
)";

TEST(TargetStruct, AsInCOnEveryTarget) {
  const fs::path file = fs::path(testing::TempDir()) / fmt::format("rung-target-struct-{}.c", getpid());
  for (const std::string_view target : llvmTargets()) {
    std::string text = "#include <stddef.h>\n#include \"rung/program.h\"\n";
    std::set<std::string_view> done;
    assertStruct(programInfo(), pointerBytes(target), done, text);
    text += fmt::format(fmt::runtime(kContext), pointerBytes(target));
    EXPECT_GT(done.size(), 8u);
    std::ofstream(file) << text;
    const std::string command = fmt::format(
        "clang-19 --target={} -std=c11 -ffreestanding -fsyntax-only -Irtlib/abi '{}'", target, file.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << target;
  }
  fs::remove(file);
}

TEST(TargetStruct, AsInThisCompiler) {
  const TargetStruct here = targetStruct(programInfo(), sizeof(void*));
  EXPECT_EQ(here.size, sizeof(rung_program));
  for (size_t i = 0; i < here.offsets.size(); ++i) EXPECT_EQ(here.offsets[i], programInfo().fields[i].offset);
}

// The size that a program states is that of its own machine: a runtime there reads no field that is not there.
TEST(TargetStruct, AProgramStatesItsSizeOnItsTarget) {
  const Module module = sampleModule();
  const Layout layout(module, {});
  for (const std::string_view target : llvmTargets()) {
    const Result<std::string> ir = emitLlvmIr(layout, 42, {.level = LlvmLevel::Fast, .target = std::string(target)});
    ASSERT_TRUE(ir.ok()) << ir.error();
    const size_t size = pointerBytes(target) == 4 ? 256 : 368;
    EXPECT_THAT(ir.value(), HasSubstr(fmt::format("@rung_program_table = constant %rung_program {{ i32 {},", size)))
        << target;
  }
}

} // namespace
} // namespace rung::codegen
