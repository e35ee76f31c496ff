// Logical inputs and outputs of the modules that the control does not simulate (man. ch. 27.2-27.4): real-time manager
// (RTM), EtherCAT (ECAT), virtual keyboard (VKeyboard). Each is a cell that keeps what is put into it; a scenario plays
// the module by these names.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rtlib/nc/technol/exchange.h"
#include "tools/sim/simulated_nc.h"

namespace rung::sim::technol {

struct ModuleElement {
  std::string key; // one an element, whichever way it is written
  nc::ExchangeType type = nc::ExchangeType::Bit;
  bool typeIsOpen = false; // EtherCAT: the type is that of the other end
  nc::ExchangePeriod period = nc::ExchangePeriod::Fast;
  bool isSource = true, isDestination = true;
};

// By a canonical identifier, without `.Bit[k]`. Nothing: there is no such element; `problem` says why where the module
// is known.
std::optional<ModuleElement> moduleElement(std::string_view identifier, std::string& problem);

struct ModuleCell {
  nc::ExchangeType type = nc::ExchangeType::Bit;
  bool typeIsOpen = false;
  uint64_t bits = 0; // of the type; a bit is 0 or 1
};

class ModuleCells {
public:
  void reset(); // all cells 0
  // Cells stay where they are while a table of connections holds their numbers.
  uint32_t cellOf(const ModuleElement& element);
  ModuleCell& at(uint32_t cell) { return cells_[cell]; }
  const ModuleCell& at(uint32_t cell) const { return cells_[cell]; }

  // By any identifier. Nothing: no such element.
  std::optional<NcCell> read(std::string_view name) const;
  bool write(std::string_view name, const NcCell& value);

private:
  std::vector<ModuleCell> cells_;
  std::unordered_map<std::string, uint32_t> byKey_;
};

} // namespace rung::sim::technol
