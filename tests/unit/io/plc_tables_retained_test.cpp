// PLC tables outlive a power-off.
#include <gtest/gtest.h>

#include <vector>

#include "machine/io/tables/plc_tables.h"
#include "tests/unit/io/materials.h"

namespace rung::io {
namespace {

class PlcTablesKept : public testing::Test {
protected:
  void SetUp() override {
    test::loadMaterials(tables_, 0);
    test::loadMaterials(tables_, 200);
  }
  std::vector<uint8_t> image() const {
    std::vector<uint8_t> bytes(tables_.retainedSize());
    tables_.copyRetained(bytes);
    return bytes;
  }
  static std::string textOf(const PlcTables& tables, uint32_t table) {
    return io::tableDataText(*tables.contents(table));
  }

  PlcTables tables_;
};

TEST_F(PlcTablesKept, NothingToKeep) {
  PlcTables none;
  EXPECT_EQ(none.retainedSize(), 0u);
  none.copyRetained({});
  EXPECT_TRUE(none.restoreRetained({}));
}

TEST_F(PlcTablesKept, ContentsAndSelectedLinesAreKept) {
  const uint32_t size = tables_.retainedSize();
  EXPECT_EQ(tables_.addLine(200), "");
  EXPECT_EQ(tables_.edit(200, 3, "Název", "hliník"), "");
  EXPECT_EQ(tables_.selectByOperator(200, 3), "");
  EXPECT_EQ(tables_.removeLine(0, 1), "");
  EXPECT_EQ(tables_.retainedSize(), size);
  const std::vector<uint8_t> kept = image();

  PlcTables again; // another process, the same files
  test::loadMaterials(again, 0);
  test::loadMaterials(again, 200);
  EXPECT_EQ(again.edit(0, 0, "Count", "5"), ""); // an unread mark, and what is overwritten
  EXPECT_TRUE(again.restoreRetained(kept));
  EXPECT_EQ(textOf(again, 0), textOf(tables_, 0));
  EXPECT_EQ(textOf(again, 200), textOf(tables_, 200));
  uint32_t line = 0;
  EXPECT_EQ(again.selectedLine(200, line), TableError::None);
  EXPECT_EQ(line, 3u);
  TableChange change{};
  EXPECT_EQ(again.takeChange(0, change), TableError::None);
  EXPECT_EQ(change, TableChange::None);
  EXPECT_EQ(again.addLine(0), "");
  EXPECT_EQ(again.contents(0)->lines[2].elements[1].value, "0");
}

TEST_F(PlcTablesKept, AnEmptyImageChangesNothing) {
  EXPECT_EQ(tables_.edit(0, 0, "Count", "5"), "");
  const std::string before = textOf(tables_, 0);
  EXPECT_TRUE(tables_.restoreRetained({}));
  EXPECT_EQ(textOf(tables_, 0), before);
}

TEST_F(PlcTablesKept, PowerUpForgetsChanges) {
  EXPECT_EQ(tables_.edit(0, 0, "Count", "5"), "");
  EXPECT_EQ(tables_.selectByOperator(0, 1), "");
  tables_.forgetChanges();
  TableChange change{};
  EXPECT_EQ(tables_.takeChange(0, change), TableError::None);
  EXPECT_EQ(change, TableChange::None);
}

TEST_F(PlcTablesKept, AFileThatWasChangedWins) {
  EXPECT_EQ(tables_.edit(0, 0, "Count", "5"), "");
  EXPECT_EQ(tables_.edit(200, 0, "Count", "6"), "");
  const std::vector<uint8_t> kept = image();
  PlcTables again;
  test::loadMaterials(again, 200);
  TableData edited = test::dataOf(test::kThreeLines);
  edited.lines[0].elements[0].value = "2001";
  EXPECT_EQ(again.load(0, test::definitionOf(test::kMaterials), edited), "");
  EXPECT_FALSE(again.restoreRetained(kept));
  int32_t value = 0;
  EXPECT_EQ(again.getInt(0, 0, 1, value), TableError::None);
  EXPECT_EQ(value, -7);
  EXPECT_EQ(again.getInt(200, 0, 1, value), TableError::None);
  EXPECT_EQ(value, 6);
}

TEST_F(PlcTablesKept, ATableThatIsNoLongerThere) {
  const std::vector<uint8_t> kept = image();
  tables_.remove(0);
  EXPECT_FALSE(tables_.restoreRetained(kept));
  EXPECT_FALSE(tables_.exists(0));
}

TEST_F(PlcTablesKept, ImagesThatAreNone) {
  const std::vector<uint8_t> kept = image();
  const std::string before = textOf(tables_, 0);
  for (const size_t size : {1u, 7u, 9u, 31u, 1000u})
    EXPECT_FALSE(tables_.restoreRetained(std::span(kept).first(size))) << size;
  for (size_t byte = 0; byte < 40; ++byte) // the heads of the image and of the first table
    for (const uint8_t bits : {0x01, 0x80, 0xFF}) {
      std::vector<uint8_t> spoiled = kept;
      spoiled[byte] ^= bits;
      tables_.restoreRetained(spoiled);
      uint32_t count = 0, line = 0;
      EXPECT_EQ(tables_.lineCount(0, count), TableError::None);
      EXPECT_LE(count, 259u);
      if (tables_.selectedLine(0, line) == TableError::None) EXPECT_LT(line, count);
    }
  EXPECT_TRUE(tables_.restoreRetained(kept));
  EXPECT_EQ(textOf(tables_, 0), before);
  std::vector<uint8_t> wrongSize(kept.size() - 1, 0xAA);
  tables_.copyRetained(wrongSize);
  EXPECT_EQ(wrongSize, std::vector<uint8_t>(kept.size() - 1, 0xAA));
}

} // namespace
} // namespace rung::io
