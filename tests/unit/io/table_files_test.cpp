// The files of PLC tables: which tables there are, and what is on disk whatever happens.
#include "machine/io/tables/table_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "ir/support/temporary_folder.h"
#include "tests/support/words.h"
#include "tests/unit/io/materials.h"

namespace rung::io {
namespace {

using testing::HasSubstr;

class TableFilesTest : public testing::Test {
protected:
  void SetUp() override {
    write("d.PlcTDef", test::kMaterials);
    write("t.PlcT", test::kThreeLines);
  }
  std::string path(std::string_view name) const { return (folder_ / name).string(); }
  std::string contents(std::string_view name) const { return folder_.contentsOf(name).value_or("unreadable"); }
  void write(std::string_view name, std::string_view text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  std::string load(TableFiles& files, PlcTables& tables) const {
    EXPECT_EQ(files.setTable(0, path("t.PlcT")), "");
    EXPECT_EQ(files.setDefinition(7, path("d.PlcTDef")), "");
    return files.load(tables);
  }
  int32_t countAt(const PlcTables& tables, uint32_t line) const {
    int32_t value = 0;
    EXPECT_EQ(tables.getInt(0, line, 1, value), TableError::None);
    return value;
  }

  TemporaryFolder folder_;
};

TEST_F(TableFilesTest, ATableTakesTheDefinitionThatItNames) { // l.18362
  TableFiles files;
  PlcTables tables;
  EXPECT_EQ(load(files, tables), "");
  EXPECT_EQ(countAt(tables, 0), -7);
  EXPECT_FALSE(tables.exists(7));
}

TEST_F(TableFilesTest, MissingDefinition) {
  TableFiles files;
  PlcTables tables;
  test::loadMaterials(tables, 0); // of a former configuration
  test::loadMaterials(tables, 1);
  EXPECT_EQ(files.setTable(0, path("t.PlcT")), "");
  EXPECT_EQ(test::lacking(files.load(tables), {path("t.PlcT") + ":2:13: ", "'Materials'"}), "");
  EXPECT_FALSE(tables.exists(0));
  EXPECT_FALSE(tables.exists(1));
  write("e.PlcTDef", "<PLCTableDef><Definition><DefinitionID>Tools</DefinitionID><ColsCount>0</ColsCount>"
                     "</Definition></PLCTableDef>");
  EXPECT_EQ(files.setDefinition(0, path("e.PlcTDef")), "");
  EXPECT_EQ(test::lacking(files.load(tables), {path("t.PlcT") + ":2:13: ", "'Materials'", "Tools"}), "");
}

TEST_F(TableFilesTest, TwoDefinitionsOfOneId) {
  TableFiles files;
  PlcTables tables;
  EXPECT_EQ(files.setDefinition(0, path("d.PlcTDef")), "");
  const std::string place = path("d.PlcTDef") + ":2:13";
  EXPECT_EQ(test::lacking(load(files, tables), {path("t.PlcT") + ":2:13: ", "'Materials'", place, place}), "");
  EXPECT_FALSE(tables.exists(0));
}

TEST_F(TableFilesTest, NumbersOutOfRange) {
  TableFiles files;
  EXPECT_EQ(test::lacking(files.setTable(256, path("t.PlcT")), {path("t.PlcT"), "256", "255"}), "");
  EXPECT_EQ(test::lacking(files.setDefinition(256, path("d.PlcTDef")), {path("d.PlcTDef"), "256", "255"}), "");
  EXPECT_EQ(files.setTable(255, path("t.PlcT")), "");
}

TEST_F(TableFilesTest, AFileThatDoesNotParseIsLeftAlone) {
  write("t.PlcT", test::kThreeLines.substr(0, 200));
  TableFiles files;
  PlcTables tables;
  EXPECT_EQ(files.setDefinition(0, path("d.PlcTDef")), "");
  EXPECT_THAT(files.setTable(0, path("t.PlcT")), HasSubstr("not well-formed"));
  EXPECT_EQ(files.load(tables), "");
  EXPECT_FALSE(tables.exists(0));
  EXPECT_EQ(files.saveNow(tables), "");
  EXPECT_EQ(contents("t.PlcT"), test::kThreeLines.substr(0, 200));
}

TEST_F(TableFilesTest, AFileWithAWrongElementIsLeftAlone) {
  write("bad.PlcT", "<PLCTable><Definition><DefinitionID>Materials</DefinitionID><LinesCount>1</LinesCount>"
                    "</Definition>\n<Line No='0'><Col ColID='Feed'>fast</Col></Line></PLCTable>");
  const std::string before = contents("bad.PlcT");
  TableFiles files;
  PlcTables tables;
  EXPECT_EQ(files.setTable(1, path("bad.PlcT")), "");
  EXPECT_EQ(test::lacking(load(files, tables), {path("bad.PlcT") + ":2:14: ", "'Feed'", "'fast'"}), "");
  EXPECT_TRUE(tables.exists(0)); // the other one is right
  EXPECT_FALSE(tables.exists(1));
  EXPECT_EQ(files.saveNow(tables), "");
  EXPECT_EQ(contents("bad.PlcT"), before);
}

TEST_F(TableFilesTest, OnlyChangesAreWritten) {
  TableFiles files;
  PlcTables tables;
  EXPECT_EQ(load(files, tables), "");
  EXPECT_EQ(files.saveNow(tables), "");
  EXPECT_EQ(contents("t.PlcT"), test::kThreeLines);
  EXPECT_EQ(tables.setInt(0, 1, 1, 42), TableError::None);
  EXPECT_EQ(tables.select(0, 2), TableError::None);
  EXPECT_EQ(files.saveNow(tables), "");
  EXPECT_FALSE(tables.isDirty(0));
  const std::string written = contents("t.PlcT");
  EXPECT_THAT(written, HasSubstr("<Col ColID=\"Count\">42</Col>"));
  EXPECT_THAT(written, HasSubstr("<Col ColID=\"Název\">měď</Col>"));

  TableFiles again;
  PlcTables read;
  EXPECT_EQ(load(again, read), "");
  uint32_t line = 0;
  EXPECT_EQ(read.selectedLine(0, line), TableError::None);
  EXPECT_EQ(line, 2u);
  EXPECT_EQ(read.setInt(0, 1, 1, 42), TableError::None);
  EXPECT_EQ(again.saveNow(read), "");
  EXPECT_EQ(contents("t.PlcT"), written); // the same contents, the same bytes
}

TEST_F(TableFilesTest, OnceASecondAtMost) {
  constexpr int64_t kSecond = 1'000'000'000;
  TableFiles files;
  PlcTables tables;
  EXPECT_EQ(load(files, tables), "");
  const auto savedAt = [&](int64_t ns) {
    EXPECT_EQ(tables.setInt(0, 0, 1, static_cast<int32_t>(ns % 1000)), TableError::None);
    EXPECT_EQ(files.save(tables, ns), "");
    return !tables.isDirty(0);
  };
  EXPECT_TRUE(savedAt(5 * kSecond));
  EXPECT_FALSE(savedAt(5 * kSecond + 1));
  EXPECT_FALSE(savedAt(6 * kSecond - 1));
  EXPECT_TRUE(savedAt(6 * kSecond));
  EXPECT_EQ(files.save(tables, 7 * kSecond), ""); // nothing to do
  EXPECT_TRUE(savedAt(7 * kSecond + 1));
}

TEST_F(TableFilesTest, ThePermissionsStay) {
  ASSERT_EQ(::chmod(path("t.PlcT").c_str(), 0640), 0);
  TableFiles files;
  PlcTables tables;
  EXPECT_EQ(load(files, tables), "");
  EXPECT_EQ(tables.setInt(0, 0, 1, 1), TableError::None);
  EXPECT_EQ(files.saveNow(tables), "");
  struct stat about{};
  ASSERT_EQ(::stat(path("t.PlcT").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777u, 0640u);
}

TEST_F(TableFilesTest, WhatCannotBeWrittenStaysToBeStored) {
  TableFiles files;
  PlcTables tables;
  std::filesystem::create_directory(path("f"));
  write("f/t.PlcT", test::kThreeLines);
  EXPECT_EQ(files.setTable(0, path("f/t.PlcT")), "");
  EXPECT_EQ(files.setDefinition(0, path("d.PlcTDef")), "");
  EXPECT_EQ(files.load(tables), "");
  std::filesystem::remove_all(path("f"));
  EXPECT_EQ(tables.setInt(0, 0, 1, 1), TableError::None);
  EXPECT_THAT(files.saveNow(tables), HasSubstr("cannot write '" + path("f/t.PlcT") + "': "));
  EXPECT_TRUE(tables.isDirty(0));
  std::filesystem::create_directory(path("f"));
  EXPECT_EQ(files.saveNow(tables), "");
  EXPECT_FALSE(tables.isDirty(0));
}

// A process that is killed at any time leaves a whole file, and nothing that was stored is lost.
TEST_F(TableFilesTest, KilledWhileItWrites) {
  int32_t stored = 0;
  for (int round = 0; round < 15; ++round) {
    int pipes[2];
    ASSERT_EQ(::pipe(pipes), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      TableFiles files;
      PlcTables tables;
      if (!load(files, tables).empty()) ::_exit(1);
      for (int32_t value = stored + 1;; ++value) {
        if (tables.setInt(0, 1, 1, value) != TableError::None || !files.saveNow(tables).empty()) ::_exit(1);
        if (::write(pipes[1], &value, sizeof value) != sizeof value) ::_exit(1);
      }
    }
    ::close(pipes[1]);
    int32_t reported = stored, value = 0;
    for (int i = 0; i <= round; ++i)
      if (::read(pipes[0], &value, sizeof value) == sizeof value) reported = value;
    ::usleep(static_cast<useconds_t>(round * 137));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    ::close(pipes[0]);
    TableFiles files;
    PlcTables tables;
    ASSERT_EQ(load(files, tables), "");
    EXPECT_GE(countAt(tables, 1), reported);
    EXPECT_GT(reported, stored);
    stored = countAt(tables, 1);
  }
}

} // namespace
} // namespace rung::io
