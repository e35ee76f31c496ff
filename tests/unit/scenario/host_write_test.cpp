// What a host writes by name to a program of each dialect reaches the program, or is refused with the name to write.
#include <gtest/gtest.h>

#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/nc/names/write.h"

namespace rung {
namespace {

constexpr const char* kNct = R"(dialect nct
module MAIN
symbol B_CLAMP INP000.17
symbol VALVE   OUT000.03
symbol LAMP    5101.00
rung
|--[B_CLAMP]--+--(VALVE)
              +--(LAMP)
)";

constexpr const char* kGsk = R"(FUNC END1
LD   X0.0
OUT  Y0.0
FUNC END2
)";

constexpr const char* kTechnol = R"(DATA
PIN:    DFM BUTTON,,,,,,,
POUT:   DFM VALVE,,,,,,,
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LDR  BUTTON
        WR   VALVE
MODULE_MAIN_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
)";

class HostWrite : public testing::Test {
protected:
  void start(const std::string& dialect, const char* text) {
    compiler::CompileRequest request;
    request.dialect = dialect;
    const FileId file = sources_.addBuffer("program", text);
    Diagnostics diagnostics;
    compiled_ = compiler::compile(sources_, std::span(&file, 1), request, diagnostics);
    ASSERT_TRUE(compiled_) << renderText(diagnostics, sources_);
    engine_ = compiler::makeEngine(compiler::EngineKind::Interp, *compiled_, {}).value();
    instance_ = std::make_unique<runtime::Instance>(*engine_);
  }
  runtime::Ref at(std::string_view name) const { return nc::resolve(instance_->program(), name).value(); }
  uint64_t read(std::string_view name) const { return instance_->read(at(name)); }
  std::string write(std::string_view name, uint64_t value) { return nc::write(*instance_, at(name), value); }

  SourceManager sources_;
  std::optional<compiler::Compiled> compiled_;
  std::unique_ptr<runtime::Engine> engine_;
  std::unique_ptr<runtime::Instance> instance_;
};

TEST_F(HostWrite, NctInputsAreWrittenInTheTimeSliceMemory) {
  start("nct", kNct);
  const std::string lost =
      "a value written to B_CLAMP is lost: !B_CLAMP is copied over it before the program reads it; "
      "write !B_CLAMP";
  EXPECT_EQ(write("B_CLAMP", 1), lost);
  ASSERT_EQ(write("!B_CLAMP", 1), "");
  instance_->scan();
  EXPECT_EQ(read("VALVE"), 1u);
  EXPECT_NE(write("VALVE", 0), "") << "the machine's copy is !VALVE";
  EXPECT_EQ(write("LAMP", 0), "") << "user memory has one copy";
}

TEST_F(HostWrite, GskInputsAreWrittenWhereTheyAreRead) {
  start("gsk", kGsk);
  ASSERT_EQ(write("X0.0", 1), "");
  instance_->scan();
  EXPECT_EQ(read("Y0.0"), 1u);
  EXPECT_EQ(write("R900", 5), "");
  EXPECT_EQ(write("R1000", 5), "");
}

TEST_F(HostWrite, TechnolInputsAreWrittenWhereTheyAreRead) {
  start("technol", kTechnol);
  ASSERT_EQ(write("BUTTON", 1), "");
  instance_->scan();
  EXPECT_EQ(read("VALVE"), 1u);
  EXPECT_FALSE(nc::resolve(instance_->program(), "NOTHING"));
}

} // namespace
} // namespace rung
