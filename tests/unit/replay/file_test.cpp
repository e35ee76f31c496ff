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
#include "tools/replay/console.h"
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

// ---- as scenarios ------------------------------------------------------------------------------------------------

TEST(ScenarioFile, DoesTheSame) {
  Result<RecordedScenario> recorded =
      recordScenario(read("examples/gsk-panel/panel.scn"), {.engines = {compiler::EngineKind::Interp}});
  ASSERT_TRUE(recorded.ok());
  const auto past = open(recorded.value().recording);
  const TemporaryFolder folder;
  const Result<std::string> text = scenarioOf(*past, folder / "panel.scn", past->firstPart(), 150);
  ASSERT_TRUE(text.ok()) << text.error();
  EXPECT_THAT(text.value(), HasSubstr("expect "));
  EXPECT_THAT(text.value(), HasSubstr("set "));
  const scenario::Scenario scenario = scenario::parse(folder / "panel.scn", text.value());
  const scenario::RunResult result = scenario::run(scenario, {.engines = {compiler::EngineKind::Interp}});
  EXPECT_TRUE(result.passed) << text.value() << [&] {
    std::string problems = result.environment;
    for (const scenario::Problem& problem : result.problems) problems += scenario::textOf(problem) + "\n";
    return problems;
  }();
  EXPECT_EQ(result.scans, 150u);
}

// ---- a host ------------------------------------------------------------------------------------------------------

constexpr const char* kProgram = "dialect gsk\nsymbol GO X0.0\nsymbol LAMP Y0.0\nsymbol LATE Y0.1\nsymbol COUNT D100\n"
                                 "FUNC END1\n; lamp\nLD GO\nANI R0.0\nOUT LAMP\n"
                                 "; late\nLD LAMP\nFUNC TMRB\nPRM 1\nPRM 40\nOUT LATE\nFUNC END2\n";

struct Host {
  explicit Host(const std::string& folder) {
    Diagnostics diagnostics;
    const FileId files[] = {sources.addBuffer("t.pmc", kProgram)};
    compiler::CompileRequest request;
    request.marks = request.keepBuilt = true;
    auto result = compiler::compile(sources, files, request, diagnostics);
    EXPECT_TRUE(result) << renderText(diagnostics, sources);
    compiled = std::make_unique<compiler::Compiled>(std::move(*result));
    engine = std::move(compiler::makeEngine(compiler::EngineKind::Interp, *compiled, {})).value();
    const rung::Image image = rung::Image::adopt(engine->program(), engine->context());
    rung::Instance instance(image);
    const rung_recording_options options{.size = sizeof options, .state_ms = 2000, .folder = folder.c_str()};
    EXPECT_EQ(rung_instance_record(instance.handle(), &options), RUNG_OK) << rung_error_text();
    uint8_t go = 0;
    instance.bindInput("GO", go);
    instance.powerOn(rung::Power::Cold);
    for (int scan = 0; scan < kScans; ++scan) {
      go = scan / 100 % 2;
      EXPECT_EQ(instance.scan(), RUNG_OK);
      lamps.push_back(static_cast<uint8_t>(instance.read<int64_t>(instance.find("LAMP"))));
      lates.push_back(static_cast<uint8_t>(instance.read<int64_t>(instance.find("LATE"))));
    }
    EXPECT_EQ(rung_instance_record(instance.handle(), nullptr), RUNG_OK);
  }
  static constexpr int kScans = 1500;
  SourceManager sources;
  std::unique_ptr<compiler::Compiled> compiled;
  std::unique_ptr<runtime::Engine> engine;
  std::vector<uint8_t> lamps, lates;
};

TEST(HostRecording, IsPlayedWithItsControlFromAnyPlace) {
  const TemporaryFolder folder;
  Host host(folder / "recording");
  std::vector<std::unique_ptr<compiler::Compiled>> known;
  known.push_back(std::move(host.compiled));
  const Result<Recording> recording = readRecording(folder / "recording", std::move(known));
  ASSERT_TRUE(recording.ok()) << recording.error();
  ASSERT_EQ(recording.value().mode, runtime::RecordingMode::Control);
  Result<std::unique_ptr<Past>> opened =
      Past::open(recording.value(), {.engine = compiler::EngineKind::Interp, .keptEvery = 16});
  ASSERT_TRUE(opened.ok()) << opened.error();
  Past& past = *opened.value();
  ASSERT_EQ(past.contents().parts, uint64_t{Host::kScans});
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
  EXPECT_THAT(why.value(), HasSubstr("GO (X0.0) = 1, since scan 101"));
}

} // namespace
} // namespace rung::replay
