// Data that a program sends to a device or receives from one: a cell, a text or bytes at an address, in the form of the
// instruction (inventory of the services, 1.4, 3).
#pragma once

#include "frontend/dialects/technol/lower/device_request.h"

namespace rung::frontend::technol {

class DeviceTarget {
public:
  DeviceTarget() = default; // not given
  // If `guard` is 1, an index outside of the memory stops the program.
  DeviceTarget(Lowering& context, const Operand& operand, ir::ValueId guard);
  bool given() const { return l_ != nullptr; }

  // Stores the index of the run in which `when` is 1 and uses it in later runs, too, even in another program that has
  // the variable elsewhere.
  void keep(ir::ValueId when);
  // Number of bytes to the end, i32: of a text without its terminator, and with it.
  ir::ValueId room() const;
  ir::ValueId roomWithEnd() const;

  // The program stops if there are fewer bytes than the form needs; fixed places have been checked before.
  void require(DataForm form, ir::ValueId guard) const;

  // Adds it as the next argument; `count` of bytes, i32.
  void addTo(DeviceRequest& request, DataForm form, ir::ValueId count) const;
  // Adds its first word as the next argument.
  void addWord(DeviceRequest& request) const;
  // Stores the result of this name.
  void take(DeviceRequest& request, ir::ValueId ticket, std::string_view name, DataForm form) const;

private:
  uint32_t terminator() const { return operand_->isText ? 1 : 0; }
  // Maximum number of bytes.
  uint32_t most() const;
  // The type of the cell; None: bytes.
  ir::Type cellType() const;
  ir::ValueId numberAt(ir::Type type) const;
  void put(ir::ValueId value, ir::Type type) const;
  void fetch(ir::ValueId ticket, ir::ValueId length, DataForm form) const;

  Lowering* l_ = nullptr;
  const Operand* operand_ = nullptr;
  MemoryAccess access_;
  Area area_;
};

} // namespace rung::frontend::technol
