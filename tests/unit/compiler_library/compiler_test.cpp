// librung-compiler: sources to diagnostics, and to images that librung-runtime runs.
#include "rung/compiler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "rung/runtime.hpp"

namespace {

using testing::HasSubstr;

constexpr std::string_view kLatch = "dialect gsk\n"
                                    "module LEVEL1\n"
                                    "rung \"latch\"\n"
                                    "|--[X10.0]--+--[/X10.1]--(Y0.0)\n"
                                    "|--[Y0.0]---+\n";

class Compilation {
public:
  explicit Compilation(std::string_view text, rung_compile_options options = {}) {
    options.size = sizeof options;
    const rung_source source{"latch.lad", text.data(), text.size()};
    status_ = rung_compile(&source, 1, &options, &compilation_);
  }
  ~Compilation() { rung_compilation_free(compilation_); }
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;

  int32_t status() const { return status_; }
  rung_compilation* handle() const { return compilation_; }
  rung::Image image() const {
    rung_image* image = nullptr;
    if (rung_compilation_image(compilation_, &image) != RUNG_OK) throw std::runtime_error(rung_compiler_error_text());
    return rung::Image(image);
  }

private:
  rung_compilation* compilation_ = nullptr;
  int32_t status_;
};

void expectLatch(const rung::Image& image) {
  rung::Instance plc(image);
  plc.powerOn();
  plc.write(plc.find("X10.0", rung::Access::Write), 1);
  plc.scan();
  plc.write(plc.find("X10.0", rung::Access::Write), 0);
  plc.scan();
  EXPECT_TRUE(plc.read<bool>(plc.find("Y0.0")));
  plc.write(plc.find("X10.1", rung::Access::Write), 1);
  plc.scan();
  EXPECT_FALSE(plc.read<bool>(plc.find("Y0.0")));
}

TEST(Compiler, EveryEngineRunsTheProgram) {
  for (const rung_engine engine : {RUNG_ENGINE_JIT, RUNG_ENGINE_FAST, RUNG_ENGINE_INTERP, RUNG_ENGINE_TIERED}) {
    SCOPED_TRACE(engine);
    const Compilation compilation(kLatch, {.engine = static_cast<uint32_t>(engine)});
    ASSERT_EQ(compilation.status(), RUNG_OK) << rung_compiler_error_text();
    expectLatch(compilation.image());
  }
}

TEST(Compiler, AnImageOutlivesItsCompilation) {
  auto compilation = std::make_unique<Compilation>(kLatch, rung_compile_options{.engine = RUNG_ENGINE_INTERP});
  const rung::Image image = compilation->image();
  const rung::Image another = compilation->image();
  compilation.reset();
  expectLatch(image);
  expectLatch(another);
}

TEST(Compiler, AProgramIsChangedFromItsSource) {
  const Compilation first(kLatch);
  const rung::Image image = first.image();
  rung::Instance plc(image);
  plc.powerOn();
  plc.write(plc.find("X10.0", rung::Access::Write), 1);
  plc.scan();
  std::string text(kLatch);
  text.replace(text.find("(Y0.0)"), 6, "(Y0.1)");
  const Compilation second(text);
  const rung::Image next = second.image();
  const rung::Replacement change(plc, next);
  ASSERT_EQ(plc.replace(change), RUNG_OK);
  plc.scan();
  EXPECT_TRUE(plc.read<bool>(plc.find("Y0.1")));
}

TEST(Compiler, ASharedObjectIsWritten) {
  const std::string path = testing::TempDir() + "rung_compiler_test.so";
  const Compilation compilation(kLatch);
  ASSERT_EQ(rung_compilation_write(compilation.handle(), path.c_str()), RUNG_OK) << rung_compiler_error_text();
  expectLatch(rung::Image(path));
  std::filesystem::remove(path);
  EXPECT_EQ(rung_compilation_write(compilation.handle(), "/nowhere/latch.so"), RUNG_FAILED);
  EXPECT_THAT(rung_compiler_error_text(), HasSubstr("/nowhere/latch.so"));
}

// Y0.0 is held although nothing switches it on, and then although its rung switches it off.
void expectForced(rung::Instance& plc) {
  const rung_cell lamp = plc.find("Y0.0");
  const rung_cell on = plc.find("X10.0", rung::Access::Write), off = plc.find("X10.1", rung::Access::Write);
  const std::array<rung_forced_cell, 1> cells{{{"Y0.0", "test", {.integer = 1}}}};
  {
    const rung::Forces lit(plc, cells);
    ASSERT_EQ(plc.force(lit), RUNG_OK) << rung_error_text();
    plc.scan();
    EXPECT_TRUE(plc.read<bool>(lamp));
    plc.write(off, 1);
    plc.scan();
    EXPECT_TRUE(plc.read<bool>(lamp));
  }
  plc.scan();
  EXPECT_FALSE(plc.read<bool>(lamp));
  plc.write(off, 0);
  plc.write(on, 1);
  plc.scan();
  EXPECT_TRUE(plc.read<bool>(lamp)) << "its own code again";
}

TEST(Compiler, ACellThatTheProgramWritesIsForced) {
  for (const rung_engine engine : {RUNG_ENGINE_JIT, RUNG_ENGINE_FAST, RUNG_ENGINE_INTERP, RUNG_ENGINE_TIERED}) {
    SCOPED_TRACE(engine);
    const Compilation compilation(kLatch, {.engine = static_cast<uint32_t>(engine)});
    const rung::Image image = compilation.image();
    rung::Instance plc(image);
    plc.powerOn();
    expectForced(plc);
  }
}

TEST(Compiler, AFileCarriesWhatForcingNeeds) {
  const std::string path = testing::TempDir() + "rung_forced_test.so";
  ASSERT_EQ(rung_compilation_write(Compilation(kLatch).handle(), path.c_str()), RUNG_OK) << rung_compiler_error_text();
  const rung::Image image(path);
  rung::Instance plc(image);
  plc.powerOn();
  const rung_forced_cell cell{"Y0.0", nullptr, {.integer = 1}};
  rung_forces* none = nullptr;
  EXPECT_EQ(rung_forces_new(plc.handle(), nullptr, &cell, 1, &none), RUNG_REFUSED);
  ASSERT_EQ(rung_compiler_serve(image.handle()), RUNG_OK) << rung_compiler_error_text();
  EXPECT_EQ(rung_compiler_serve(image.handle()), RUNG_WRONG_STATE);
  expectForced(plc);
  EXPECT_EQ(rung_compiler_serve(nullptr), RUNG_BAD_HANDLE);
  EXPECT_EQ(rung_compiler_serve(Compilation(kLatch).image().handle()), RUNG_REFUSED) << "served by its own";
  std::filesystem::remove(path);
}

TEST(Compiler, MistakesAreDiagnostics) {
  const Compilation compilation("dialect gsk\nmodule LEVEL1\nrung\n|--[NOBODY]--(Y0.0)\nrung\n|--[X0.0]--(NOTHING)\n");
  EXPECT_EQ(compilation.status(), RUNG_REFUSED);
  auto first = rung::sized<rung_diagnostic>(), second = first;
  ASSERT_EQ(rung_compilation_diagnostic(compilation.handle(), 0, &first), RUNG_OK);
  ASSERT_EQ(rung_compilation_diagnostic(compilation.handle(), 1, &second), RUNG_OK);
  EXPECT_EQ(rung_compilation_diagnostic(compilation.handle(), 2, &second), RUNG_EMPTY);
  EXPECT_EQ(first.severity, uint32_t{RUNG_SEVERITY_ERROR});
  EXPECT_STREQ(first.file, "latch.lad");
  EXPECT_EQ(first.line, 4u);
  EXPECT_EQ(first.column, 5u);
  EXPECT_STREQ(first.code, "bad-operand");
  EXPECT_THAT(first.message, HasSubstr("NOBODY"));
  EXPECT_EQ(second.line, 6u);
  EXPECT_THAT(rung_compilation_report(compilation.handle()), HasSubstr("latch.lad:4:5: error:"));
  rung_image* image = nullptr;
  EXPECT_EQ(rung_compilation_image(compilation.handle(), &image), RUNG_WRONG_STATE);
  EXPECT_EQ(rung_compilation_write(compilation.handle(), "x.so"), RUNG_WRONG_STATE);
}

TEST(Compiler, FunctionsGoOverByTheHandshakeOfTheDialect) {
  const Compilation compilation(kLatch, {.engine = RUNG_ENGINE_INTERP});
  const rung::Image image = compilation.image();
  rung::Instance plc(image);
  uint32_t line = 0;
  for (const int32_t status :
       {rung_instance_begin_function(plc.handle(), 0, RUNG_FUNCTION_M, 5, &line),
        rung_instance_function_done(plc.handle(), 0, 0), rung_instance_abort_functions(plc.handle(), 0)})
    EXPECT_EQ(status, RUNG_WRONG_STATE) << "off";
  plc.powerOn();
  ASSERT_EQ(rung_instance_begin_function(plc.handle(), 0, RUNG_FUNCTION_M, 5, &line), RUNG_OK);
  plc.scan();
  EXPECT_EQ(plc.read<int>(plc.find("F10")), 5);
  EXPECT_EQ(rung_instance_function_done(plc.handle(), 0, line), RUNG_LATER);
  EXPECT_EQ(rung_instance_function_done(plc.handle(), 0, 1u << 31), RUNG_OK) << "not in use";
  EXPECT_EQ(rung_instance_abort_functions(plc.handle(), 0), RUNG_OK);
  EXPECT_EQ(rung_instance_function_done(plc.handle(), 0, line), RUNG_OK);
  EXPECT_EQ(rung_instance_function_done(plc.handle(), 40, line), RUNG_NOT_FOUND);
}

TEST(Compiler, BadArguments) {
  rung_compilation* compilation = nullptr;
  rung_source source{"latch.lad", kLatch.data(), kLatch.size()};
  EXPECT_EQ(rung_compile(nullptr, 1, nullptr, &compilation), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_compile(&source, 0, nullptr, &compilation), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_compile(&source, 1, nullptr, nullptr), RUNG_BAD_ARGUMENT);
  rung_compile_options options{};
  EXPECT_EQ(rung_compile(&source, 1, &options, &compilation), RUNG_BAD_ARGUMENT) << "no size";
  options.size = sizeof options;
  options.engine = 7;
  EXPECT_EQ(rung_compile(&source, 1, &options, &compilation), RUNG_BAD_ARGUMENT);
  options.engine = 0;
  const rung_setting unknown{"slot_step", "3"};
  options.settings = &unknown;
  options.setting_count = 1;
  EXPECT_EQ(rung_compile(&source, 1, &options, &compilation), RUNG_BAD_ARGUMENT);
  EXPECT_THAT(rung_compiler_error_text(), HasSubstr("slot_steps"));
  source = {"/nowhere/latch.lad", nullptr, 0};
  EXPECT_EQ(rung_compile(&source, 1, nullptr, &compilation), RUNG_NOT_FOUND);
  source.name = nullptr;
  EXPECT_EQ(rung_compile(&source, 1, nullptr, &compilation), RUNG_BAD_ARGUMENT);

  std::array<uint64_t, 16> none{};
  auto* wrong = reinterpret_cast<rung_compilation*>(none.data());
  rung_image* image = nullptr;
  auto diagnostic = rung::sized<rung_diagnostic>();
  for (rung_compilation* handle : {wrong, static_cast<rung_compilation*>(nullptr)}) {
    EXPECT_EQ(rung_compilation_image(handle, &image), RUNG_BAD_HANDLE);
    EXPECT_EQ(rung_compilation_write(handle, "x.so"), RUNG_BAD_HANDLE);
    EXPECT_EQ(rung_compilation_diagnostic(handle, 0, &diagnostic), RUNG_BAD_HANDLE);
    EXPECT_EQ(rung_compilation_report(handle), nullptr);
  }
  EXPECT_EQ(rung_compilation_free(wrong), RUNG_BAD_HANDLE);
  EXPECT_EQ(rung_compilation_free(nullptr), RUNG_OK);
  const Compilation good(kLatch, {.engine = RUNG_ENGINE_INTERP});
  EXPECT_EQ(rung_compilation_image(good.handle(), nullptr), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_compilation_write(good.handle(), nullptr), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_compilation_diagnostic(good.handle(), 0, &diagnostic), RUNG_EMPTY);
  const Compilation bad("dialect gsk\nmodule LEVEL1\nrung\n|--[NOBODY]--(Y0.0)\n");
  diagnostic.size = 0;
  EXPECT_EQ(rung_compilation_diagnostic(bad.handle(), 0, &diagnostic), RUNG_BAD_ARGUMENT);
}

} // namespace
