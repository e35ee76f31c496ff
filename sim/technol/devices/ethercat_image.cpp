// Process image (see ethercat_image.h).
#include "sim/technol/devices/ethercat_image.h"

#include <algorithm>

#include "rtlib/nc/control/technol/identifier.h"
#include "rung/program.h"

namespace rung::sim::technol {
namespace {

// The one way to write it. In keys of the configuration a blank is written `_`.
std::string nameOf(std::string_view text) {
  std::string name = nc::technol::canonical(text);
  std::ranges::replace(name, '_', ' ');
  return name;
}

} // namespace

void EthercatImage::add(uint32_t slave, bool isInput, std::string_view name, uint32_t object) {
  Entry made{.slave = slave, .isInput = isInput, .name = nameOf(name), .object = object};
  for (Entry& entry : entries_)
    if (entry.slave == slave && entry.isInput == isInput && entry.name == made.name) {
      entry = std::move(made);
      return;
    }
  entries_.push_back(std::move(made));
}

// Names may contain dots; so whole identifiers are compared.
uint32_t EthercatImage::find(std::string_view identifier) const {
  const std::string wanted = nameOf(identifier);
  for (uint32_t i = 0; i < count(); ++i) {
    const Entry& entry = entries_[i];
    const std::string group = entry.isInput ? ".INPUTS." : ".OUTPUTS.";
    const std::string& slave = slaves_[entry.slave].name;
    if (!slave.empty() && wanted == "ECAT." + nameOf(slave) + group + entry.name) return i;
  }
  return RUNG_NONE;
}

bool EthercatImage::isOfSlave(std::string_view identifier) const {
  const std::string wanted = nameOf(identifier);
  for (uint32_t i = 0; i < slaves_.count(); ++i) {
    const std::string slave = "ECAT." + nameOf(slaves_[i].name) + ".";
    if (!slaves_[i].name.empty() && (wanted.starts_with(slave + "INPUTS.") || wanted.starts_with(slave + "OUTPUTS.")))
      return true;
  }
  return false;
}

void EthercatImage::write(uint32_t entry, uint64_t value) {
  if (entries_[entry].isInput) return;
  entries_[entry].value = value & onesOf(bytesOf(entry));
  entries_[entry].isWritten = true;
}

bool EthercatImage::isExchanged(uint32_t entry) const {
  const Entry& found = entries_[entry];
  return found.isInput ? states_.givesInputs(found.slave) : states_.takesOutputs(found.slave);
}

void EthercatImage::powerOn() {
  for (Entry& entry : entries_) {
    entry.value = 0;
    entry.isWritten = false;
  }
}

// An output that nobody has written leaves its object as the mailbox or the configuration has set it.
void EthercatImage::putOutputs() {
  for (uint32_t i = 0; i < count(); ++i)
    if (entries_[i].isWritten && isExchanged(i)) slaves_.objectAt(entries_[i].object).value = entries_[i].value;
}

void EthercatImage::takeInputs() {
  for (uint32_t i = 0; i < count(); ++i)
    if (entries_[i].isInput && isExchanged(i)) entries_[i].value = slaves_.objectAt(entries_[i].object).value;
}

} // namespace rung::sim::technol
