// Reads the signal CSVs (RFC 4180, no line breaks inside fields). Every row keeps its line for messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung::nc::gen {

/// A broken table ends the build: message is "FILE:LINE: what".
struct TableError {
  std::string message;
};

class Table {
public:
  explicit Table(std::string path);

  [[nodiscard]] bool has(std::string_view column) const;
  [[nodiscard]] size_t rowCount() const { return rows_.size(); }
  [[nodiscard]] const std::string& at(size_t row, std::string_view column) const;
  [[nodiscard]] uint32_t number(size_t row, std::string_view column) const;
  [[noreturn]] void fail(size_t row, const std::string& what) const;

private:
  std::string path_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Reads the number at `pos` and moves `pos` past it. False: there is no digit.
bool readNumber(std::string_view text, size_t& pos, uint32_t& value);

/// Whether the text is "PREFIX<number>" and nothing else.
bool matchNumber(std::string_view text, std::string_view prefix, uint32_t& value);

} // namespace rung::nc::gen
