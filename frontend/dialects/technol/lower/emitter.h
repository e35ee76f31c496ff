// The module that is made, and the routine that is open in it.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/technol/lower/host_cells.h"
#include "frontend/dialects/technol/lower/routine_builder.h"

namespace rung::frontend::technol {

class Emitter {
public:
  explicit Emitter(ir::Module& module) : module_(module), registers_(makeRegisterSlots(module)) {}

  ir::Module& module() { return module_; }
  ir::RungBuilder& b() { return out().b(); }
  Registers& r() { return out().registers(); }
  RoutineBuilder& out() { return *open_.back(); }

  ir::RoutineId newRoutine(std::string name);
  // Opens a routine; the one that was open continues when it is closed.
  void open(ir::RoutineId routine);
  // Gives the routine's weight.
  uint64_t close();

  ir::SlotId newSlot(ir::Type type, std::string key, bool transient = false);
  // Stores 0, in rungs of their own.
  void clearSlots(std::span<const ir::SlotId> slots);
  ir::FaultId fault(std::string_view text);
  ir::ServiceId service(std::string_view signature);
  // A hidden space that holds the bytes.
  ir::SpaceId constantBytes(std::string_view bytes);
  // Stops the program where `bad` is 1: an access outside the memory.
  void protect(ir::ValueId bad);

private:
  ir::Module& module_;
  RegisterSlots registers_;
  std::vector<std::unique_ptr<RoutineBuilder>> open_; // the innermost last
  std::unordered_map<std::string, ir::FaultId> faults_;
  std::unordered_map<std::string, ir::SpaceId> constants_;
};

inline ir::Place place(HostCell cell) { return {.space = kRegisterSpace, .byte = hostCell(cell).byte}; }

} // namespace rung::frontend::technol
