// Macro variables: the interface variables are the signals themselves (man. Tables 10-1, 10-2, l.9081-9150), the others
// are cells of the table. Values in 0.0001.
#include "sim/gsk/machine.h"

namespace rung::sim::gsk {
namespace {

// #1000 or #1100 and what follows: 32 bits, then four fields of 32 bits.
constexpr uint32_t kInputs = 1000;
constexpr uint32_t kOutputs = 1100;
constexpr uint32_t kFields[] = {54, 226, 230, 234}; // bytes of G and of F

bool isInterface(uint32_t number, uint32_t first) { return number >= first && number < first + 36; }

} // namespace

int64_t Machine::macro(uint32_t number, const nc::gsk::SignalsIo& io) const {
  const bool input = isInterface(number, kInputs);
  if (!input && !isInterface(number, kOutputs)) return tables.get(Table::Macro, number);
  const uint32_t index = number - (input ? kInputs : kOutputs);
  const uint32_t byte = kFields[index < 32 ? 0 : index - 32];
  const uint32_t field = input ? io.gDword(byte) : io.fDword(byte);
  return kTableScale * (index < 32 ? (field >> index) & 1 : static_cast<int64_t>(static_cast<int32_t>(field)));
}

void Machine::setMacro(uint32_t number, int64_t value, const nc::gsk::SignalsIo& io) {
  if (isInterface(number, kInputs)) return; // the PLC's
  if (!isInterface(number, kOutputs)) {
    tables.set(Table::Macro, number, 0, value);
    return;
  }
  const uint32_t index = number - kOutputs;
  if (index < 32)
    io.setF(54 + index / 8, index % 8, value != 0);
  else
    io.setFDword(kFields[index - 32], static_cast<uint32_t>(value / kTableScale));
}

} // namespace rung::sim::gsk
