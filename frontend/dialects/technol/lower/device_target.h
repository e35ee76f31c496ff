// Data that a program gives to a device or gets from one: a cell, a text or bytes at an address, in the form that the
// instruction asks for (inventory of the services, 1.4, 3).
#pragma once

#include "frontend/dialects/technol/lower/device_request.h"

namespace rung::frontend::technol {

class DeviceTarget {
public:
  DeviceTarget() = default; // not given
  // An index that leads outside the memory stops the program, where `guard` is 1.
  DeviceTarget(Lowering& context, const Operand& operand, ir::ValueId guard);
  bool given() const { return l_ != nullptr; }

  // The place by the index of the run in which `when` is 1, in later runs too, also of another program that has the
  // variable elsewhere.
  void keep(ir::ValueId when);
  // Bytes from there on, i32: of a text without its terminator, and with it.
  ir::ValueId room() const;
  ir::ValueId roomWithEnd() const;

  // Where fewer bytes than the form needs are there, the program stops; fixed places are checked before.
  void require(DataForm form, ir::ValueId guard) const;

  // As the next argument; `count` of bytes, i32.
  void addTo(DeviceRequest& request, DataForm form, ir::ValueId count) const;
  // The first word there as the next argument.
  void addWord(DeviceRequest& request) const;
  // Becomes the result of this name.
  void take(DeviceRequest& request, ir::ValueId ticket, std::string_view name, DataForm form) const;

private:
  uint32_t terminator() const { return operand_->isText ? 1 : 0; }
  // Bytes that it has at most.
  uint32_t most() const;
  // Its own type; None: bytes.
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
