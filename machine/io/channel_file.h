// The devices described by the control's own channel file (control_files.h): its elements have the same attributes as
// the keys of the configuration. Attributes for other parts of the control are ignored.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "machine/host/control_files.h"

namespace rung::io {

// The devices to be configured.
class ConfiguredDevices {
public:
  // Returns "", or the error.
  virtual std::string set(std::string_view key, std::string_view value) = 0;
  // Number of drives on CAN so far.
  virtual uint32_t drives() const = 0;

protected:
  ~ConfiguredDevices() = default;
};

// Returns "", or the first error with its position.
std::string configureDevices(ConfiguredDevices& target, std::span<const host::DeviceDefinition> definitions);

} // namespace rung::io
