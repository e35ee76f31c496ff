// Recordings as files: of a scenario and of a host, whole and damaged, and programs that come from the recording
// itself.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/embedded_ir.h"
#include "ir/support/diag_render.h"
#include "ir/support/temporary_folder.h"
#include "rung/runtime.hpp"
#include "tests/unit/replay/recorded_host.h"
#include "tools/replay/console.h"
#include "tools/replay/growing_recording.h"
#include "tools/replay/past.h"
#include "tools/replay/record_run.h"
#include "tools/replay/scenario_file.h"
#include "tools/scenario/in_project.h"

namespace rung::replay {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

scenario::Scenario read(const std::string& file) {
  Result<scenario::Scenario> scenario = scenario::readScenario(file);
  EXPECT_TRUE(scenario.ok()) << file;
  scenario::takeProject(scenario.value());
  return std::move(scenario).value();
}

std::string recordInFiles(const std::string& file, const std::string& folder) {
  scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
  recordInto(folder, options);
  const scenario::RunResult result = scenario::run(read(file), options);
  EXPECT_TRUE(result.passed) << file;
  return folder;
}

// Each part's clock and outputs, to the end or to where it cannot be played.
std::vector<uint64_t> played(Past& past) {
  std::vector<uint64_t> all;
  EXPECT_EQ(past.goTo(past.firstPart()), "");
  while (past.next()) {
    uint64_t hash = static_cast<uint64_t>(past.instance().nowUs());
    const rung_program& program = past.instance().program();
    for (uint32_t space = 0; space < program.space_count; ++space)
      if ((program.spaces[space].flags & RUNG_SPACE_OUTPUT) != 0)
        for (uint32_t byte = 0; byte < program.spaces[space].byte_count; ++byte)
          hash = hash * 1099511628211u ^ past.instance().memory().readByte(space, byte);
    all.push_back(hash);
  }
  return all;
}

std::unique_ptr<Past> open(const Recording& recording) {
  Result<std::unique_ptr<Past>> past = Past::open(recording, {.engine = compiler::EngineKind::Interp});
  EXPECT_TRUE(past.ok()) << past.error();
  return std::move(past).value();
}

std::string differencesOf(const Past& past) {
  std::string text;
  for (const Difference& one : past.differences())
    text += fmt::format("part {}: kind {} at {} {}; ", one.part, static_cast<int>(one.what.kind), one.what.offset,
                        one.place);
  return text;
}

class Files : public testing::TestWithParam<const char*> {};

TEST_P(Files, HaveWhatWasRecordedInMemory) {
  const TemporaryFolder folder;
  ASSERT_TRUE(folder.ok());
  const Result<Recording> fromFiles = readRecording(recordInFiles(GetParam(), folder / "recording"));
  ASSERT_TRUE(fromFiles.ok()) << fromFiles.error();
  EXPECT_TRUE(fromFiles.value().problems.empty());
  const Result<RecordedScenario> inMemory =
      recordScenario(read(GetParam()), {.engines = {compiler::EngineKind::Interp}});
  ASSERT_TRUE(inMemory.ok());
  const auto a = open(fromFiles.value()), b = open(inMemory.value().recording);
  const std::vector<uint64_t> files = played(*a), memory = played(*b);
  EXPECT_GT(files.size(), 10u);
  EXPECT_EQ(files, memory);
  EXPECT_TRUE(a->differences().empty());
  // The marks of the program come with it.
  ASSERT_EQ(a->goTo(a->contents().parts), "");
  ASSERT_EQ(b->goTo(b->contents().parts), "");
  const Flow* one = a->flow();
  const Flow* other = b->flow();
  ASSERT_TRUE(one != nullptr && other != nullptr);
  EXPECT_EQ(a->flowEngine().elements().pinCount(), b->flowEngine().elements().pinCount());
  EXPECT_GT(a->flowEngine().elements().pinCount(), 10u);
  EXPECT_EQ(one->lastPowers(), other->lastPowers());
}

INSTANTIATE_TEST_SUITE_P(Machines, Files,
                         testing::Values("examples/fanuc-vmc/door.scn", "examples/gsk-mill/tool-change.scn",
                                         "examples/nct-turning-centre/turret.scn",
                                         "examples/technol-machining-centre/door.scn"));

// ---- damage ------------------------------------------------------------------------------------------------------

std::string contentsOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

class Damage : public testing::Test {
protected:
  Damage() {
    (void)recordInFiles("examples/gsk-mill/tool-change.scn", folder_ / "recording");
    for (const auto& entry : fs::directory_iterator(folder_ / "recording"))
      if (entry.path().extension() == ".rec") segment_ = entry.path();
    bytes_ = contentsOf(segment_);
    const Result<Recording> whole = readRecording(folder_ / "recording");
    parts_ = played(*open(whole.value()));
  }
  // What can be read of the folder now; nothing, with the sentence in `problem_`.
  std::optional<std::vector<uint64_t>> now() {
    const Result<Recording> recording = readRecording(folder_ / "recording");
    if (!recording.ok()) {
      problem_ = recording.error();
      return std::nullopt;
    }
    problems_ = recording.value().problems;
    Result<std::unique_ptr<Past>> past = Past::open(recording.value(), {.engine = compiler::EngineKind::Interp});
    if (!past.ok()) {
      problem_ = past.error();
      return std::nullopt;
    }
    std::vector<uint64_t> parts = played(*past.value());
    landmarks_ = past.value()->contents().landmarks;
    return parts;
  }

