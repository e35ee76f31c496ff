// Reads all files of one program, in this order: command lists before ladder text.
#pragma once
#include <memory>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/read/context.h"
#include "frontend/network/read/units.h"

namespace rung::frontend::network {

// Whether the file is ladder text; the others are command lists.
bool isLadder(const Language& language, const SourceManager& sources, FileId file);

class Reading {
public:
  Reading(Context& context, Program& program) : context_(context), units_(context, program) {}

  // `list`: the file, if it is open already.
  void add(FileId file, std::shared_ptr<const ListFile> list = nullptr);
  // True if all function commands were recognised.
  bool read();

  const std::vector<ladder::LadderFile>& ladders() const { return ladders_; }

private:
  Context& context_;
  UnitAssembler units_;
  std::vector<std::shared_ptr<const ListFile>> lists_;
  std::vector<ladder::LadderFile> ladders_;
  FileId last_;
};

} // namespace rung::frontend::network
