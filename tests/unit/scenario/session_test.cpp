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

constexpr const char* kOther = R"(dialect nct
module MAIN

rung
|--[5100.00]--(5101.00)
)";

class ScenarioSession : public testing::Test {
protected:
  void SetUp() override {
    compiled_ = compiled(kLamp);
    engines_ = enginesOf(compiled_);
    for (const auto& engine : engines_) session_.addEngine(*engine);
    ASSERT_TRUE(session_.start().empty());
  }
  static compiler::Compiled compiled(const char* text) {
    SourceManager sources;
    Diagnostics diagnostics;
    const std::vector<FileId> files = {sources.addBuffer("lamp.lad", text)};
    return compiler::compile(sources, files, {}, diagnostics).value();
  }
  static std::vector<std::unique_ptr<runtime::Engine>> enginesOf(const compiler::Compiled& program) {
    std::vector<std::unique_ptr<runtime::Engine>> engines;
    for (compiler::EngineKind kind : {compiler::EngineKind::Interp, compiler::EngineKind::Jit})
      engines.push_back(compiler::makeEngine(kind, program, {}).value());
    return engines;
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
    return NextProgram{{engines_[0].get(), engines_[1].get()}, {}};
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

TEST_F(ScenarioSession, GoesBackToASnapshot) {
  EXPECT_EQ(execute("set 5100.00 1"), "");
  EXPECT_EQ(execute("scan 2"), "");
  EXPECT_EQ(execute("snapshot ON"), "");
  const int64_t then = session_.nowUs();
  EXPECT_EQ(execute("set 5100.00 0"), "");
  EXPECT_EQ(execute("scan 3"), "");
  EXPECT_EQ(execute("expect 5101.00 0"), "");
  EXPECT_EQ(execute("snapshot OFF"), "");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(execute("restore ON"), "");
    EXPECT_EQ(execute("expect 5101.00 1"), "");
    EXPECT_EQ(session_.nowUs(), then);
  }
  EXPECT_EQ(session_.scans(), 5u) << "scans are counted on";
  EXPECT_EQ(execute("restore OFF"), "");
  EXPECT_EQ(execute("expect 5101.00 0"), "");
  EXPECT_EQ(execute("snapshot ON"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("restore ON"), "");
  EXPECT_EQ(execute("expect 5101.00 0"), "") << "a snapshot replaces one of the same name";
}

TEST_F(ScenarioSession, NamesTheSnapshotsThatThereAre) {
  EXPECT_EQ(execute("restore A"), "no snapshot 'A' has been taken (before the first scan)");
  EXPECT_EQ(execute("snapshot B"), "");
  EXPECT_EQ(execute("snapshot C"), "");
  EXPECT_EQ(execute("restore A"), "no snapshot 'A' has been taken; there are: B, C (before the first scan)");
}

TEST_F(ScenarioSession, ASnapshotBelongsToItsProgram) {
  const compiler::Compiled other = compiled(kOther);
  const auto others = enginesOf(other);
  session_.setMakeProgram([&](const Statement& s) -> Result<NextProgram> {
    const auto& engines = s.words[0] == "other.lad" ? others : engines_;
    return NextProgram{{engines[0].get(), engines[1].get()}, {}};
  });
  EXPECT_EQ(execute("set 5100.00 1"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("snapshot ON"), "");
  EXPECT_EQ(execute("replace other.lad"), "");
  EXPECT_EQ(execute("force 5100.01 0"), "");
  EXPECT_NE(execute("restore ON").find("the snapshot 'ON' was taken of another program than the one that runs now"),
            std::string::npos);
  EXPECT_EQ(session_.forces().size(), 1u) << "nothing has changed";
  EXPECT_EQ(execute("replace lamp.lad"), "");
  EXPECT_EQ(execute("set 5100.00 0"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("restore ON"), "");
  EXPECT_EQ(execute("expect 5101.00 1"), "");
  session_.setMakeProgram({}); // its engines end before the session
  EXPECT_EQ(execute("scan"), "");
}

TEST_F(ScenarioSession, ASnapshotHasItsForces) {
  EXPECT_EQ(execute("force 5100.00 1"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("snapshot FORCED"), "");
  EXPECT_EQ(execute("unforce"), "");
  EXPECT_EQ(execute("set 5100.00 0"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("snapshot FREE"), "");
  EXPECT_EQ(execute("expect 5101.00 0"), "");
  EXPECT_EQ(execute("restore FORCED"), "");
  EXPECT_EQ(session_.forces().size(), 1u);
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("expect 5101.00 1"), "");
  EXPECT_EQ(execute("restore FREE"), "");
  EXPECT_TRUE(session_.forces().empty());
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("expect 5101.00 0"), "");
}

TEST_F(ScenarioSession, AStoppedProgramGoesBackToItsForces) {
  EXPECT_EQ(execute("force 5100.00 1"), "");
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("snapshot FORCED"), "");
  session_.instance().haltOverrun();
  EXPECT_TRUE(session_.instance().faulted());
  EXPECT_EQ(execute("restore FORCED"), "");
  EXPECT_FALSE(session_.instance().faulted());
  EXPECT_EQ(session_.forces().size(), 1u);
  EXPECT_EQ(execute("scan"), "");
  EXPECT_EQ(execute("expect 5101.00 1"), "");
}

TEST_F(ScenarioSession, ObserversAreToldOfARestore) {
  struct Restores final : Observer {
    void scanned(const Session&) override {}
    void restored(const Session& session) override { times.push_back(session.nowUs()); }
    std::vector<int64_t> times;
  } restores;
  session_.addObserver(restores);
  EXPECT_EQ(execute("scan 3"), "");
  EXPECT_EQ(execute("snapshot A"), "");
  const int64_t then = session_.nowUs();
  EXPECT_EQ(execute("scan 3"), "");
  EXPECT_EQ(execute("restore A"), "");
  EXPECT_NE(execute("restore B"), "");
  EXPECT_EQ(restores.times, std::vector<int64_t>{then});
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
