// The PLC tables of a control (man. ch. 17, l.18258-19170): at most 256, each with the columns of its definition,
// lines, a selected line, and marks of what an operator has changed and the program has not asked for.
//
// What the program asks (PLCT_*) is answered without allocating, waiting or throwing: a table has room for its lines
// and texts from its loading on. One thread at a time uses the tables; where a scan may not wait for files, requests
// come to the thread of the host that has them, as tickets (l.18671: the instructions take several scans).
//
// Texts and IDs of columns are bytes as in the program's memory (Windows-1250), except where UTF-8 is named.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/tables/plc_table.h"
#include "machine/io/tables/plc_table_files.h"

namespace rung::io {

// What DR is after PLCT_*.
enum class TableError : uint8_t {
  None = 0,
  NoTable = 1,
  NoLine = 2,
  NoColumn = 3,
  OtherType = 4,      // the column's
  CannotBeStored = 5, // texts that do not fit, and what no file could hold (see setReal, setText)
};

// What PLCT_CHANGED gives (l.19007-19012).
enum class TableChange : uint8_t { None = 0, Element = 1, SelectedLine = 2 };

class PlcTables {
public:
  static constexpr uint32_t kTables = 256; // TabIdx is a BYTE (l.18716)
  // An operator may add that many lines to those that the file had.
  static constexpr uint32_t kMoreLines = 256;
  static constexpr uint32_t kMostLines = io::kMostLines;
  // The texts and binary elements of a table may have that many bytes more than in the file.
  static constexpr uint32_t kMoreTextBytes = 1u << 16;
  // Of all tables together: 65535 lines of 63 REALs.
  static constexpr uint64_t kMostBytes = uint64_t{1} << 25;

  // ---- configuration; allocates ----
  // "" or what is wrong with the data, a line "FILE:LINE:COLUMN: ..." each; the table is then as before.
  std::string load(uint32_t table, const TableDefinition& definition, const TableData& data);
  void remove(uint32_t table); // there is no such table any more

  // ---- the program ----
  bool exists(uint32_t table) const noexcept { return table < kTables && tables_[table] != nullptr; }

  // Lines and columns from 0 (l.18717-18719). After an error the result is as before. A text or bytes are those of the
  // table: until its next change.
  TableError getInt(uint32_t table, uint32_t line, uint32_t column, int32_t& value) const noexcept;
  TableError getReal(uint32_t table, uint32_t line, uint32_t column, double& value) const noexcept;
  TableError getText(uint32_t table, uint32_t line, uint32_t column, std::string_view& text) const noexcept;
  TableError getBinary(uint32_t table, uint32_t line, uint32_t column, std::span<const uint8_t>& bytes) const noexcept;
  TableError setInt(uint32_t table, uint32_t line, uint32_t column, int32_t value) noexcept;
  // A value that is not finite cannot be stored.
  TableError setReal(uint32_t table, uint32_t line, uint32_t column, double value) noexcept;
  // Control characters other than tab, CR and LF cannot be stored: XML has no way to write them.
  TableError setText(uint32_t table, uint32_t line, uint32_t column, std::string_view text) noexcept;
  TableError setBinary(uint32_t table, uint32_t line, uint32_t column, std::span<const uint8_t> bytes) noexcept;

  // Exact comparison.
  TableError columnIndex(uint32_t table, std::string_view id, uint32_t& column) const noexcept;
  TableError columnId(uint32_t table, uint32_t column, std::string_view& id) const noexcept;
  TableError columnType(uint32_t table, uint32_t column, ColumnType& type) const noexcept;
  // NoLine: the table has no lines (l.19130: "the line was not found").
  TableError selectedLine(uint32_t table, uint32_t& line) const noexcept;
  TableError select(uint32_t table, uint32_t line) noexcept;
  // The oldest kind of change first (elements, then the selected line); it is then taken. Several changes of a kind
  // that were not requested are one.
  TableError takeChange(uint32_t table, TableChange& change) noexcept;
  TableError lineCount(uint32_t table, uint32_t& count) const noexcept;

  // ---- the operator (editor, screens) and NC programs: "" or what is wrong, in UTF-8. Not for a scan ----
  // `column` is an ID in UTF-8. A text is UTF-8, a number as the file has it, or pairs of hexadecimal digits, by the
  // column's type. Every edit counts as a change, whatever was there.
  std::string edit(uint32_t table, uint32_t line, std::string_view column, std::string_view text);
  std::string edit(uint32_t table, uint32_t line, std::string_view column, double number);
  // Counts as a change where it is another line.
  std::string selectByOperator(uint32_t table, uint32_t line);
  std::string lineProblem(uint32_t table, uint32_t line) const; // "": the line is there
  std::string addLine(uint32_t table); // at the end; its elements are 0, 0.0, no text, no bytes
  // The lines after it move up, and the selected line with them; where it was the selected one, the next is.
  std::string removeLine(uint32_t table, uint32_t line);

  // ---- keeping ----
  // Changes of the program or an operator since the last `stored`.
  bool isDirty(uint32_t table) const noexcept { return exists(table) && tables_[table]->dirty; }
  void stored(uint32_t table) noexcept;
  // As the table's file has it; nothing of a table that is not there.
  std::optional<TableData> contents(uint32_t table) const;

  // All contents and selected lines, as an image for this process or the same machine. The size changes with `load`
  // and `remove` alone; copying allocates nothing.
  uint32_t keptSize() const noexcept;
  void copyKept(std::span<uint8_t> image) const noexcept;
  // Takes the contents of an image, and there are no marks of changes then. False where it is not one, or tables were
  // loaded from other files since: these stay as they are. An empty image changes no contents.
  bool restoreKept(std::span<const uint8_t> image) noexcept;
  // A power-up: nothing has been changed yet.
  void forgetChanges() noexcept;

private:
  TableError find(uint32_t table, uint32_t line, uint32_t column, ColumnType type,
                  const uint8_t*& element) const noexcept;
  TableError findToSet(uint32_t table, uint32_t line, uint32_t column, ColumnType type, uint8_t*& element) noexcept;
  TableError store(uint32_t table, std::span<const uint8_t> text, uint8_t* element) noexcept;
  template <class Value>
  std::string editAny(uint32_t table, uint32_t line, std::string_view column, Value value);
  uint64_t memoryWithout(uint32_t table) const;

  std::array<std::unique_ptr<PlcTable>, kTables> tables_;
};

} // namespace rung::io
