// Tables of the simulated CNC.
#include "sim/pmc/tables.h"

#include <algorithm>

#include "sim/pmc/machine.h"

namespace rung::sim::pmc {

// An axis parameter without a value has that of the first axis.
int64_t Tables::defaultOf(uint32_t parameter) const {
  const auto found = std::ranges::find(cnc_->defaults, parameter, &ParameterDefault::number);
  return found == cnc_->defaults.end() ? 0 : found->value;
}

int64_t Tables::get(Table table, uint32_t number, uint32_t attribute) const {
  const auto found = cells_.find({table, number, attribute});
  if (found != cells_.end()) return found->second;
  if (table == Table::Parameter && attribute != 0 && number != numbers().plcGroup) return get(table, number);
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

// Macro variables: interface variables are signals (GSK: Tables 10-1, 10-2, l.9081-9150), others are cells of the
// table. Values are in 0.0001.

namespace {

constexpr uint32_t kInputs = 1000;
constexpr uint32_t kOutputs = 1100;
constexpr uint32_t kBits = 32;

bool isInterface(const InterfaceVariables& variables, uint32_t number, uint32_t first) {
  return number >= first && number < first + kBits + variables.fieldCount;
}

} // namespace

bool Machine::isMacro(uint32_t number) const {
  return (number >= 100 && number <= 999) || isInterface(cnc->inputs, number, kInputs) ||
         isInterface(cnc->outputs, number, kOutputs);
}

int64_t Machine::macro(uint32_t number, const nc::pmc::SignalsIo& io) const {
  const bool input = isInterface(cnc->inputs, number, kInputs);
  if (!input && !isInterface(cnc->outputs, number, kOutputs)) return tables.get(Table::Macro, number);
  const InterfaceVariables& variables = input ? cnc->inputs : cnc->outputs;
  const uint32_t index = number - (input ? kInputs : kOutputs);
  if (index < kBits) {
    const uint16_t byte = variables.bits[index / 8];
    return kTableScale * static_cast<int64_t>(input ? io.g(byte, index % 8) : io.f(byte, index % 8));
  }
  const uint16_t byte = variables.fields[index - kBits];
  return kTableScale * static_cast<int64_t>(static_cast<int32_t>(input ? io.gDword(byte) : io.fDword(byte)));
}

void Machine::setMacro(uint32_t number, int64_t value, const nc::pmc::SignalsIo& io) {
  if (isInterface(cnc->inputs, number, kInputs)) return; // written by the PLC
  if (!isInterface(cnc->outputs, number, kOutputs)) {
    tables.set(Table::Macro, number, 0, value);
    return;
  }
  const uint32_t index = number - kOutputs;
  if (index < kBits)
    io.setF(cnc->outputs.bits[index / 8], index % 8, value != 0);
  else
    io.setFDword(cnc->outputs.fields[index - kBits], static_cast<uint32_t>(value / kTableScale));
}

} // namespace rung::sim::pmc
