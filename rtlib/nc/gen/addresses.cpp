// gsk, fanuc: every signal has its printed address, e.g. "X000" and bit 3.
#include "rtlib/nc/gen/gen.h"

namespace rung::nc::gen {

namespace {

std::vector<Row> layoutAddresses(const Table& table, std::string_view groupColumn) {
  std::vector<Row> rows;
  for (size_t i = 0; i < table.rowCount(); ++i) {
    Row row = commonColumns(table, i);
    row.address = table.at(i, "address");
    row.group = table.at(i, groupColumn);
    row.area = row.address.substr(0, 1);
    if (row.area.find_first_of("XYFG") == std::string::npos || !matchNumber(row.address, row.area, row.byteOffset))
      table.fail(i, "address is not X, Y, F or G and a number");
    if (row.type == SignalType::Bit) row.bit = table.number(i, "bit");
    if (row.bit > 7) table.fail(i, "bit is not 0..7");
    row.strideBytes = elementBytes(row.type);
    rows.push_back(std::move(row));
  }
  return rows;
}

} // namespace

std::vector<Row> layoutGsk(const Table& table) { return layoutAddresses(table, "mc_or_tc"); }
std::vector<Row> layoutFanuc(const Table& table) { return layoutAddresses(table, "certainty"); }

} // namespace rung::nc::gen
