// The PLC tables of a control (man. ch. 17, l.18258-19170): at most 256, each with the columns of its definition,
// lines, a selected line, and marks of operator changes that the program has not yet asked for.
//
// The functions for requests of the program (PLCT_*) do not allocate, wait or throw: a table has room for its lines and
// texts from its loading on. The tables are used by one thread at a time; if a scan must not wait for files, requests
// are sent as tickets to the host's thread that accesses the files (l.18671: the instructions take several scans).
//
// Texts and IDs of columns are bytes as in the program's memory (Windows-1250), unless UTF-8 is stated.
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

// Values of DR after PLCT_*.
enum class TableError : uint8_t {
  None = 0,
  NoTable = 1,
  NoLine = 2,
  NoColumn = 3,
  OtherType = 4,      // the column has another type
  CannotBeStored = 5, // the text is too long, or a file could not contain the value (see setReal, setText)
};

// Results of PLCT_CHANGED (l.19007-19012).
enum class TableChange : uint8_t { None = 0, Element = 1, SelectedLine = 2 };

class PlcTables {
public:
  static constexpr uint32_t kTables = 256; // TabIdx is a BYTE (l.18716)
  // Number of lines that an operator may add to those of the file.
  static constexpr uint32_t kMoreLines = 256;
  static constexpr uint32_t kMostLines = io::kMostLines;
  // Number of bytes by which texts and binary elements of a table may grow beyond those of the file.
  static constexpr uint32_t kMoreTextBytes = 1u << 16;
  // Limit for all tables together: 65535 lines of 63 REALs.
  static constexpr uint64_t kMostBytes = uint64_t{1} << 25;

  // ---- configuration; allocates ----
  // Returns "", or the errors of the data, one line "FILE:LINE:COLUMN: ..." each; the table is then unchanged.
  std::string load(uint32_t table, const TableDefinition& definition, const TableData& data);
  void remove(uint32_t table); // the table no longer exists

  // ---- the program ----
  bool exists(uint32_t table) const noexcept { return table < kTables && tables_[table] != nullptr; }

  // Lines and columns count from 0 (l.18717-18719). After an error the result is unchanged. Texts and bytes are views
  // of the table, valid until its next change.
  TableError getInt(uint32_t table, uint32_t line, uint32_t column, int32_t& value) const noexcept;
  TableError getReal(uint32_t table, uint32_t line, uint32_t column, double& value) const noexcept;
  TableError getText(uint32_t table, uint32_t line, uint32_t column, std::string_view& text) const noexcept;
  TableError getBinary(uint32_t table, uint32_t line, uint32_t column, std::span<const uint8_t>& bytes) const noexcept;
  TableError setInt(uint32_t table, uint32_t line, uint32_t column, int32_t value) noexcept;
  // A value that is not finite cannot be stored.
  TableError setReal(uint32_t table, uint32_t line, uint32_t column, double value) noexcept;
  // Control characters except tab, CR and LF cannot be stored, because XML cannot represent them.
  TableError setText(uint32_t table, uint32_t line, uint32_t column, std::string_view text) noexcept;
  TableError setBinary(uint32_t table, uint32_t line, uint32_t column, std::span<const uint8_t> bytes) noexcept;

  // The comparison is exact.
  TableError columnIndex(uint32_t table, std::string_view id, uint32_t& column) const noexcept;
  TableError columnId(uint32_t table, uint32_t column, std::string_view& id) const noexcept;
  TableError columnType(uint32_t table, uint32_t column, ColumnType& type) const noexcept;
  // NoLine: the table has no lines (l.19130: "the line was not found").
  TableError selectedLine(uint32_t table, uint32_t& line) const noexcept;
  TableError select(uint32_t table, uint32_t line) noexcept;
  // Takes the oldest kind of change (elements before the selected line). Several changes of a kind count as one.
  TableError takeChange(uint32_t table, TableChange& change) noexcept;
  TableError lineCount(uint32_t table, uint32_t& count) const noexcept;

  // ---- the operator (editor, screens) and NC programs: "", or the error, in UTF-8. Not for the scan thread ----
  // `column` is an ID in UTF-8. Depending on the type of the column, the text is UTF-8, a number as in the file, or
  // pairs of hexadecimal digits. Every edit counts as a change, even if the value is the same.
  std::string edit(uint32_t table, uint32_t line, std::string_view column, std::string_view text);
  std::string edit(uint32_t table, uint32_t line, std::string_view column, double number);
  // Counts as a change if it is another line.
  std::string selectByOperator(uint32_t table, uint32_t line);
  std::string lineProblem(uint32_t table, uint32_t line) const; // "": the line exists
  std::string addLine(uint32_t table);                          // at the end; its elements are 0, 0.0, or empty
  // The lines after it move up. The selected line stays the same one; if it is removed, the next line is selected.
  std::string removeLine(uint32_t table, uint32_t line);

  // ---- storing ----
  // Whether the program or an operator has changed the table since the last `stored`.
  bool isDirty(uint32_t table) const noexcept { return exists(table) && tables_[table]->dirty; }
  void stored(uint32_t table) noexcept;
  // The contents for the table's file; nothing if there is no such table.
  std::optional<TableData> contents(uint32_t table) const;

  // All contents and selected lines, as an image for this process or the same machine. Only `load` and `remove` change
  // its size; copying allocates nothing.
  uint32_t retainedSize() const noexcept;
  void copyRetained(std::span<uint8_t> image) const noexcept;
  // Restores the contents of an image and clears the marks of changes. Returns false if it is not an image, or if some
  // tables were loaded from other files since; these stay unchanged. An empty image changes no contents.
  bool restoreRetained(std::span<const uint8_t> image) noexcept;
  // Power-up: clears the marks of changes.
  void forgetChanges() noexcept;

  // Contents, selected lines and marks, for the tables of the same files.
  template <class Archive>
  void state(Archive& archive) {
    for (const std::unique_ptr<PlcTable>& table : tables_) {
      bool isThere = table != nullptr;
      archive(isThere);
      archive.require(isThere == (table != nullptr));
      if (table) archive(*table);
    }
  }

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
