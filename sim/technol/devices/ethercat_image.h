// The process image of the simulated EtherCAT net (TECHNOL manual 26.2, l.17763-17786, l.17872-17904): entries of the
// slaves that connections name ECAT.<slave>.Inputs.<entry> and ECAT.<slave>.Outputs.<entry>, each bound to an object.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sim/technol/devices/ethercat_states.h"

namespace rung::sim::technol {

class EthercatImage {
public:
  struct Entry {
    uint32_t slave = 0;
    bool isInput = false; // what the slave gives
    std::string name;     // as nameOf makes it
    uint32_t object = 0;  // its number among those of the slaves
    uint64_t value = 0;
    bool isWritten = false; // since the power-on, of an output
  };

  EthercatImage(EthercatSlaves& slaves, const EthercatStates& states) : slaves_(slaves), states_(states) {}

  // Configuration; a later entry of the same name takes its place.
  void add(uint32_t slave, bool isInput, std::string_view name, uint32_t object);
  // By the identifier of a connection, in any case, with `_` or a blank. RUNG_NONE: there is none.
  uint32_t find(std::string_view identifier) const;
  // The identifier names process data of a slave that has a name, whether or not that entry exists.
  bool isOfSlave(std::string_view identifier) const;
  uint32_t count() const { return static_cast<uint32_t>(entries_.size()); }
  const Entry& operator[](uint32_t entry) const { return entries_[entry]; }
  uint32_t bytesOf(uint32_t entry) const { return slaves_.objectAt(entries_[entry].object).bytes; }
  // Inputs are as the slave has given them last; without exchange they stay. Outputs are as they were written.
  uint64_t read(uint32_t entry) const { return entries_[entry].value; }
  void write(uint32_t entry, uint64_t value);
  // Whether the slave exchanges it just now.
  bool isExchanged(uint32_t entry) const;

  void powerOn();
  // One millisecond: outputs go to their objects before the drives have worked, inputs come after it.
  void putOutputs();
  void takeInputs();

private:
  EthercatSlaves& slaves_;
  const EthercatStates& states_;
  std::vector<Entry> entries_;
};

} // namespace rung::sim::technol
