// The devices that the control's own file of the channel describes (control_files.h): its elements have the attributes
// that keys of the configuration have. Attributes of other parts of the control are passed over.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "machine/host/control_files.h"

namespace rung::io {

// Whose devices are configured.
class ConfiguredDevices {
public:
  // "" or what is wrong.
  virtual std::string set(std::string_view key, std::string_view value) = 0;
  // Drives on CAN so far.
  virtual uint32_t drives() const = 0;

protected:
  ~ConfiguredDevices() = default;
};

// "" or what is wrong with one of them, with its place.
std::string configureDevices(ConfiguredDevices& target, std::span<const host::DeviceDefinition> definitions);

} // namespace rung::io