  const TemporaryFolder folder_;
  fs::path segment_;
  std::string bytes_, problem_;
  std::vector<uint64_t> parts_;
  std::vector<std::string> problems_;
  std::vector<Landmark> landmarks_;
};

TEST_F(Damage, WhatIsBeforeACutIsShown) {
  write(segment_, bytes_.substr(0, bytes_.size() * 2 / 3));
  const auto parts = now();
  ASSERT_TRUE(parts) << problem_;
  EXPECT_GT(parts->size(), 0u);
  EXPECT_LT(parts->size(), parts_.size());
  EXPECT_TRUE(std::equal(parts->begin(), parts->end(), parts_.begin()));
  EXPECT_TRUE(std::ranges::any_of(landmarks_, [](const Landmark& l) { return l.kind == Landmark::Kind::Damaged; }));
}

TEST_F(Damage, AnyBytesAreNamedOrPlayedAsFarAsTheyAreWhole) {
  std::mt19937 random(11);
  for (int i = 0; i < 60; ++i) {
    std::string bytes = bytes_;
    for (int flips = 1 + static_cast<int>(random() % 3); flips > 0; --flips)
      bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
    write(segment_, bytes);
    const auto parts = now();
    if (!parts) EXPECT_FALSE(problem_.empty());
    if (parts && parts->size() < parts_.size()) EXPECT_TRUE(!problems_.empty() || !landmarks_.empty());
  }
}

TEST_F(Damage, AForeignProgramIsNamed) {
  for (const auto& entry : fs::directory_iterator(folder_ / "recording"))
    if (entry.path().extension() == ".program") write(entry.path(), "something else");
  EXPECT_FALSE(now());
  EXPECT_THAT(problem_, HasSubstr("its IR has another version"));
}

TEST_F(Damage, AFolderWithoutARecordingIsNamed) {
  const Result<Recording> none = readRecording(folder_ / "nothing");
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error(), HasSubstr("nothing"));
}

// Events in any order, which no recorder writes.
TEST_F(Damage, ReorderedEventsDoNoHarm) {
  Result<RecordedScenario> recorded =
      recordScenario(read("examples/gsk-panel/panel.scn"), {.engines = {compiler::EngineKind::Interp}});
  ASSERT_TRUE(recorded.ok());
  Recording& recording = recorded.value().recording;
  const std::vector<uint8_t> whole = recording.segments[0].events;
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<uint8_t>& events = recording.segments[0].events;
    events = whole;
    const size_t from = random() % events.size(), to = random() % events.size();
    const size_t count = std::min({size_t{1} + random() % 40, events.size() - from, events.size() - to});
    std::swap_ranges(events.begin() + static_cast<ptrdiff_t>(from),
                     events.begin() + static_cast<ptrdiff_t>(from + (from + count <= to ? count : 1)),
                     events.begin() + static_cast<ptrdiff_t>(to));
    Result<std::unique_ptr<Past>> past = Past::open(recording, {.engine = compiler::EngineKind::Interp});
    if (!past.ok()) continue;
    (void)played(*past.value());
    (void)past.value()->goTo(past.value()->contents().parts);
    (void)past.value()->flow();
  }
}

