// The parts of the signal generator: one layout function for each dialect assigns every row its place, `emit` writes
// C++.
#pragma once

#include "rtlib/nc/gen/csv.h"
#include "rtlib/nc/signal.h"

#include <ostream>
#include <string>
#include <vector>

namespace rung::nc::gen {

/// A Signal that owns its texts.
struct Row {
  std::string symbol, address, area, structure, group, meaning, note;
  uint32_t byteOffset = 0, count = 1, strideBytes = 0, manualLine = 0;
  uint32_t bit = 0;
  SignalType type = SignalType::Bit;
  Direction direction = Direction::In;
  bool inferred = false;
};

/// The columns that mean the same in every dialect.
Row commonColumns(const Table& table, size_t row);

std::vector<Row> layoutFanuc(const Table& table);
std::vector<Row> layoutGsk(const Table& table);
std::vector<Row> layoutNct(const Table& table);
std::vector<Row> layoutTechnol(const Table& table);

void emit(std::ostream& out, const std::vector<Row>& rows, bool ignoreCase);

} // namespace rung::nc::gen
