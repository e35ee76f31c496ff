// What every lowering adds to a module.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "ir/core/builder.h"
#include "ir/support/source.h"
#include "rtlib/nc/service.h"

namespace rung::frontend {

ir::SpaceId addSpace(ir::Module& module, ir::Space space);
ir::SlotId addSlot(ir::Module& module, ir::Slot slot);
ir::RoutineId addRoutine(ir::Module& module, std::string name);
// The sources in their order; gives where each is, by its FileId.
std::unordered_map<uint32_t, ir::FileIndex> addFiles(ir::Module& module, const SourceManager& sources,
                                                     std::span<const FileId> files);
// A hidden symbol: cells that are found by their name in a changed program, or by the host.
void nameCells(ir::Module& module, std::string name, ir::Place place, ir::Type type, uint32_t count = 1);
// Once all are there: by name, with comments as readers are to see them.
void settleSymbols(ir::Module& module);

// Each is in the module once, however often it is asked for.
ir::ServiceId service(ir::Module& module, const nc::ServiceRow& row);
ir::FaultId fault(ir::Module& module, std::string_view text);

// Keys of what is otherwise alike: the second has "~1" after it (rung_slot in rung/program.h).
class Numbering {
public:
  std::string numbered(std::string key);

private:
  std::unordered_map<std::string, uint32_t> alike_;
};

// Hidden spaces that hold bytes, each text of bytes once. The name says what they are, so that a program that is
// exchanged while it runs finds its own.
class ConstantBytes {
public:
  explicit ConstantBytes(ir::Module& module) : module_(module) {}

  ir::SpaceId spaceOf(std::string_view bytes);

private:
  ir::Module& module_;
  std::unordered_map<std::string, ir::SpaceId> spaces_; // by their bytes
  Numbering names_;
};

} // namespace rung::frontend