// ---- in memory ---------------------------------------------------------------------------------------------------

TEST(InMemory, TheOldestPartsGoAndTheOthersKeepTheirNumbers) {
  const scenario::Scenario scenario = scenario::parse(
      "examples/gsk-panel/x.scn", "program panel.lad\nset X_ESP 1\nscan 9000\nset X_ESP 0\nscan 1000\nexpect *ESP 0\n");
  std::unique_ptr<SessionRecorder> recorder;
  std::shared_ptr<const compiler::Compiled> program;
  Recording recording;
  scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
  options.marks = true;
  options.started = [&](scenario::Session& session, const compiler::Compiled& compiled) {
    recorder = std::make_unique<SessionRecorder>(session, 100);
    session.addObserver(*recorder);
    program = std::shared_ptr<const compiler::Compiled>(std::shared_ptr<void>(), &compiled);
    return std::string();
  };
  options.ended = [&](scenario::Session&) {
    recording = recorder->take();
    recording.programs = {program};
    const auto past = open(recording);
    EXPECT_EQ(past->contents().parts, 10'000u);
    EXPECT_GT(past->firstPart(), 8000u);
    EXPECT_LT(past->firstPart(), 10'000u);
    Console console(*past, [](const std::string&) {});
    const std::string words[] = {"*ESP @ 9500"};
    EXPECT_THAT(console.why(words, false).value(), HasSubstr("= 0, since scan 9001, 72.008 s"));
    EXPECT_NE(past->goTo(100), "");
  };
  EXPECT_TRUE(scenario::run(scenario, options).passed);
}

// ---- as scenarios ------------------------------------------------------------------------------------------------

TEST(ScenarioFile, DoesTheSame) {
  Result<RecordedScenario> recorded =
      recordScenario(read("examples/gsk-panel/panel.scn"), {.engines = {compiler::EngineKind::Interp}});
  ASSERT_TRUE(recorded.ok());
  const auto past = open(recorded.value().recording);
  const TemporaryFolder folder;
  const Result<ScenarioText> text = scenarioOf(*past, folder / "panel.scn", past->firstPart(), 150);
  ASSERT_TRUE(text.ok()) << text.error();
  EXPECT_THAT(text.value().text, HasSubstr("expect "));
  EXPECT_THAT(text.value().text, HasSubstr("set "));
  const scenario::Scenario scenario = scenario::parse(folder / "panel.scn", text.value().text);
  const scenario::RunResult result = scenario::run(scenario, {.engines = {compiler::EngineKind::Interp}});
  EXPECT_TRUE(result.passed) << text.value().text << [&] {
    std::string problems = result.environment;
    for (const scenario::Problem& problem : result.problems) problems += scenario::textOf(problem) + "\n";
    return problems;
  }();
  EXPECT_EQ(result.scans, 150u);
}

// ---- a host ------------------------------------------------------------------------------------------------------

TEST(HostRecording, IsPlayedWithItsControlFromAnyPlace) {
  const TemporaryFolder folder;
  RecordedHost host(folder / "recording");
  const Result<Recording> recording = readRecording(folder / "recording", {host.program.compiled});
  ASSERT_TRUE(recording.ok()) << recording.error();
  ASSERT_EQ(recording.value().mode, runtime::RecordingMode::Control);
  Result<std::unique_ptr<Past>> opened =
      Past::open(recording.value(), {.engine = compiler::EngineKind::Interp, .keptEvery = 16});
  ASSERT_TRUE(opened.ok()) << opened.error();
  Past& past = *opened.value();
  ASSERT_EQ(past.contents().parts, host.lamps.size());
  (void)played(past);
  ASSERT_EQ(differencesOf(past), "") << "before any seeking";
  std::string text;
  Console console(past, [&](const std::string& line) { text += line + "\n"; });
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const uint64_t part = 1 + random() % past.contents().parts;
    ASSERT_EQ(past.goTo(part), "");
    for (int step = 0; step < 2; ++step) {
      const auto lamp = console.shown("LAMP"), late = console.shown("LATE");
      ASSERT_TRUE(lamp.ok() && late.ok());
      EXPECT_EQ(lamp.value(), fmt::format("LAMP = {}", host.lamps[past.part() - 1])) << "part " << past.part();
      EXPECT_EQ(late.value(), fmt::format("LATE = {}", host.lates[past.part() - 1])) << "part " << past.part();
      if (part > 1) EXPECT_NE(past.flow(), nullptr);
      if (past.part() > 1) ASSERT_EQ(past.goTo(past.part() - 1), "");
    }
  }
  ASSERT_EQ(past.goTo(past.contents().parts), "");
  EXPECT_EQ(differencesOf(past), "");
  const std::string words[] = {"LATE @ 190"};
  const Result<std::string> why = console.why(words, false);
  ASSERT_TRUE(why.ok()) << why.error();
  EXPECT_THAT(why.value(), HasSubstr("GO (X0.0) = 1, since scan 101, 0.808 s\n    an input, written by the machine"));
  const std::string written[] = {"COUNT @ 1000"};
  EXPECT_EQ(console.why(written, false).value(),
            fmt::format("COUNT (D100) = 42 (0x2A), since scan {}, 5.608 s\n"
                        "    written by a person or another program, through the host",
                        RecordedHost::kWritten + 1));
}

// A program that was prepared before the recording began is not recorded, which the recording says; what runs before
// and after it is.
TEST(HostRecording, SaysThatAReplacementWasPreparedBefore) {
  const TemporaryFolder folder;
  std::string text = RecordedHost::kProgram;
  text.replace(text.find("PRM 40"), 6, "PRM 56");
  HostProgram first(RecordedHost::kProgram), second(text.c_str());
  const rung::Image image = rung::Image::adopt(first.engine->program(), first.engine->context());
  const rung::Image other = rung::Image::adopt(second.engine->program(), second.engine->context());
  rung::Instance instance(image);
  instance.powerOn(rung::Power::Cold);
  rung_replacement* early = nullptr;
  ASSERT_EQ(rung_replacement_new(instance.handle(), other.handle(), nullptr, 0, &early), RUNG_OK) << rung_error_text();
  const std::string path = folder / "recording";
  const rung_recording_options options{.size = sizeof options, .state_ms = 2000, .folder = path.c_str()};
  ASSERT_EQ(rung_instance_record(instance.handle(), &options), RUNG_OK) << rung_error_text();
  const auto problem = [&] {
    rung_recording_info info{.size = sizeof info};
    EXPECT_EQ(rung_instance_recording(instance.handle(), &info), RUNG_OK);
    return std::string(info.problem);
  };
  const auto scans = [&](int count) {
    for (int i = 0; i < count; ++i) EXPECT_EQ(instance.scan(), RUNG_OK);
  };
  scans(100);
  EXPECT_EQ(problem(), "");
  ASSERT_EQ(rung_instance_replace(instance.handle(), early), RUNG_OK) << rung_error_text();
  scans(50);
  EXPECT_THAT(problem(), HasSubstr("prepared before the recording began"));
  ASSERT_EQ(rung_instance_replace(instance.handle(), early), RUNG_OK) << rung_error_text(); // the former one is back
  scans(70);
  EXPECT_EQ(problem(), "");
  EXPECT_EQ(rung_instance_record(instance.handle(), nullptr), RUNG_OK);
  EXPECT_EQ(rung_replacement_free(early), RUNG_OK);
  const Result<Recording> recording = readRecording(path, {first.compiled});
  ASSERT_TRUE(recording.ok()) << recording.error();
  const auto past = open(recording.value());
  EXPECT_EQ(played(*past).size(), 170u);
  EXPECT_EQ(past->problem(), "");
  EXPECT_EQ(differencesOf(*past), "");
}

// A program that takes over and one that comes back: each has its own rungs.
TEST(HostRecording, IsExplainedAcrossChangesOfProgram) {
  const TemporaryFolder folder;
  std::string text = RecordedHost::kProgram;
  text.replace(text.find("; lamp"), 0, "; other\nLD GO\nOUT R9.0\n");
  text.replace(text.find("ANI R0.0"), 8, "ANI R0.1");
  HostProgram first(RecordedHost::kProgram), second(text.c_str());
  const rung::Image image = rung::Image::adopt(first.engine->program(), first.engine->context());
  const rung::Image other = rung::Image::adopt(second.engine->program(), second.engine->context());
  rung::Instance instance(image);
  const std::string path = folder / "recording";
  const rung_recording_options options{.size = sizeof options, .state_ms = 2000, .folder = path.c_str()};
  ASSERT_EQ(rung_instance_record(instance.handle(), &options), RUNG_OK) << rung_error_text();
  uint8_t go = 1;
  instance.bindInput("GO", go);
  instance.powerOn(rung::Power::Cold);
  const auto scans = [&](int count) {
    for (int i = 0; i < count; ++i) EXPECT_EQ(instance.scan(), RUNG_OK);
  };
  const auto replaceBy = [&](const rung::Image& by) {
    rung_replacement* replacement = nullptr;
    ASSERT_EQ(rung_replacement_new(instance.handle(), by.handle(), nullptr, 0, &replacement), RUNG_OK)
        << rung_error_text();
    ASSERT_EQ(rung_instance_replace(instance.handle(), replacement), RUNG_OK) << rung_error_text();
    EXPECT_EQ(rung_replacement_free(replacement), RUNG_OK);
  };
  scans(100);
  replaceBy(other);
  scans(20);
  go = 0;
  scans(20);
  replaceBy(image);
  scans(10);
  go = 1;
  scans(10);
  EXPECT_EQ(rung_instance_record(instance.handle(), nullptr), RUNG_OK);
  const Result<Recording> recording = readRecording(path, {first.compiled, second.compiled});
  ASSERT_TRUE(recording.ok()) << recording.error();
  const auto past = open(recording.value());
  Console console(*past, [](const std::string&) {});
  const auto why = [&](const char* words) {
    const std::string asked[] = {words};
    const Result<std::string> text = console.why(asked, false);
    return text.ok() ? text.value() : text.error();
  };
  EXPECT_THAT(why("LAMP @ 90"), AllOf(HasSubstr("LAMP (Y0.0) = 1"), HasSubstr("written by rung 1 ")));
  EXPECT_THAT(why("LAMP @ 110"), AllOf(HasSubstr("LAMP (Y0.0) = 1, since scan 101"), HasSubstr("written by rung 2 ")));
  EXPECT_THAT(why("LAMP @ 130"),
              AllOf(HasSubstr("LAMP (Y0.0) = 0, since scan 121"), HasSubstr("GO (X0.0) = 0, since scan 121")));
  EXPECT_THAT(why("LAMP @ 145"), AllOf(HasSubstr("LAMP (Y0.0) = 0, since scan 141"), HasSubstr("written by rung 1 ")));
  EXPECT_THAT(why("LAMP @ 160"),
              AllOf(HasSubstr("LAMP (Y0.0) = 1, since scan 151"), HasSubstr("GO (X0.0) = 1, since scan 151")));
  for (uint64_t part = past->firstPart() + 1; part <= past->contents().parts; ++part)
    for (const char* name : {"LAMP", "LATE", "COUNT"})
      EXPECT_THAT(why((std::string(name) + " @ " + std::to_string(part)).c_str()), testing::StartsWith(name));
  EXPECT_EQ(differencesOf(*past), "");
}

} // namespace
} // namespace rung::replay
