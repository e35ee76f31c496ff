// CSV reader of the signal generator.
#include "rtlib/nc/gen/csv.h"

#include <algorithm>
#include <fstream>

namespace rung::nc::gen {

namespace {

std::vector<std::string> splitLine(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += c;
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

} // namespace

Table::Table(std::string path) : path_(std::move(path)) {
  std::ifstream in(path_);
  if (!in) throw TableError{path_ + ": cannot be read"};
  std::string line;
  if (std::getline(in, line)) columns_ = splitLine(line);
  while (std::getline(in, line)) {
    rows_.push_back(splitLine(line));
    if (rows_.back().size() != columns_.size()) fail(rows_.size() - 1, "wrong number of fields");
  }
}

bool Table::has(std::string_view column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

const std::string& Table::at(size_t row, std::string_view column) const {
  const auto it = std::find(columns_.begin(), columns_.end(), column);
  if (it == columns_.end()) throw TableError{path_ + ":1: no column " + std::string(column)};
  return rows_[row][static_cast<size_t>(it - columns_.begin())];
}

uint32_t Table::number(size_t row, std::string_view column) const {
  const std::string& text = at(row, column);
  size_t pos = 0;
  uint32_t value = 0;
  if (!readNumber(text, pos, value)) fail(row, "no number in column " + std::string(column));
  return value;
}

void Table::fail(size_t row, const std::string& what) const {
  throw TableError{path_ + ":" + std::to_string(row + 2) + ": " + what};
}

bool readNumber(std::string_view text, size_t& pos, uint32_t& value) {
  const size_t start = pos;
  value = 0;
  while (pos < text.size() && text[pos] >= '0' && text[pos] <= '9')
    value = value * 10 + static_cast<uint32_t>(text[pos++] - '0');
  return pos > start;
}

bool matchNumber(std::string_view text, std::string_view prefix, uint32_t& value) {
  size_t pos = prefix.size();
  return text.starts_with(prefix) && readNumber(text, pos, value) && pos == text.size();
}

} // namespace rung::nc::gen
