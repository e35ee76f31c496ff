// Recordings that are read while they are written: blocks that are not whole yet, other segments and programs, limits,
// damage.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/embedded_ir.h"
#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "ir/support/temporary_folder.h"
#include "rung/runtime.hpp"
#include "tools/replay/followed.h"

namespace rung::replay {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr int kScans = 1500;

std::string programText(const char* coil) {
  return fmt::format(
      "dialect gsk\nsymbol GO X0.0\nsymbol LAMP Y0.0\nsymbol LATE Y0.1\nFUNC END1\n; lamp\nLD GO\nANI R0.0\n"
      "OUT {}\n; late\nLD {}\nFUNC TMRB\nPRM 1\nPRM 40\nOUT LATE\nFUNC END2\n",
      coil, coil);
}

std::string contentsOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

// A host that has recorded 1,500 scans into the folder, in several segments; what its program has done.
struct Host {
  Host(const std::string& folder, const char* coil) {
    Diagnostics diagnostics;
    const FileId files[] = {sources.addBuffer("t.pmc", programText(coil))};
    compiler::CompileRequest request;
    request.marks = request.keepBuilt = true;
    const auto compiled = compiler::compile(sources, files, request, diagnostics);
    EXPECT_TRUE(compiled) << renderText(diagnostics, sources);
    const auto engine = std::move(compiler::makeEngine(compiler::EngineKind::Interp, *compiled, {})).value();
    const rung::Image image = rung::Image::adopt(engine->program(), engine->context());
    rung::Instance instance(image);
    const rung_recording_options options{
        .size = sizeof options, .state_ms = 200, .folder = folder.c_str(), .limit_bytes = 40'000};
    EXPECT_EQ(rung_instance_record(instance.handle(), &options), RUNG_OK) << rung_error_text();
    uint8_t go = 0;
    instance.bindInput("GO", go);
    instance.powerOn(rung::Power::Cold);
    for (int scan = 0; scan < kScans; ++scan) {
      go = scan / 100 % 2;
      EXPECT_EQ(instance.slot(), RUNG_OK);
      lamps.push_back(static_cast<int>(instance.read<int64_t>(instance.find(coil))));
      if (scan % 250 == 0) std::this_thread::sleep_for(100ms); // a block is written
    }
    EXPECT_EQ(rung_instance_record(instance.handle(), nullptr), RUNG_OK);
    write(fs::path(folder) / runtime::programName(compiled->codeHash), compiler::irText(*compiled));
  }
  SourceManager sources;
  std::vector<int> lamps;
};

std::vector<fs::path> segmentsOf(const std::string& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".rec") found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

class Growing : public testing::Test {
protected:
  Growing() {
    fs::create_directory(grown_);
    for (const auto& entry : fs::directory_iterator(whole_))
      if (entry.path().extension() == ".program") fs::copy(entry.path(), grown_);
  }

  // Writes so much of the segment to the folder that is followed.
  void give(const fs::path& segment, size_t bytes) {
    write(fs::path(grown_) / segment.filename(), contentsOf(segment).substr(0, bytes));
  }
  // Takes until nothing has come for as long as other files may be looked for.
  void takeAll(Followed& followed) {
    for (auto last = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() - last < 500ms;) {
      if (followed.take()) last = std::chrono::steady_clock::now();
      std::this_thread::sleep_for(20ms);
    }
  }
  Followed open(const RecordingLimits& limits = kFollowedLimits) {
    Result<std::unique_ptr<GrowingRecording>> files = GrowingRecording::open(grown_, limits, {});
    EXPECT_TRUE(files.ok()) << files.error();
    Followed followed{std::move(files).value(), nullptr};
    Result<std::unique_ptr<Past>> past =
        Past::open(followed.files->recording(), {.engine = compiler::EngineKind::Interp, .keptEvery = 16});
    EXPECT_TRUE(past.ok()) << past.error();
    followed.past = std::move(past).value();
    return followed;
  }
  static int64_t lampAt(Past& past, uint64_t part) {
    EXPECT_EQ(past.goTo(part), "") << part;
    const auto lamp = runtime::bitRef(spaceOf(past.instance().program(), 'Y'), 0, 0);
    return static_cast<int64_t>(past.instance().read(lamp));
  }
  static uint32_t spaceOf(const rung_program& program, char name) {
    for (uint32_t space = 0; space < program.space_count; ++space)
      if (program.spaces[space].name == std::string(1, name)) return space;
    return 0;
  }

