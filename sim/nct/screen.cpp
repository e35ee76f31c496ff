// MW 70 (see screen.h).
#include "sim/nct/screen.h"

#include "rtlib/nc/nct/parameters.h"
#include "rtlib/nc/nct/windows.h"

namespace rung::sim::nct {

bool Screen::serves(bool write, uint32_t function) const { return write && function == 70; }

// A parameter that the amount leaves out is 0. No execution code is there for a parameter of a wrong value.
std::optional<int32_t> Screen::service(uint32_t, Block& block) {
  const int32_t amount = block.amount();
  if (amount < 2 || amount > 4) return 2;
  if (block.word(3) < 0 || block.word(3) > static_cast<int32_t>(nc::nct::kChannels)) return 6;
  if (nc::nct::findScreenWindow(block.word(2)) == nullptr) return 70;
  if (!connected_) return 71;
  window_ = {block.word(2), block.word(3), amount >= 3 ? block.word(4) : 0, amount >= 4 ? block.word(5) : 0};
  return 0;
}

Handled Screen::config(std::string_view key, std::string_view value) {
  if (key != "display") return std::nullopt;
  configured_ = value == "on";
  return "";
}

Handled Screen::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey(name, keys, {"on"}); !wrong.empty()) return wrong;
  if (findKey(keys, "on") == nullptr) return "event display takes on=0 or on=1";
  connected_ = integerKey(keys, "on", 1) != 0;
  return "";
}

std::optional<double> Screen::quantity(std::string_view name) const {
  if (name == "WINDOW") return window_[0];
  if (name == "WINDOW.CHANNEL") return window_[1];
  if (name == "WINDOW.P1") return window_[2];
  if (name == "WINDOW.P2") return window_[3];
  return std::nullopt;
}

void Screen::powerOn(nc::PowerOn) {
  connected_ = configured_;
  window_ = {};
}

} // namespace rung::sim::nct
