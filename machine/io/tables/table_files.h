// The files of a control's PLC tables: which they are, reading them before the program runs, and writing those whose
// tables have changed. Blocks: for configuration and a thread of the host, never for a scan.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "machine/io/tables/plc_tables.h"

namespace rung::io {

class TableFiles {
public:
  // PlcTableDefN and PlcTableN of the control (l.18333, l.18418), N from 0 to 255; a later file of a number takes the
  // place of an earlier one. "" or what is wrong, a line "FILE:LINE:COLUMN: ..." each: then there is none of that
  // number.
  std::string setDefinition(uint32_t number, const std::string& path);
  std::string setTable(uint32_t number, const std::string& path);

  // After all files are set: makes the tables as the files had them when they were set, each by the definition whose ID
  // it names (l.18362). "" or what is wrong, a line each; the tables concerned do not exist then, and their files are
  // never written.
  std::string load(PlcTables& tables) const;

  // Writes the files of changed tables, where a second has passed since the last writing: each is the whole old or the
  // whole new one at any time, and the new one on disk. "" or what went wrong; it is then tried again.
  std::string save(PlcTables& tables, int64_t nowNs);
  // The same at a regular end: at once.
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
