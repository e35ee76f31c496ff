// Presets of the interface (see presets.h).
#include "frontend/dialects/technol/lower/presets.h"

#include <string>

#include "frontend/dialects/technol/read/symbols.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {
namespace {

struct Preset {
  std::string_view signal;
  uint16_t value;
};
constexpr Preset kPowerOn[] = {
    {"EN_AUTMAN", 1},               // man. l.6372, l.10879
    {"FEED_OVR_MULTIPLIER", 1000},  // man. l.6555
    {"SPEED_OVR_MULTIPLIER", 1000}, // man. l.6592
    {"NLCSERVOENABLE", 0xFFFF},     // man. l.6667
    {"SHIFT_ENABLE", 0x3F},         // man. l.11122
};

// Bits that are 1 at a start (man. l.6186, l.6316); `#` is the number of an axis.
constexpr std::string_view kStart[] = {"MPXPI", "MPYPI", "MPZPI", "VAZBA_X", "VAZBA_Y", "VAZBA_Z"};
constexpr std::string_view kStartOfAxes[] = {"MP#PI", "VAZBA_#"};
constexpr int kFirstNumbered = 4, kLastAxis = 16;

const nc::Signal* signalOf(std::string_view name) { return nc::findSignal(nc::technolSignals(), name, "I"); }

void setBit(ir::RungBuilder& b, std::string_view name, ir::ValueId one) {
  if (const nc::Signal* signal = signalOf(name))
    b.store({.space = kInterfaceSpace, .byte = signal->byteOffset, .bit = signal->bit}, one);
}

} // namespace

void addPowerOnPresets(ir::Module& module) {
  for (const Preset& preset : kPowerOn) {
    const nc::Signal* signal = signalOf(preset.signal);
    if (signal == nullptr) continue;
    const uint32_t value = static_cast<uint32_t>(preset.value)
                           << (signal->type == nc::SignalType::Bit ? signal->bit : 0);
    std::vector<uint8_t> data{static_cast<uint8_t>(value)};
    if (signal->type == nc::SignalType::Word) data.push_back(static_cast<uint8_t>(value >> 8));
    module.inits.push_back({.space = kInterfaceSpace, .byte = signal->byteOffset, .data = std::move(data)});
  }
}

void storeStartPresets(ir::RungBuilder& b) {
  const ir::ValueId one = b.bit(true);
  for (const std::string_view name : kStart) setBit(b, name, one);
  for (const std::string_view pattern : kStartOfAxes)
    for (int axis = kFirstNumbered; axis <= kLastAxis; ++axis) {
      std::string name(pattern);
      setBit(b, name.replace(name.find('#'), 1, std::to_string(axis)), one);
    }
}

} // namespace rung::frontend::technol