  const TemporaryFolder folder_;
  const std::string whole_ = folder_ / "whole", grown_ = folder_ / "grown";
  Host host_{whole_, "LAMP"};
};

TEST_F(Growing, WhatIsWrittenIsTakenWheneverABlockIsWhole) {
  const std::vector<fs::path> segments = segmentsOf(whole_);
  ASSERT_GT(segments.size(), 2u);
  std::mt19937 random(3);
  give(segments[0], contentsOf(segments[0]).size() / 2);
  Followed followed = open();
  Past& past = *followed.past;
  uint64_t parts = past.contents().parts;
  EXPECT_GT(parts, 0u);
  EXPECT_LT(parts, uint64_t{kScans});
  for (const fs::path& segment : segments) {
    const size_t size = contentsOf(segment).size();
    for (size_t bytes = segment == segments[0] ? size / 2 : 0; bytes < size;) {
      bytes = std::min(size, bytes + 1 + random() % 3000);
      give(segment, bytes);
      if (bytes == size) takeAll(followed);
      (void)followed.take();
      ASSERT_GE(past.contents().parts, parts);
      parts = past.contents().parts;
      ASSERT_EQ(lampAt(past, parts), host_.lamps[parts - 1]) << parts;
      ASSERT_NE(past.flow(), nullptr) << parts;
      ASSERT_EQ(past.flowInstance().nowUs(), past.instance().nowUs()) << "the same part ran rung by rung";
      if (parts > 3) { // each rung runs in each slot
        const Flow* three = past.flow({}, 3);
        ASSERT_NE(three, nullptr) << parts;
        ASSERT_EQ(three->timesRun()[0], 3u) << parts;
        ASSERT_EQ(past.flowInstance().nowUs(), past.instance().nowUs());
        ASSERT_EQ(past.partsPerScan(), 1u);
      }
      const uint64_t before = 1 + random() % parts;
      ASSERT_EQ(lampAt(past, before), host_.lamps[before - 1]) << before;
    }
  }
  EXPECT_EQ(parts, uint64_t{kScans});
  EXPECT_TRUE(followed.files->ended());
  EXPECT_TRUE(followed.files->recording().problems.empty());
  EXPECT_TRUE(past.differences().empty());
  const Result<Recording> atOnce = readRecording(whole_);
  ASSERT_TRUE(atOnce.ok());
  EXPECT_EQ(Contents(atOnce.value()).parts, parts);
  EXPECT_EQ(Contents(atOnce.value()).states.size(), past.contents().states.size());
}

// A repetition is of the last part, which a player that begins at a kept moment has not run.
TEST_F(Growing, TheNewestMomentStaysAPlaceToBeginWith) {
  const std::vector<fs::path> segments = segmentsOf(whole_);
  give(segments[0], contentsOf(segments[0]).size() / 3);
  Followed followed = open();
  Past& past = *followed.past;
  const uint64_t newest = past.contents().parts;
  ASSERT_EQ(past.goTo(newest), "");
  past.keep();
  ASSERT_EQ(past.goTo(past.firstPart()), "");
  ASSERT_EQ(past.goTo(newest), "");
  for (const fs::path& segment : segments) give(segment, contentsOf(segment).size());
  takeAll(followed);
  for (uint64_t part = newest; part < newest + 100; ++part)
    ASSERT_EQ(lampAt(past, part), host_.lamps[part - 1]) << part;
}

TEST_F(Growing, TheOldestIsDroppedAndScansKeepTheirNumbers) {
  const std::vector<fs::path> segments = segmentsOf(whole_);
  give(segments[0], contentsOf(segments[0]).size());
  Followed followed = open({.bytes = 1, .us = INT64_MAX});
  Past& past = *followed.past;
  const uint64_t first = past.firstPart();
  uint64_t position = past.part();
  for (size_t i = 1; i < segments.size(); ++i) {
    give(segments[i], contentsOf(segments[i]).size());
    takeAll(followed);
    (void)followed.take();
    EXPECT_GE(past.part(), position);
    position = past.part();
  }
  EXPECT_EQ(past.contents().parts, uint64_t{kScans});
  ASSERT_GT(past.firstPart(), first);
  EXPECT_NE(past.goTo(past.firstPart() - 1), "");
  for (uint64_t part = past.firstPart() + 1; part <= kScans; part += 7)
    ASSERT_EQ(lampAt(past, part), host_.lamps[part - 1]) << part;
  uint64_t bytes = 0;
  for (const Segment& segment : followed.files->recording().segments) bytes += segment.events.size();
  const Result<Recording> all = readRecording(whole_);
  uint64_t whole = 0;
  for (const Segment& segment : all.value().segments) whole += segment.events.size();
  EXPECT_LT(bytes, whole);
}

TEST_F(Growing, OnlyTheNewestFilesAreRead) {
  for (const fs::path& segment : segmentsOf(whole_)) give(segment, contentsOf(segment).size());
  Followed followed = open({.bytes = UINT64_MAX, .us = 0});
  EXPECT_LT(followed.past->contents().parts, uint64_t{kScans});
  EXPECT_GT(followed.past->contents().parts, 0u);
}

TEST_F(Growing, DamageIsNamedAndWhatFollowsIsTaken) {
  const std::vector<fs::path> segments = segmentsOf(whole_);
  std::string bytes = contentsOf(segments[0]);
  bytes[bytes.size() / 2] ^= 0x55;
  write(fs::path(grown_) / segments[0].filename(), bytes);
  Followed followed = open();
  for (size_t i = 1; i < segments.size(); ++i) give(segments[i], contentsOf(segments[i]).size());
  takeAll(followed);
  Past& past = *followed.past;
  EXPECT_LT(past.contents().parts, uint64_t{kScans});
  ASSERT_EQ(past.goTo(past.contents().parts), "");
  EXPECT_EQ(lampAt(past, past.contents().parts), host_.lamps.back());
  EXPECT_TRUE(std::ranges::any_of(past.contents().landmarks,
                                  [](const Landmark& l) { return l.kind == Landmark::Kind::Damaged; }));
}

TEST_F(Growing, AHostThatWasKilledIsFollowedAgainWithAnotherProgram) {
  const std::vector<fs::path> segments = segmentsOf(whole_);
  for (const fs::path& segment : segments) {
    const size_t size = contentsOf(segment).size();
    give(segment, segment == segments.back() ? size - 40 : size);
  }
  Followed followed = open();
  Past& past = *followed.past;
  const uint64_t before = past.contents().parts;
  ASSERT_EQ(past.goTo(before), "");
  const Host other(grown_, "Y0.2");
  takeAll(followed);
  EXPECT_EQ(followed.files->recording().programs.size(), 2u);
  ASSERT_EQ(past.contents().parts, before + kScans);
  ASSERT_EQ(past.goTo(before + kScans), "");
  EXPECT_EQ(past.programNumber(), 1u);
  EXPECT_EQ(lampAt(past, before), host_.lamps[before - 1]);
  EXPECT_EQ(past.programNumber(), 0u);
  EXPECT_TRUE(std::ranges::any_of(past.contents().landmarks,
                                  [](const Landmark& l) { return l.kind == Landmark::Kind::Start; }));
}

// A program that this compiler cannot play is named, and what the recording has of the other one stays.
TEST_F(Growing, AProgramWithoutItsFileIsNamed) {
  for (const fs::path& segment : segmentsOf(whole_)) give(segment, contentsOf(segment).size());
  Followed followed = open();
  const uint64_t before = followed.past->contents().parts;
  const TemporaryFolder elsewhere;
  {
    const Host other(elsewhere / "other", "Y0.2");
  }
  for (const fs::path& segment : segmentsOf(elsewhere / "other")) {
    std::string bytes = contentsOf(segment);
    const auto number = static_cast<uint64_t>(90 + std::stoi(segment.filename().string()));
    runtime::SegmentHead head;
    std::memcpy(&head, bytes.data(), sizeof head);
    head.number = number;
    head.checksum = head.sum();
    std::memcpy(bytes.data(), &head, sizeof head);
    write(fs::path(grown_) / runtime::segmentName(number, false), bytes);
  }
  takeAll(followed);
  EXPECT_EQ(followed.past->contents().parts, before);
  ASSERT_FALSE(followed.files->recording().problems.empty());
  EXPECT_THAT(followed.files->recording().problems.back(), HasSubstr(".program"));
}

} // namespace
} // namespace rung::replay
