// A request to a device of the control (rtlib/nc/technol/services.h) as operations: its arguments, its results, and the
// bytes that its answer brings.
#pragma once

#include <string>
#include <vector>

#include "frontend/dialects/technol/lower/areas.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

// What the data operand of a service holds. Binary: as many bytes as there is room for; Bytes: as many as another
// operand says.
enum class DataForm : uint8_t { None, Integer, Real, Text, Binary, Bytes };

class DeviceRequest {
public:
  // Of the current statement; the second one where its mnemonic has several services.
  explicit DeviceRequest(Lowering& context);
  DeviceRequest(Lowering& context, nc::technol::ServiceKind kind)
      : DeviceRequest(context, nc::technol::deviceService(kind)) {}

  // The next argument, i64. Gives it.
  ir::ValueId add(ir::ValueId value);
  // An operand that is a number, a bit or a word; not given: nc::technol::kNotGiven. `guard` as for Memory::reach.
  ir::ValueId addOperand(uint32_t number, const Operand& operand, ir::ValueId guard = {});
  // Gives the ticket.
  ir::ValueId send();
  // A result by its name; what the table says where there was no answer.
  ir::ValueId result(std::string_view name);
  ir::ValueId flag(std::string_view name); // as a bit
  ir::ValueId real(std::string_view name);
  // The request that was sent before.
  void use(ir::ValueId ticket);
  // Asks the control how far it is: one call for this and for all results that follow.
  ir::ValueId answered();
  // After `answered`: the control knows nothing of it any more, as the program has not asked for so long.
  ir::ValueId forgotten() const { return forgotten_; }

private:
  DeviceRequest(Lowering& context, const nc::technol::DeviceService& device) : l_(context), device_(device) {}

  Lowering& l_;
  const nc::technol::DeviceService& device_;
  std::vector<ir::ValueId> args_;
  ir::ValueId ticket_;
  ir::ValueId executed_;
  ir::ValueId forgotten_;
};

// The operand that says how many bytes of the data are meant; null where the row has none.
const Operand* lengthIn(std::span<const OperandInfo> infos, std::span<const Operand> operands);
// The argument for `count` bytes of an area, i32.
ir::ValueId bytesArgument(Emitter& emitter, const Area& area, ir::ValueId count);
// Puts the first `count` bytes of an answer, at most `most`, there.
void fetchBytes(Emitter& emitter, ir::ValueId ticket, const Area& to, ir::ValueId count, uint32_t most);

} // namespace rung::frontend::technol
