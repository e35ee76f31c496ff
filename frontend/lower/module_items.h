// Items that every lowering adds to a module.
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
// Adds the sources in their order; returns the index of each, by its FileId.
std::unordered_map<uint32_t, ir::FileIndex> addFiles(ir::Module& module, const SourceManager& sources,
                                                     std::span<const FileId> files);
// A hidden symbol: cells that the host finds by name, or that are matched by name in a changed program.
void nameCells(ir::Module& module, std::string name, ir::Place place, ir::Type type, uint32_t count = 1);
// Called after all symbols have been added: sorts them by name, with comments for display.
void settleSymbols(ir::Module& module);

// Each is added to the module once, on first use.
ir::ServiceId service(ir::Module& module, const nc::ServiceRow& row);
ir::FaultId fault(ir::Module& module, std::string_view text);

// Distinguishes equal keys: the second gets the suffix "~1" (rung_slot in rung/program.h).
class Numbering {
public:
  std::string numbered(std::string key);
  // The key without its number.
  static std::string withoutNumber(const std::string& numbered) { return numbered.substr(0, numbered.rfind('~')); }

private:
  std::unordered_map<std::string, uint32_t> alike_;
};

// Hidden spaces with constant bytes, each sequence of bytes once. The name describes the bytes, so that a replacement
// program finds its own.
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
