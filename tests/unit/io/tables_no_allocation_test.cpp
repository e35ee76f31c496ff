// What programs ask of PLC tables and shared areas allocates nothing.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "ir/support/temporary_folder.h"
#include "machine/io/shared/shared_areas.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/io/materials.h"

namespace {

using namespace rung;
using namespace rung::io;
using rung::test::allocationsOf;
constexpr int kTicks = 10'000;

TEST(TablesNoAllocation, CounterCounts) {
  PlcTables tables;
  EXPECT_GT(allocationsOf([&] { test::loadMaterials(tables); }), 0);
}

TEST(TablesNoAllocation, PlcTables) {
  PlcTables tables;
  test::loadMaterials(tables);
  const std::string text(2000, 'x');
  const std::array<uint8_t, 300> bytes{};
  std::vector<uint8_t> image(tables.retainedSize());
  int errors = 0;
  const auto count = [&](TableError error) { errors += error == TableError::None ? 0 : 1; };
  const auto tick = [&](int i) {
    const auto line = static_cast<uint32_t>(i % 4); // one that is not there, too
    int32_t integer = i;
    double real = i;
    std::string_view characters = std::string_view(text).substr(static_cast<size_t>(i) % text.size());
    std::span<const uint8_t> raw = std::span(bytes).first(static_cast<size_t>(i) % bytes.size());
    uint32_t number = 0;
    ColumnType type{};
    TableChange change{};
    for (const TableError error :
         {tables.setInt(0, line, 1, integer), tables.setReal(0, line, 0, real), tables.setText(0, line, 2, characters),
          tables.setBinary(0, line, 3, raw), tables.getInt(0, line, 1, integer), tables.getReal(0, line, 0, real),
          tables.getText(0, line, 2, characters), tables.getBinary(0, line, 3, raw),
          tables.columnIndex(0, "Key", number), tables.columnId(0, line, characters), tables.columnType(0, line, type),
          tables.select(0, line), tables.selectedLine(0, number), tables.takeChange(0, change),
          tables.lineCount(0, number), tables.getInt(1, 0, 0, integer), tables.getInt(0, 0, 0, integer)})
      count(error);
    if (i % 1000 == 0) tables.copyRetained(image);
  };
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < kTicks; ++i) tick(i);
            }),
            0);
  EXPECT_GT(errors, 2 * kTicks);
  EXPECT_EQ(allocationsOf([&] { EXPECT_TRUE(tables.restoreRetained(image)); }), 0);
}

void ticksOf(SharedAreas& areas) {
  std::vector<uint8_t> bytes(3000);
  int done = 0;
  EXPECT_EQ(allocationsOf([&] {
              for (uint32_t i = 0; i < kTicks; ++i) {
                areas.hold(0, i % 8 == 0);
                done += areas.write(i % 3, i * 4, bytes) == AreaResult::Done ? 1 : 0;
                done += areas.read(i % 3, i * 4, bytes) == AreaResult::Done ? 1 : 0;
              }
            }),
            0);
  EXPECT_GT(done, kTicks / 2);
}

TEST(TablesNoAllocation, SharedAreas) {
  SharedAreas areas;
  ticksOf(areas);
}

TEST(TablesNoAllocation, SharedAreasOfAFile) {
  TemporaryFolder folder;
  SharedAreas areas;
  ASSERT_EQ(areas.mapFile((folder / "sa").string()), "");
  ticksOf(areas);
}

} // namespace
