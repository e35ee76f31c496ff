// A program that the page runs, and a recording: what they answer to orders, in the past and in the present.
#include "tools/web/session_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/replay/recorded_scenario.h"
#include "tests/unit/web/drawing.h"
#include "tools/replay/past.h"
#include "tools/replay/record_run.h"
#include "tools/replay/session_past.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/statements.h"
#include "tools/web/past_source.h"

namespace rung::web {
namespace {

using namespace std::chrono_literals;

constexpr const char* kToggle = "tests/web/toggle.lad";                 // X alternates; SAME is X, OTHER is not X
constexpr const char* kFaulty = "tests/scenarios/nct/int0-timeout.lad"; // 7000.01 stops it

// Runs a source until the end of the test.
class Running {
public:
  explicit Running(PacedSource& source)
      : source_(source), thread_([this] { source_.run([this] { return ends_.load(); }); }) {}
  ~Running() {
    ends_ = true;
    thread_.join();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  std::string order(Order::Kind kind, int64_t scans = 0, std::string name = {}, std::string value = {}) {
    const Result<std::string> done = source_.execute({kind, scans, std::move(name), std::move(value)});
    return done.ok() ? done.value() : "refused: " + done.error();
  }
  // Of the present state.
  Picture picture(const std::vector<std::string>& names = {}) {
    // The first one may have been made before the last order, the second one is newer than that.
    const auto first = source_.picture("test", names, 0, 1s);
    asked_ = first == nullptr ? 0 : first->revision;
    (void)source_.why("the thread has answered");
    const auto now = source_.picture("test", names, asked_, 300ms);
    return now == nullptr ? Picture{} : *now;
  }
  std::vector<Event> events(std::string_view kind) {
    std::vector<Event> found = source_.events(0);
    std::erase_if(found, [&](const Event& event) { return event.kind != kind; });
    return found;
  }

private:
  PacedSource& source_;
  std::atomic<bool> ends_ = false;
  uint64_t asked_ = 0;
  std::thread thread_;
};

compiler::Compiled compiled(const std::string& path) {
  scenario::CompileStep step = scenario::compileProgram({}, {path}, {.marks = true});
  EXPECT_TRUE(step.program.has_value()) << path;
  return std::move(*step.program);
}

// A program on the interpreter, paused at its beginning.
struct Live {
  explicit Live(const std::string& path)
      : program(compiled(path)), flow(program), session(""),
        shown{1, std::make_shared<const ShownProgram>(drawingOf(program))} {
    session.addEngine(flow.engine());
    observeForces(session, flow);
    EXPECT_TRUE(session.start().empty());
    past = std::make_unique<replay::SessionPast>(
        session, [this] { return Result<const compiler::Compiled*>(&program); }, nullptr);
    session.addObserver(*past);
    session.setUnattended();
    source = std::make_unique<SessionSource>(session, *past, shown, flow);
    page = std::make_unique<Running>(*source);
    page->order(Order::Kind::Pause);
    first = page->picture().scan;
  }

