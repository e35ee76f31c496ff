// Segments of recordings: written, read, cut off, damaged, limited, on a full disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "ir/support/temporary_folder.h"
#include "rtlib/record/recording_reader.h"
#include "rtlib/record/recording_writer.h"

namespace rung::runtime {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr uint64_t kProgram = 0xABCD;

// Hands over a state or a part whose events are a text.
void putState(PartStream& stream, uint64_t program = kProgram) {
  const auto put = [](EventWriter& writer) noexcept {
    writer.put(Event::State, 0);
    return true;
  };
  EXPECT_TRUE(stream.putState(program, 0, 64, put));
}
void putPart(PartStream& stream, const std::string& text) {
  stream.events().put(Event::Mark, text.size());
  stream.events().putBytes({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  stream.announce(PartKind::Scan, RUNG_NONE);
  stream.begin();
  stream.end();
  stream.flush();
}

class Files : public testing::Test {
protected:
  std::string folder() const { return (folder_ / "rec").string(); }
  std::string path(uint64_t number, bool kept = false) const { return folder() + "/" + segmentName(number, kept); }
  RecordingOptions options() const { return {.folder = folder()}; }
  // A state and three blocks of events, and the same again.
  void write() {
    RecordingWriter writer(stream, RecordingMode::Control, options());
    for (int i = 0; i < 2; ++i) {
      putState(stream);
      writer.look();
      for (const char* text : {"one", "two", "three"}) putPart(stream, text), writer.look();
    }
  }
  std::string contents() const {
    std::ifstream in(path(1), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace(const std::string& bytes) const { std::ofstream(path(1), std::ios::binary) << bytes; }

  TemporaryFolder folder_;
  PartStream stream{{.ringBytes = 1 << 16}, 4096};
};

struct Read {
  std::vector<RecordedBlock> blocks;
  std::vector<std::string> problems;
  bool ended = false;
  uint64_t rest = 0;
};
Read readAll(const std::string& path) {
  std::string problem;
  Read read;
  std::optional<SegmentReader> reader = SegmentReader::open(path, problem);
  if (!reader) {
    read.problems.push_back(problem);
    return read;
  }
  for (RecordedBlock block; reader->next(block);) read.blocks.push_back(block);
  read.problems = reader->problems();
  read.ended = reader->ended();
  read.rest = reader->rest();
  return read;
}

std::string textsOf(const Read& read) {
  std::string texts;
  for (const RecordedBlock& block : read.blocks) {
    if (block.afterGap) texts += "gap ";
    EventReader reader(block.events);
    while (!reader.atEnd()) {
      const Event event = reader.takeEvent();
      if (event == Event::Program) (void)reader.takeNumber();
      if (event == Event::State) (void)reader.takeBytes(reader.takeNumber()), texts += "state ";
      if (event == Event::Lost) texts += "lost ";
      if (event == Event::Part) (void)reader.takeNumber(), (void)reader.takeNumber();
      if (event != Event::Mark) continue;
      const std::span<const uint8_t> text = reader.takeBytes(reader.takeNumber());
      texts += std::string(text.begin(), text.end()) + " ";
    }
    EXPECT_TRUE(reader.good());
  }
  return texts;
}

TEST_F(Files, AreReadAsTheyWereWritten) {
  write();
  const Read read = readAll(path(1));
  EXPECT_EQ(textsOf(read), "state one two three state one two three ");
  EXPECT_THAT(read.problems, IsEmpty());
  EXPECT_THAT(read.blocks, SizeIs(9));
  EXPECT_TRUE(read.ended);
  EXPECT_EQ(read.rest, 0u);
}

TEST_F(Files, CutOffAnywhereHaveTheirWholeBlocks) {
  write();
  const std::string all = contents();
  const std::vector<RecordedBlock> blocks = readAll(path(1)).blocks;
  for (size_t size = sizeof(SegmentHead); size < all.size(); ++size) {
    replace(all.substr(0, size));
    const Read read = readAll(path(1));
    const auto whole = std::ranges::count_if(blocks, [&](const RecordedBlock& block) {
      const auto next = std::ranges::upper_bound(blocks, block.offset, {}, &RecordedBlock::offset);
      return (next == blocks.end() ? all.size() : next->offset) <= size;
    });
    ASSERT_EQ(read.blocks.size(), static_cast<size_t>(whole)) << size;
    ASSERT_THAT(read.problems, IsEmpty()) << "a file that grows ends so, too";
    ASSERT_FALSE(read.ended);
  }
}

TEST_F(Files, DamageIsNamedAndLeftOut) {
  write();
  const std::string all = contents();
  const std::vector<RecordedBlock> blocks = readAll(path(1)).blocks;
  const uint64_t secondState = blocks.at(4).offset;
  for (uint64_t at = blocks.at(1).offset; at < secondState; ++at) {
    std::string bytes = all;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    replace(bytes);
    const Read read = readAll(path(1));
    ASSERT_THAT(textsOf(read), HasSubstr("gap state one two three ")) << at;
    ASSERT_THAT(read.problems, ElementsAre(HasSubstr("is damaged from byte"))) << at;
  }
}

TEST_F(Files, ThatAreForeignOrRenamedAreNamed) {
  write();
  std::string problem;
  std::ofstream(path(2)) << "something else, which has more bytes than the head of a segment has";
  std::filesystem::copy_file(path(1), path(7));
  std::string newer = contents();
  newer[8] = 9;
  std::ofstream(path(8), std::ios::binary) << newer;
  const std::optional<RecordingReader> recording = RecordingReader::open(folder(), problem);
  ASSERT_TRUE(recording) << problem;
  EXPECT_THAT(recording->segments(), SizeIs(2));
  EXPECT_THAT(recording->problems(),
              ElementsAre(HasSubstr("is not a segment"), HasSubstr("is segment 1: it was renamed"),
                          HasSubstr("has version 9 of recordings, this one reads version 1")));
  EXPECT_FALSE(RecordingReader::open(folder_.operator/("nothing").string(), problem));
  EXPECT_THAT(problem, HasSubstr("has no segments of a recording"));
}

TEST_F(Files, TheOldestGoAndKeptOnesStay) {
  {
    RecordingOptions small = options();
    small.segmentBytes = 1;
    small.limitBytes = 600;
    RecordingWriter writer(stream, RecordingMode::Control, small);
    const uint8_t byte = 1;
    writer.addProgram(kProgram, {&byte, 1});
    writer.addProgram(7, {&byte, 1});
    for (int i = 1; i <= 20; ++i) {
      putState(stream);
      putPart(stream, std::to_string(i));
      if (i == 3) writer.mark("keep");
      writer.look();
    }
    EXPECT_EQ(writer.state().losses, 0u);
  }
  const std::vector<SegmentFile> left = segmentsIn(folder());
  std::vector<uint64_t> kept;
  uint64_t bytes = 0;
  for (const SegmentFile& file : left)
    if (file.kept)
      kept.push_back(file.number);
    else
      bytes += file.bytes;
  EXPECT_THAT(kept, ElementsAre(2, 3));
  EXPECT_LE(bytes, 600u + 200u);
  EXPECT_EQ(left.back().number, 20u);
  EXPECT_GT(left.size(), 3u);
  EXPECT_EQ(textsOf(readAll(path(3, true))), "state 3 keep ");

  RecordingWriter again(stream, RecordingMode::Control, options()); // another run, with another program
  putState(stream, 7);
  again.look();
  EXPECT_EQ(segmentsIn(folder()).back().number, 21u);
}

TEST_F(Files, AProgramThatNoSegmentNamesGoes) {
  const uint8_t byte = 1;
  {
    RecordingWriter writer(stream, RecordingMode::Control, options());
    writer.addProgram(kProgram, {&byte, 1});
    writer.addProgram(7, {&byte, 1});
    putState(stream);
    writer.look();
  }
  RecordingWriter again(stream, RecordingMode::Control, options());
  putState(stream);
  again.look();
  EXPECT_TRUE(std::filesystem::exists(folder() + "/" + programName(kProgram)));
  EXPECT_FALSE(std::filesystem::exists(folder() + "/" + programName(7)));
}

// Appends while there is room.
struct Room {
  bool full = false;
};
class Limited final : public AppendedFile {
public:
  Limited(std::unique_ptr<AppendedFile> file, const Room& room) : file_(std::move(file)), room_(room) {}
  bool append(std::span<const uint8_t> bytes, std::string& error) override {
    if (!room_.full) return file_->append(bytes, error);
    error = "No space left on device";
    return false;
  }

private:
  std::unique_ptr<AppendedFile> file_;
  const Room& room_;
};

TEST_F(Files, AFullDiskMakesAGap) {
  Room room;
  const auto open = [&](const std::string& name, std::string& error) -> std::unique_ptr<AppendedFile> {
    return std::make_unique<Limited>(openAppended(name, error), room);
  };
  {
    RecordingWriter writer(stream, RecordingMode::Control, options(), open);
    putState(stream);
    putPart(stream, "one");
    writer.look();
    room.full = true;
    putPart(stream, "two");
    writer.look();
    EXPECT_EQ(writer.state().losses, 1u);
    EXPECT_EQ(writer.state().problem, "No space left on device");
    EXPECT_EQ(writer.state().file, "");
    putState(stream); // still full
    writer.look();
    room.full = false;
    putPart(stream, "three");
    writer.look();
    putState(stream);
    putPart(stream, "four");
    writer.look();
    EXPECT_EQ(writer.state().problem, "");
  }
  const std::vector<SegmentFile> left = segmentsIn(folder());
  ASSERT_THAT(left, SizeIs(2));
  EXPECT_EQ(textsOf(readAll(folder() + "/" + left[0].name)), "state one ");
  EXPECT_EQ(textsOf(readAll(folder() + "/" + left[1].name)), "lost state four ");
}

// Whoever reads the former folder has it up to then; the new one can be played by itself.
TEST_F(Files, AFolderThatIsMovedIsSaidAndMadeAgain) {
  RecordingWriter writer(stream, RecordingMode::Control, options());
  const std::string program = "the program";
  writer.addProgram(kProgram, {reinterpret_cast<const uint8_t*>(program.data()), program.size()});
  putState(stream);
  putPart(stream, "before");
  writer.look();
  std::filesystem::rename(folder(), folder() + ".old");
  putPart(stream, "lost");
  writer.look();
  EXPECT_THAT(writer.state().problem, HasSubstr("was moved or deleted while it was written; the recording continues"));
  EXPECT_EQ(writer.state().losses, 1u);
  putState(stream);
  putPart(stream, "after");
  writer.look();
  EXPECT_THAT(readAll(path(2)).blocks, SizeIs(1));
  std::ifstream copied(folder() + "/" + programName(kProgram));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(copied), {}), program);
  EXPECT_EQ(writer.state().file, path(2));
}

TEST_F(Files, OneProcessAtATime) {
  const RecordingWriter writer(stream, RecordingMode::Control, options());
  EXPECT_THROW(RecordingWriter(stream, RecordingMode::Control, options()), std::runtime_error);
}

TEST_F(Files, OfAKilledProcessAreWhole) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    PartStream own{{.ringBytes = 1 << 16}, 4096};
    RecordingWriter writer(own, RecordingMode::Control, options());
    writer.start();
    putState(own);
    for (int i = 0;; ++i) {
      putPart(own, std::to_string(i));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const Read read = readAll(path(1));
  EXPECT_THAT(read.problems, IsEmpty());
  EXPECT_GT(read.blocks.size(), 2u) << "every 80 ms";
  EXPECT_THAT(textsOf(read), HasSubstr("state 0 1 2 3 4 5 "));
  EXPECT_FALSE(read.ended);
}

} // namespace
} // namespace rung::runtime
