// The module under construction, and the routine that is open in it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frontend/dialects/technol/lower/host_cells.h"
#include "frontend/dialects/technol/lower/routine_builder.h"
#include "frontend/lower/module_items.h"
#include "ir/core/marks.h"
#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

class Emitter {
public:
  // `given` may be null: the module is not compared with another.
  Emitter(ir::Module& module, ir::GivenNumbers* given)
      : module_(module), given_(given), constants_(module), registers_(makeRegisterSlots(module)) {}

  ir::Module& module() { return module_; }
  ir::RungBuilder& b() { return out().b(); }
  Registers& r() { return out().registers(); }
  RoutineBuilder& out() { return *open_.back(); }

  ir::RoutineId newRoutine(std::string name) { return addRoutine(module_, std::move(name)); }
  // Opens a routine; the one that was open continues when the new one is closed.
  void open(ir::RoutineId routine);
  // Returns the routine's weight.
  uint64_t close();

  ir::SlotId newSlot(ir::Type type, std::string key, bool transient = false) {
    return addSlot(module_, {.type = type, .transient = transient, .key = std::move(key)});
  }
  // Stores 0, in separate rungs.
  void clearSlots(std::span<const ir::SlotId> slots);
  ir::FaultId fault(std::string_view text) { return frontend::fault(module_, text); }
  ir::ServiceId service(nc::technol::ServiceKind kind) {
    return frontend::service(module_, nc::technol::deviceService(kind).service);
  }
  // A hidden space with these bytes.
  ir::SpaceId constantBytes(std::string_view bytes) { return constants_.spaceOf(bytes); }
  // A constant that the program's author did not write: a line, the size or the number of a space.
  ir::ValueId given(ir::Type type, int64_t value) { return given(type, value, {}); }
  // A constant that is an address, `distance` bytes after the beginning of a variable.
  ir::ValueId address(ir::Type type, int64_t value, ir::Place begin, int64_t distance = 0);
  // The number of a routine.
  ir::ValueId routine(ir::Type type, int64_t value, ir::RoutineId routine);
  bool isCompared() const { return given_ != nullptr; }
  // Stops the program if `bad` is 1: an access outside of the memory.
  void protect(ir::ValueId bad);

private:
  ir::ValueId given(ir::Type type, int64_t value, ir::GivenNumber number);

  ir::Module& module_;
  ir::GivenNumbers* const given_;
  ConstantBytes constants_;
  RegisterSlots registers_;
  std::vector<std::unique_ptr<RoutineBuilder>> open_; // the innermost last
};

inline ir::Place place(HostCell cell) { return {.space = kRegisterSpace, .byte = hostCell(cell).byte}; }

} // namespace rung::frontend::technol