  compiler::Compiled program;
  replay::FlowEngine flow;
  scenario::Session session;
  Drawn shown;
  std::unique_ptr<replay::SessionPast> past;
  std::unique_ptr<SessionSource> source;
  std::unique_ptr<Running> page;
  uint64_t first = 0; // the scan at which it was paused
};

std::string whyOf(Source& source, const std::string& name) {
  const Result<Why> why = source.why(name);
  return why.ok() ? why.value().text : "refused: " + why.error();
}

TEST(Live, GoesBackAndOn) {
  Live live(kToggle);
  live.page->order(Order::Kind::Step, 100);
  const uint64_t last = live.first + 100;
  const Picture now = live.page->picture({"X"});
  EXPECT_EQ(now.scan, last);
  EXPECT_EQ(live.page->order(Order::Kind::Seek, static_cast<int64_t>(last - 51)), fmt::format("scan {}", last - 51));
  const Picture past = live.page->picture({"X"});
  EXPECT_EQ(past.state, RunState::Past);
  EXPECT_NE(past.values.at("X"), now.values.at("X"));
  EXPECT_EQ(live.page->order(Order::Kind::Set, 0, "X", "1").substr(0, 8), "refused:");
  live.page->order(Order::Kind::Step, 60); // only to the newest one
  EXPECT_EQ(live.page->picture().scan, last);
  EXPECT_EQ(live.page->picture({"X"}).values.at("X"), now.values.at("X"));
}

// What the time line offers can be shown, also after the oldest snapshots have been given up.
TEST(Live, TheTimeLineBeginsWhereItCan) {
  Live live(kToggle);
  EXPECT_EQ(live.page->picture().firstScan, std::min<uint64_t>(live.page->picture().lastScan, 1));
  for (int i = 0; i < 4; ++i) live.page->order(Order::Kind::Step, 10'000);
  const Picture now = live.page->picture({"X"});
  EXPECT_EQ(now.scan, live.first + 40'000);
  EXPECT_GT(now.firstScan, 5'000u);
  EXPECT_LT(now.firstScan, now.lastScan - 25'000);
  for (const uint64_t scan : {now.firstScan, now.firstScan + 1, now.firstScan + 777, now.lastScan - 1}) {
    EXPECT_EQ(live.page->order(Order::Kind::Seek, static_cast<int64_t>(scan)), fmt::format("scan {}", scan));
    const Picture there = live.page->picture({"X"});
    EXPECT_EQ(there.scan, scan);
    EXPECT_EQ(there.values.at("X") == now.values.at("X"), (now.scan - scan) % 2 == 0);
  }
  EXPECT_EQ(live.page->order(Order::Kind::Seek, 0), fmt::format("scan {}", now.firstScan));
}

TEST(Live, EveryFaultIsInTheHistory) {
  Live live(kFaulty);
  for (int i = 0; i < 2; ++i) {
    live.page->order(Order::Kind::Statement, 0, "cold_start");
    live.page->order(Order::Kind::Step, 2);
    EXPECT_EQ(live.page->picture().fault, "");
    live.page->order(Order::Kind::Set, 0, "7000.01", "1");
    live.page->order(Order::Kind::Step, 2);
    EXPECT_NE(live.page->picture().fault.find("PLC timeout"), std::string::npos);
  }
  EXPECT_EQ(live.page->events("fault").size(), 2u);
}

// A program that has stopped runs no scan, so that the page and the chain of a value count the same ones.
TEST(Live, ScansAreCountedAsInTheChainAlsoAfterFaults) {
  Live live(kFaulty);
  for (int i = 0; i < 2; ++i) { // the second time in the first scan after the restart
    live.page->order(Order::Kind::Set, 0, "7000.01", "1");
    live.page->order(Order::Kind::Step, 5);
    EXPECT_EQ(live.page->picture().scan, live.first + 1 + static_cast<uint64_t>(i));
    live.page->order(Order::Kind::Statement, 0, "cold_start");
  }
  EXPECT_EQ(live.page->events("fault").size(), 2u);
  live.page->order(Order::Kind::Step, 3);
  live.page->order(Order::Kind::Set, 0, "7300.00", "1");
  live.page->order(Order::Kind::Step, 1);
  const Picture now = live.page->picture();
  EXPECT_EQ(now.scan, live.first + 6);
  EXPECT_NE(whyOf(*live.source, "7300.00").find(fmt::format("since scan {},", now.scan)), std::string::npos)
      << whyOf(*live.source, "7300.00");
  EXPECT_EQ(live.page->order(Order::Kind::Seek, static_cast<int64_t>(live.first + 2)),
            fmt::format("scan {}", live.first + 2));
  EXPECT_NE(live.page->picture().fault, "");
  EXPECT_EQ(live.page->order(Order::Kind::Seek, static_cast<int64_t>(now.scan)), fmt::format("scan {}", now.scan));
}

TEST(Live, TheTriggerLogsWhereItsConditionBeginsToHold) {
  Live live(kToggle);
  const auto wrong = live.source->setTrigger("rises NOTHING_SUCH");
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().find("NOTHING_SUCH"), std::string::npos);
  EXPECT_FALSE(live.source->setTrigger("X and").ok());
  EXPECT_EQ(live.page->picture().trigger, "");
  ASSERT_TRUE(live.source->setTrigger("rises X").ok());
  EXPECT_EQ(live.page->picture().trigger, "rises X");
  live.page->order(Order::Kind::Step, 10);
  std::vector<Event> hits = live.page->events("trigger");
  EXPECT_EQ(hits.size(), 5u);
  live.page->order(Order::Kind::Seek, static_cast<int64_t>(hits.front().scan));
  EXPECT_EQ(live.page->picture({"X"}).values.at("X"), "1");
  live.page->order(Order::Kind::Step, 100); // through the past: it is known already
  EXPECT_EQ(live.page->events("trigger").size(), 5u);
  ASSERT_TRUE(live.source->setTrigger("").ok());
  live.page->order(Order::Kind::Step, 10);
  EXPECT_EQ(live.page->events("trigger").size(), 5u);
}

TEST(Live, ATraceUpToAnyScan) {
  Live live(kToggle);
  live.page->order(Order::Kind::Step, 300);
  const uint64_t last = live.first + 200;
  const Result<ScanTrace> trace = live.source->trace({"X", "NONE"}, 50, last);
  ASSERT_TRUE(trace.ok());
  EXPECT_EQ(trace.value().firstScan, last - 49);
  ASSERT_EQ(trace.value().values[0].size(), 50u);
  EXPECT_EQ(trace.value().values[1], std::vector<std::string>(50));
  for (size_t i = 1; i < 50; ++i) EXPECT_NE(trace.value().values[0][i], trace.value().values[0][i - 1]);
  EXPECT_EQ(live.page->picture().scan, live.first + 300);
}

TEST(Live, SharesOfTheRungs) {
  Live live(kToggle);
  live.page->order(Order::Kind::Step, 100);
  const Result<Shares> shares = live.source->shares(40);
  ASSERT_TRUE(shares.ok());
  EXPECT_EQ(shares.value().lastScan, live.first + 100);
  EXPECT_EQ(shares.value().firstScan, live.first + 61);
  ASSERT_EQ(shares.value().rungs.size(), 3u);
  for (const RungShare& one : shares.value().rungs) {
    EXPECT_EQ(one.runs, 40u);
    EXPECT_GE(one.operations, 40u * 2);
  }
  EXPECT_EQ(live.page->picture().state, RunState::Paused);
}

// Looking at other scans does not change what is known of this one, and scans have the numbers that the page shows.
TEST(Live, WhyAfterATrace) {
  Live live(kToggle);
  live.page->order(Order::Kind::Step, 100);
  const std::string before = whyOf(*live.source, "SAME");
  EXPECT_NE(before.find(fmt::format("since scan {},", live.first + 100)), std::string::npos) << before;
  ASSERT_TRUE(live.source->trace({"X"}, 50, 0).ok());
  EXPECT_EQ(whyOf(*live.source, "SAME"), before);
  live.page->order(Order::Kind::Seek, static_cast<int64_t>(live.first + 90));
  EXPECT_NE(whyOf(*live.source, "SAME").find(fmt::format("since scan {},", live.first + 90)), std::string::npos)
      << whyOf(*live.source, "SAME");
}

TEST(Live, OnlyShownMessagesCanBeAcknowledged) {
  Live live(kToggle);
  EXPECT_FALSE(live.source->acknowledge().ok());
}

TEST(Recorded, ForcesAndTriggers) {
  scenario::Scenario scenario;
  for (const char* line : {"scan 10", "force OTHER 1", "scan 10", "unforce", "scan 10"}) {
    auto statement = scenario::parseStatement(line);
    ASSERT_TRUE(statement.ok());
    scenario.statements.push_back(std::move(statement).value());
  }
  auto recorded = replay::recordScenario(scenario, {.engines = {compiler::EngineKind::Interp}, .programs = {kToggle}});
  ASSERT_TRUE(recorded.ok()) << recorded.error();
  auto past = replay::Past::open(recorded.value().recording, {.engine = compiler::EngineKind::Interp});
  ASSERT_TRUE(past.ok()) << past.error();
  ASSERT_EQ(past.value()->goTo(past.value()->firstPart()), "");
  const auto draw = [](const compiler::Compiled& program) {
    return Result<ShownProgram>(ShownProgram(drawingOf(program)));
  };
  PastSource source(*past.value(), std::make_shared<const ShownProgram>(drawingOf(past.value()->compiled())), draw);
  Running page(source);
  page.order(Order::Kind::Seek, 15);
  const Picture forced = page.picture();
  EXPECT_EQ(forced.scan, 15u);
  ASSERT_EQ(forced.forces.size(), 1u);
  EXPECT_EQ(forced.forces[0].name, "OTHER");
  EXPECT_EQ(forced.forces[0].value, "1");
  EXPECT_EQ(forced.forces[0].rows.size(), 1u);
  page.order(Order::Kind::Seek, 25);
  EXPECT_EQ(page.picture().forces.size(), 0u);
  ASSERT_TRUE(source.setTrigger("rises X").ok());
  EXPECT_EQ(page.events("trigger").size(), 15u);
  EXPECT_EQ(page.picture().scan, 25u);
  EXPECT_EQ(source.mayWrite(), "a recording cannot be changed");
}

// The page begins before it has listened to the whole recording.
TEST(Recorded, HasTheMessagesOfItsControl) {
  for (const char* path : {"examples/fanuc-vmc/alarms.scn", "examples/gsk-mill/alarms.scn"}) {
    SCOPED_TRACE(path);
    const replay::RecordedScenario recorded = replay::recordedScenario(path);
    auto past = replay::Past::open(recorded.recording, {.engine = compiler::EngineKind::Interp});
    ASSERT_TRUE(past.ok()) << past.error();
    const auto draw = [](const compiler::Compiled& program) {
      return Result<ShownProgram>(ShownProgram(drawingOf(program)));
    };
    PastSource source(*past.value(), std::make_shared<const ShownProgram>(drawingOf(past.value()->compiled())), draw);
    Running page(source);
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (page.events("gone").empty() && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const std::vector<Event> messages = page.events("message");
    ASSERT_FALSE(messages.empty());
    page.order(Order::Kind::Seek, static_cast<int64_t>(messages[0].scan));
    const std::vector<ShownMessage> shown = page.picture().messages;
    ASSERT_FALSE(shown.empty());
    EXPECT_NE(messages[0].text.find(shown[0].text), std::string::npos) << messages[0].text;
  }
}

} // namespace
} // namespace rung::web
