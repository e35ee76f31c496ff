// The session: it goes on after a statement that failed, calls its observers, and can be interrupted.
#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "compiler/engines.h"
#include "tools/scenario/session.h"

namespace rung::scenario {
namespace {

constexpr const char* kLamp = R"(dialect nct
module MAIN

rung
|--[5100.00]--[/5100.01]--(5101.00)
)";

class ScenarioSession : public testing::Test {
protected:
  void SetUp() override {
    SourceManager sources;
    Diagnostics diagnostics;
    const std::vector<FileId> files = {sources.addBuffer("lamp.lad", kLamp)};
    std::optional<compiler::Compiled> compiled = compiler::compile(sources, files, {}, diagnostics);
    ASSERT_TRUE(compiled);
    compiled_ = std::move(*compiled);
    for (compiler::EngineKind kind : {compiler::EngineKind::Interp, compiler::EngineKind::Jit}) {
      engines_.push_back(compiler::makeEngine(kind, compiled_, {}).value());
      session_.addEngine(*engines_.back());
    }
    ASSERT_TRUE(session_.start().empty());
  }
  std::string execute(const std::string& line) {
    const Scenario parsed = parse("typed", "program x\n" + line);
    EXPECT_TRUE(parsed.problems.empty());
    const std::optional<Problem> problem = session_.execute(parsed.statements.back());
    return problem ? problem->message : "";
  }

  compiler::Compiled compiled_;
  std::vector<std::unique_ptr<runtime::Engine>> engines_;
  Session session_{"."};
};

struct ScanCounter final : Observer {
  void started(Session&) override { ++starts; }
  void scanned(const Session& session) override {
    ++calls;
    lastTime = session.nowUs();
    lastLine = session.statement()->line;
  }
  int starts = 0;
  uint32_t lastLine = 0;
  uint64_t calls = 0;
  int64_t lastTime = 0;
};

TEST_F(ScenarioSession, GoesOnAfterAStatementThatFailed) {
  EXPECT_EQ(execute("scan 2"), "");
  EXPECT_NE(execute("expect 5101.00 1").find("5101.00 is 0, expected 1"), std::string::npos);
  EXPECT_NE(execute("set NOTHING 1"), "");
  EXPECT_EQ(execute("set 5100.00 1"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("expect 5101.00 1"), "");
  EXPECT_EQ(session_.scans(), 3u);
}

TEST_F(ScenarioSession, RefusesWhatBelongsToTheStart) {
  for (const char* line : {"program y", "dialect nct", "config a b", "connect A B", "period 5ms", "expect_error x"})
    EXPECT_NE(execute(line).find("belongs to the start"), std::string::npos) << line;
}

TEST_F(ScenarioSession, ReplacesByWhatItIsGiven) {
  EXPECT_NE(execute("replace other.lad").find("no other program can be compiled here"), std::string::npos);
  EXPECT_NE(execute("expect_no_change").find("no program has been replaced"), std::string::npos);
  session_.setMakeProgram([this](const Statement& s) -> Result<NextProgram> {
    if (s.words[0] != "lamp.lad") return failure("no program has this name");
    return NextProgram{{engines_[0].get(), engines_[1].get()}, compiled_.uses.get()};
  });
  EXPECT_EQ(execute("scan 2"), "");
  EXPECT_NE(execute("replace other.lad").find("no program has this name"), std::string::npos);
  EXPECT_EQ(session_.instance().generation(), 0u);
  EXPECT_EQ(execute("replace lamp.lad"), "");
  EXPECT_EQ(session_.instance().generation(), 1u);
  EXPECT_EQ(execute("expect_no_change"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(session_.scans(), 3u);
}

TEST_F(ScenarioSession, ObserversSeeEveryScan) {
  ScanCounter counter;
  session_.addObserver(counter);
  execute("scan 4");
  execute("run 25ms");
  EXPECT_EQ(counter.calls, 7u);
  EXPECT_EQ(counter.lastTime, session_.nowUs());
  EXPECT_EQ(counter.lastLine, 2u);
  EXPECT_EQ(session_.statement(), nullptr);
  execute("cold_start");
  execute("warm_start");
  EXPECT_EQ(counter.starts, 3) << "when it is added, and after each restart";
}

TEST_F(ScenarioSession, AnInterruptEndsTheStatement) {
  session_.setInterrupt([&] { return session_.scans() >= 5; });
  EXPECT_EQ(execute("run 100s"), "");
  EXPECT_EQ(session_.scans(), 5u);
  EXPECT_EQ(execute("scan 1000"), "");
  EXPECT_EQ(session_.scans(), 6u) << "the first scan is done before the question";
}

} // namespace
} // namespace rung::scenario
