// Traces: names, forms, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include "compiler/compile.h"
#include "compiler/engines.h"
#include "tests/support/words.h"
#include "tools/scenario/trace.h"

namespace rung::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kProgram = R"(dialect nct
module MAIN

symbol START   5100.00
symbol PUMP    5101.00
symbol COUNT   5102
symbol UNUSED  5103

rung
|--[START]--(PUMP)

rung
|--[5100.03]--{MOV COUNT #-5}
)";

class ScenarioTrace : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("rung_trace_test" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    SourceManager sources;
    Diagnostics diagnostics;
    const std::vector<FileId> files = {sources.addBuffer("lamp.lad", kProgram)};
    std::optional<compiler::Compiled> compiled = compiler::compile(sources, files, {}, diagnostics);
    ASSERT_TRUE(compiled);
    compiled_ = std::move(*compiled);
    engine_ = compiler::makeEngine(compiler::EngineKind::Interp, compiled_, {}).value();
    session_.addEngine(*engine_);
    ASSERT_TRUE(session_.start().empty());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Result<std::unique_ptr<Trace>> open(const std::string& name, const std::vector<std::string>& names) {
    return Trace::open(path(name), names, session_.instance(), session_.nc());
  }
  void execute(const std::string& line) {
    const Scenario parsed = parse("typed", "program x\n" + line);
    EXPECT_FALSE(session_.execute(parsed.statements.back()));
  }
  // The trace of a scenario that starts the pump in its second scan.
  std::string traceOf(const std::string& name, const std::vector<std::string>& names) {
    Result<std::unique_ptr<Trace>> trace = open(name, names);
    EXPECT_TRUE(trace.ok()) << trace.error();
    session_.addObserver(*trace.value());
    execute("scan");
    execute("set START 1");
    execute("set 5100.03 1");
    execute("scan 2");
    EXPECT_EQ(trace.value()->finish(), "");
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }

  std::filesystem::path folder_;
  compiler::Compiled compiled_;
  std::unique_ptr<runtime::Engine> engine_;
  Session session_{"."};
};

TEST_F(ScenarioTrace, CsvHasARowForEveryScan) {
  EXPECT_EQ(traceOf("t.csv", {"START", "PUMP", "COUNT", "5102.31"}), "time_s,scan,START,PUMP,COUNT,5102.31\n"
                                                                     "0.000000,0,0,0,0,0\n"
                                                                     "0.010000,1,0,0,0,0\n"
                                                                     "0.020000,2,1,1,-5,1\n"
                                                                     "0.030000,3,1,1,-5,1\n");
}

TEST_F(ScenarioTrace, VcdHasChangesOnly) {
  EXPECT_EQ(traceOf("t.vcd", {"PUMP", "COUNT"}),
            "$version rungc $end\n$timescale 1 us $end\n$scope module lamp $end\n$scope module M $end\n"
            "$var wire 1 ! PUMP $end\n$var wire 32 \" COUNT $end\n$upscope $end\n$upscope $end\n"
            "$enddefinitions $end\n#0\n$dumpvars\n0!\nb0 \"\n$end\n#20000\n1!\n"
            "b11111111111111111111111111111011 \"\n#30000\n");
}

TEST_F(ScenarioTrace, TimesContinueAfterARestore) {
  Result<std::unique_ptr<Trace>> trace = open("t.csv", {"PUMP"});
  ASSERT_TRUE(trace.ok());
  session_.addObserver(*trace.value());
  for (const char* line : {"scan", "snapshot OFF", "set START 1", "scan 2", "restore OFF", "scan"}) execute(line);
  EXPECT_EQ(trace.value()->finish(), "");
  std::ostringstream text;
  text << std::ifstream(path("t.csv")).rdbuf();
  EXPECT_EQ(text.str(), "time_s,scan,PUMP\n"
                        "0.000000,0,0\n"
                        "0.010000,1,0\n"
                        "0.020000,2,1\n"
                        "0.030000,3,1\n"
                        "0.040000,4,0\n");
}

TEST_F(ScenarioTrace, NamesByDefaultAreWhatRungsUse) {
  EXPECT_THAT(defaultTraceNames(engine_->program(), compiled_.uses.get()),
              ElementsAre("FL_ER", "START", "5100.03", "PUMP", "COUNT"));
  EXPECT_THAT(defaultTraceNames(engine_->program(), nullptr), testing::Contains("UNUSED"));
}

TEST_F(ScenarioTrace, RefusesWhatItCannotTrace) {
  EXPECT_EQ(
      test::lacking(Trace::nameProblem({"COUNT", "PUMPE"}, session_.instance(), session_.nc()), {"'PUMPE'", "PUMP?"}),
      "");
  EXPECT_EQ(Trace::nameProblem({"COUNT", "5100.03"}, session_.instance(), session_.nc()), "");
  EXPECT_THAT(traceFileProblem("t.xls"), HasSubstr("must end in .vcd or .csv"));
  EXPECT_EQ(traceFileProblem("t.vcd"), "");
  EXPECT_THAT(open("missing/t.vcd", {"PUMP"}).error(), HasSubstr("cannot write"));
}

} // namespace
} // namespace rung::scenario
