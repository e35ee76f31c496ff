// Tables of the simulated CNC.
#include "sim/gsk/tables.h"

#include "sim/gsk/machine.h"

namespace rung::sim::gsk {

namespace {

// The default values of parameters. An axis parameter without a value has that of the first axis.
int64_t defaultOf(uint32_t parameter) {
  switch (parameter) {
  case kParamDryRun: return 3000;
  case kParamRapid: return 12000;
  case kParamRapidF0: return 600;
  case kParamReturn: return 6000;
  case kParamSafeFeed: return 3000;
  case kParamGearSpeed: return 50;
  case kParamMaxSpindle: return 6000;
  case kParamPlcMaxSpeed: return 12000;
  default: return 0;
  }
}

} // namespace

int64_t Tables::get(Table table, uint32_t number, uint32_t attribute) const {
  const auto found = cells_.find({table, number, attribute});
  if (found != cells_.end()) return found->second;
  if (table == Table::Parameter && attribute != 0 && number != kParamPlcGroup) return get(table, number);
  return table == Table::Parameter ? defaultOf(number) * kTableScale : 0;
}

void Tables::set(Table table, uint32_t number, uint32_t attribute, int64_t value) {
  cells_.insert_or_assign(Key{table, number, attribute}, value);
}

double Tables::parameterReal(uint32_t number, uint32_t axis) const {
  return static_cast<double>(get(Table::Parameter, number, axis)) / static_cast<double>(kTableScale);
}

int64_t Tables::parameter(uint32_t number, uint32_t axis) const {
  return static_cast<int64_t>(parameterReal(number, axis));
}

void Tables::clearVolatile() {
  cells_.erase(cells_.lower_bound({Table::Macro, 100, 0}), cells_.lower_bound({Table::Macro, 200, 0}));
}

// Macro variables: interface variables are signals (man. Tables 10-1, 10-2, l.9081-9150), others are cells of the
// table. Values are in 0.0001.

namespace {

// From #1000 or #1100 on: 32 bits, then four fields of 32 bits.
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
  if (isInterface(number, kInputs)) return; // written by the PLC
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
