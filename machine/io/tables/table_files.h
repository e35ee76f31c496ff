// The files of a control's PLC tables: their paths, reading them before the program runs, and writing those of changed
// tables. Blocks: for the configuration and a thread of the host, never for the scan thread.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "machine/io/tables/plc_tables.h"

namespace rung::io {

class TableFiles {
public:
  // Sets PlcTableDefN and PlcTableN of the control (l.18333, l.18418), N from 0 to 255; a later file with the same
  // number replaces an earlier one. Returns "", or the errors, one line "FILE:LINE:COLUMN: ..." each; there is then no
  // file with that number.
  std::string setDefinition(uint32_t number, const std::string& path);
  std::string setTable(uint32_t number, const std::string& path);

  // To be called after all files are set: creates the tables with the contents that the files had when they were set,
  // each with the definition whose ID it names (l.18362). Returns "", or the errors, one line each; the tables
  // concerned do not exist then, and their files are never written.
  std::string load(PlcTables& tables) const;

  // Writes the files of changed tables if a second has passed since the last write. Each file is replaced atomically
  // and synced to disk. Returns "", or the error; the write is then repeated.
  std::string save(PlcTables& tables, int64_t nowNs);
  // The same without waiting for the second, for a regular end.
  std::string saveNow(PlcTables& tables) const;

private:
  static constexpr int64_t kBetweenSavesNs = 1'000'000'000;
  struct TableFile {
    std::string path;
    TableData data;
  };

  const TableDefinition* definitionOf(const TableData& data, std::string& wrong) const;
  std::string loadOne(PlcTables& tables, uint32_t number, const TableFile& file) const;

  std::map<uint32_t, TableDefinition> definitions_;
  std::map<uint32_t, TableFile> files_;
  int64_t nextSaveNs_ = INT64_MIN;
};

} // namespace rung::io
