// Positions, lines and columns.
#include "ir/support/source.h"

#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

namespace rung {
namespace {

std::string at(const SourceManager& sources, FileId file, size_t offset) {
  const LineCol place = sources.lineCol(sources.position(file, offset));
  return std::string(place.file) + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

TEST(Source, LinesAndColumnsCountFromOne) {
  SourceManager sources;
  const FileId file = sources.addBuffer("a.lad", "one\ntwo\n\nfour");
  EXPECT_EQ(at(sources, file, 0), "a.lad:1:1");
  EXPECT_EQ(at(sources, file, 3), "a.lad:1:4"); // the line end belongs to its line
  EXPECT_EQ(at(sources, file, 4), "a.lad:2:1");
  EXPECT_EQ(at(sources, file, 8), "a.lad:3:1");
  EXPECT_EQ(at(sources, file, 13), "a.lad:4:5"); // the end of the file
  EXPECT_EQ(sources.lineCount(file), 4u);
}

TEST(Source, FilesAreUtf8WhateverTheyAreWrittenIn) {
  SourceManager sources;
  sources.setEncoding("windows-1250");
  const FileId told = sources.addBytes("a.plc", "; encoding: gb18030\n; \xBC\xB1\n\x1A\xFF\xF6"); // no characters
  EXPECT_EQ(sources.text(told), "; encoding: gb18030\n; 急\n");
  EXPECT_EQ(sources.bytesOf(told, "; 急停\n"), "; \xBC\xB1\xCD\xA3\n\x1A\xFF\xF6");
  const FileId set = sources.addBytes("b.plc", "m\xEC\xEF");
  EXPECT_EQ(sources.text(set), "měď");
  EXPECT_EQ(sources.bytesOf(set, "急"), std::nullopt);
  const FileId wrong = sources.addBytes("c.plc", "; encoding: gb18030\n\xFF");
  ASSERT_TRUE(sources.undecoded(wrong));
  EXPECT_EQ(sources.undecoded(wrong)->offset, 20u);
  const FileId unknown = sources.addBytes("d.plc", "; encoding: klingon\n\xFF");
  ASSERT_TRUE(sources.undecoded(unknown));
  EXPECT_FALSE(sources.undecoded(unknown)->known);
  EXPECT_FALSE(sources.undecoded(told) || sources.undecoded(set));
}

TEST(Source, AByteOrderMarkCountsMoreThanWhatIsSaid) {
  const std::string text = "\xEF\xBB\xBF; encoding: gb18030\n; 急\n";
  SourceManager sources;
  const FileId marked = sources.addBytes("a.pmc", text);
  EXPECT_EQ(sources.text(marked), text);
  EXPECT_EQ(sources.bytesOf(marked, text), text);
  const FileId wrong = sources.addBytes("b.pmc", "\xEF\xBB\xBF; encoding: gb18030\n\xBC\xB1\n");
  ASSERT_TRUE(sources.undecoded(wrong));
  EXPECT_EQ(sources.undecoded(wrong)->encoding, "UTF-8");
  const FileId unknown = sources.addBytes("c.pmc", "\xEF\xBB\xBF; encoding: klingon\n");
  ASSERT_TRUE(sources.undecoded(unknown));
  EXPECT_FALSE(sources.undecoded(unknown)->known);
}

TEST(Source, ADosMarkEndsAFile) {
  SourceManager sources;
  const FileId file = sources.addBytes("a.lad", "one\n\x1A\x1A rest");
  EXPECT_EQ(sources.text(file), "one\n");
  EXPECT_EQ(sources.bytesOf(file, "two\n"), "two\n\x1A\x1A rest");
  EXPECT_EQ(sources.textAfterEnd(file), 6u);
  EXPECT_EQ(sources.textAfterEnd(sources.addBytes("b.lad", "one\n\x1A")), 0u);
  EXPECT_EQ(sources.textAfterEnd(sources.addBytes("c.lad", std::string("one\n\x1A\x1A\r\n\0", 9))), 0u);
  EXPECT_EQ(sources.textAfterEnd(sources.addBytes("d.lad", "one\n")), 0u);
}

TEST(Source, EmptyFileHasOnePosition) {
  SourceManager sources;
  const FileId file = sources.addBuffer("empty", "");
  EXPECT_EQ(at(sources, file, 0), "empty:1:1");
  EXPECT_EQ(sources.lineCount(file), 1u);
  EXPECT_EQ(sources.lineText(file, 1), "");
}

TEST(Source, LineEndAtTheEndOpensNoLine) {
  SourceManager sources;
  const FileId file = sources.addBuffer("f", "one\n");
  EXPECT_EQ(sources.lineCount(file), 1u);
  EXPECT_EQ(at(sources, file, 4), "f:1:5");
}

TEST(Source, LineTextHasNoLineEnd) {
  SourceManager sources;
  const FileId file = sources.addBuffer("f", "unix\ndos\r\n\r\nlast\r");
  EXPECT_EQ(sources.lineText(file, 1), "unix");
  EXPECT_EQ(sources.lineText(file, 2), "dos");
  EXPECT_EQ(sources.lineText(file, 3), "");
  EXPECT_EQ(sources.lineText(file, 4), "last");
}

TEST(Source, ColumnsCountCharactersNotBytes) {
  SourceManager sources;
  const FileId file = sources.addBuffer("f", "\u00E9\u4E2Dx\ny\u00E9z");
  EXPECT_EQ(at(sources, file, 2), "f:1:2");
  EXPECT_EQ(at(sources, file, 5), "f:1:3");
  EXPECT_EQ(at(sources, file, 10), "f:2:3");
}

TEST(Source, ColumnsInALongLineOfManyAlphabets) {
  std::string text = "first\n";
  for (int i = 0; i < 5000; ++i) text += "a\u00E9";
  SourceManager sources;
  const FileId file = sources.addBuffer("f", text);
  for (const size_t i : {0u, 1u, 340u, 341u, 342u, 4999u})
    EXPECT_EQ(at(sources, file, 6 + 3 * i), "f:2:" + std::to_string(2 * i + 1));
}

TEST(Source, PositionsOfSeveralFilesAreDistinct) {
  SourceManager sources;
  const FileId a = sources.addBuffer("a", "aa");
  const FileId b = sources.addBuffer("b", "");
  const FileId c = sources.addBuffer("c", "cc");
  EXPECT_LT(sources.position(a, 2), sources.position(b, 0));
  EXPECT_LT(sources.position(b, 0), sources.position(c, 0));
  EXPECT_EQ(sources.fileOf(sources.position(a, 2)), a);
  EXPECT_EQ(sources.fileOf(sources.position(b, 0)), b);
  EXPECT_EQ(sources.fileOf(sources.position(c, 2)), c);
  EXPECT_EQ(sources.offsetOf(sources.position(c, 1)), 1u);
  EXPECT_FALSE(SourcePos().valid());
}

TEST(Source, TextOfARange) {
  SourceManager sources;
  const FileId file = sources.addBuffer("f", "one two");
  EXPECT_EQ(sources.text(sources.range(file, 4, 7)), "two");
  EXPECT_EQ(sources.text(join(sources.range(file, 0, 1), sources.range(file, 6, 7))), "one two");
}

TEST(Source, TextsStayWhereTheyAre) {
  SourceManager sources;
  const std::string_view first = sources.text(sources.addBuffer("f", "short"));
  for (int i = 0; i < 1000; ++i) sources.addBuffer("g", "more");
  SourceManager moved = std::move(sources);
  EXPECT_EQ(moved.text(FileId{0}).data(), first.data());
}

TEST(Source, ReadsFiles) {
  const std::string path = testing::TempDir() + "rung_source_test.txt";
  std::ofstream(path, std::ios::binary) << "one\r\ntwo";
  SourceManager sources;
  const Result<FileId> file = sources.addFile(path);
  ASSERT_TRUE(file.ok()) << file.error();
  EXPECT_EQ(sources.text(file.value()), "one\r\ntwo");
  EXPECT_EQ(sources.name(file.value()), path);
  std::remove(path.c_str());
}

TEST(Source, SaysWhyAFileCannotBeRead) {
  SourceManager sources;
  EXPECT_EQ(sources.addFile("no/such/file").error(), "No such file or directory");
  EXPECT_EQ(sources.addFile(testing::TempDir()).error(), "it is a folder");
}

} // namespace
} // namespace rung
