// The CNC beside a GSK25i PLC: messages of the A area, machine inputs. Presets of timers and counters are the
// compiler's configuration: initial contents of T and C.
#include <charconv>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/model/nc_model.h"

namespace rung::nc {
namespace {

std::optional<uint32_t> number(std::string_view text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "tmr.3" with prefix "tmr." gives 3.
std::optional<uint32_t> numberBehind(std::string_view key, std::string_view prefix) {
  if (!key.starts_with(prefix)) return std::nullopt;
  return number(key.substr(prefix.size()));
}

class GskModel final : public NcModel {
public:
  std::string config(std::string_view key, std::string_view value) override {
    const auto amount = number(value);
    if (!amount) return "expected a number, found '" + std::string(value) + "'";
    if (numberBehind(key, "param.")) return setQuantity(key, *amount);
    return NcModel::config(key, value);
  }

  // X and F belong to the machine and the CNC: switching the PLC off and on does not change them (inventory §18).
  void powerOn(host::Instance& instance, PowerOn kind) override {
    const std::vector<uint8_t> machine = readArea(instance, "X");
    const std::vector<uint8_t> cnc = readArea(instance, "F");
    NcModel::powerOn(instance, kind);
    writeArea(instance, "X", machine);
    writeArea(instance, "F", cnc);
  }

  // Message number 8·byte + bit + 1 is shown while its A bit is 1 (P57).
  std::vector<ShownMessage> messages(const host::Instance& instance) const override {
    std::vector<ShownMessage> shown = board_.shown();
    const uint32_t area = host::findSpace(instance.program(), "A");
    if (area == RUNG_NONE) return shown;
    for (uint32_t bit = 0; bit < instance.program().spaces[area].byte_count * 8; ++bit) {
      if (instance.read(host::bitRef(area, bit / 8, bit % 8)) == 0) continue;
      const uint32_t message = bit + 1;
      shown.push_back({message, 0, 0, 0, false, std::string(host::messageText(instance.program(), message))});
    }
    return shown;
  }

protected:
  std::optional<host::Ref> signal(const host::Instance& instance, std::string_view name) const override {
    const Signal* found = findSignal(gskSignals(), name);
    if (found == nullptr) return std::nullopt;
    const uint32_t space = host::findSpace(instance.program(), found->area);
    if (found->type == SignalType::Bit) return host::bitRef(space, found->byteOffset, found->bit);
    const uint32_t bytes = elementBytes(found->type);
    if (bytes == 0) return std::nullopt;
    return host::intRef(space, found->byteOffset, bytes * 8);
  }

private:
  static std::vector<uint8_t> readArea(const host::Instance& instance, const char* area) {
    const uint32_t space = host::findSpace(instance.program(), area);
    std::vector<uint8_t> bytes(space == RUNG_NONE ? 0 : instance.program().spaces[space].byte_count);
    for (uint32_t i = 0; i < bytes.size(); ++i) bytes[i] = instance.memory().readByte(space, i);
    return bytes;
  }
  static void writeArea(host::Instance& instance, const char* area, const std::vector<uint8_t>& bytes) {
    const uint32_t space = host::findSpace(instance.program(), area);
    for (uint32_t i = 0; i < bytes.size(); ++i) instance.memory().writeByte(space, i, bytes[i]);
  }
};

} // namespace

std::unique_ptr<NcModel> makeGskModel() { return std::make_unique<GskModel>(); }

} // namespace rung::nc
