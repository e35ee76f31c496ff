// The drives.
#include "sim/nct/drives.h"

#include <cmath>

#include "rtlib/nc/config_key.h"
#include "rtlib/nc/nct/signals.h"
#include "sim/nct/axes.h"
#include "sim/nct/spindles.h"

namespace rung::sim::nct {

namespace {

constexpr int32_t kCurrent = 1;          // transmitted in units of 10 mA (l.4230)
constexpr double kPitch = 10;            // mm (degrees) per revolution of an axis motor
constexpr double kRatedSpeed = 3000;     // 1/min, at 100 % load
constexpr double kRatedCurrent = 10;     // A
constexpr double kRatedPower = 5;        // kW
constexpr double kBusVoltage = 560;      // V
constexpr double kMotorTemperature = 40; // °C

// Limits of a datum of the motor: the manual has code 82, but no limits.
struct Limits {
  int32_t least, most;
};
constexpr Limits kLimits[kDriveData] = {{-100'000, 100'000}, {-100'000, 100'000}, {-1000, 1000},
                                        {0, 2000},           {-273, 1000},        {-1000, 1000}};

} // namespace

// Whether an axis or a spindle has the drive of this address (N0501, N0601).
bool Drives::addressed(uint32_t drive) const {
  const Parameters& parameters = *links().parameters;
  for (uint32_t i = 0; i < nc::nct::kAxes; ++i)
    if (static_cast<uint32_t>(parameters.dword(axisAddress_, i)) == drive) return true;
  for (uint32_t i = 0; i < nc::nct::kSpindles; ++i)
    if (static_cast<uint32_t>(parameters.dword(spindleAddress_, i)) == drive) return true;
  return false;
}

void Drives::readAddresses() {
  if (revision_ == links().parameters->revision()) return;
  revision_ = links().parameters->revision();
  for (uint32_t i = 0; i < kDrives; ++i) addressed_[i] = addressed(i + 1);
  seen_.forget();
}

double Drives::speed(uint32_t drive) const {
  const Parameters& parameters = *links().parameters;
  for (uint32_t i = 0; i < nc::nct::kAxes; ++i)
    if (static_cast<uint32_t>(parameters.dword(axisAddress_, i)) == drive)
      return links().axes->velocity(i) * 60 / kPitch;
  for (uint32_t i = 0; i < nc::nct::kSpindles; ++i)
    if (static_cast<uint32_t>(parameters.dword(spindleAddress_, i)) == drive) return links().spindles->speed(i);
  return 0;
}

double Drives::datum(uint32_t drive, uint32_t datum) const {
  if (drive < 1 || drive > kDrives || datum >= kDriveData) return 0;
  const Drive& state = drives_[drive - 1];
  if (state.isGiven[datum]) return state.given[datum];
  if (!addressed(drive)) return 0;
  const double now = speed(drive);
  const double load = std::abs(now) / kRatedSpeed;
  switch (datum) {
  case 0: return now;
  case 1: return load * kRatedCurrent;
  case 2: return load * 100;
  case 3: return kBusVoltage;
  case 4: return kMotorTemperature;
  default: return load * kRatedPower;
  }
}

// ---- MW 81 -------------------------------------------------------------------------------------------------------

bool Drives::serves(bool write, uint32_t function) const { return write && function == 81; }

std::optional<int32_t> Drives::service(uint32_t, Block& block) {
  if (block.amount() != 3) return 2;
  const int32_t drive = block.word(2);
  const int32_t datum = block.word(3);
  const int32_t value = block.word(4);
  if (drive < 1 || drive > static_cast<int32_t>(kDrives) || !addressed(static_cast<uint32_t>(drive))) return 80;
  if (datum < 0 || datum >= static_cast<int32_t>(kDriveData)) return 81;
  if (value < kLimits[datum].least || value > kLimits[datum].most) return 82;
  Drive& state = drives_[static_cast<size_t>(drive) - 1];
  state.given[static_cast<size_t>(datum)] = datum == kCurrent ? value / 100.0 : value;
  state.isGiven[static_cast<size_t>(datum)] = true;
  return 0;
}

// ---- signals, events ---------------------------------------------------------------------------------------------

// The drive is enabled while DP_ENA1=0 and DP_ENA2=1 (l.7240-7250); an error resets DN_RDY until DP_ERRCLR.
void Drives::timeSlice() {
  readAddresses();
  const SignalMemory& signals = links().signals;
  if (seen_.areSame(signals)) return;
  for (uint32_t i = 0; i < kDrives; ++i) {
    Drive& drive = drives_[i];
    const uint32_t asked = signals.wordOf(enable1_, i);
    if (clearError_.in(asked)) drive.errors = 0;
    const bool ready = drive.errors == 0 && addressed_[i];
    signals.set(errors_, i, static_cast<int32_t>(drive.errors));
    signals.setBits(ready_, i, written_,
                    ready_.as(ready) | enabled_.as(ready && !enable1_.in(asked) && enable2_.in(asked)) |
                        activeTable1_.as(table1_.in(asked)) | activeTable2_.as(table2_.in(asked)));
  }
  seen_.see(signals);
}

Handled Drives::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey(name, keys, {"address", "error"}); !wrong.empty()) return wrong;
  const int64_t address = integerKey(keys, "address", 0);
  const int64_t error = integerKey(keys, "error", -1);
  if (address < 1 || address > kDrives || error < 0 || error > 0xFFFFFFFF)
    return "event drive takes address=1 to 48 and error=BITS of DN_ERR";
  drives_[static_cast<size_t>(address) - 1].errors = error == 0 ? 0 : static_cast<uint32_t>(error) | 1; // DN_ERROR
  seen_.forget();
  return "";
}

std::optional<double> Drives::quantity(std::string_view name) const {
  const auto key = numbersAfter(name, "DRIVE.");
  if (!key || key->size() != 2 || (*key)[0] < 1 || (*key)[0] > kDrives || (*key)[1] >= kDriveData) return std::nullopt;
  return datum((*key)[0], (*key)[1]);
}

void Drives::powerOn(nc::PowerOn) {
  drives_ = {};
  seen_.forget();
}

// Inputs that follow outputs.

// Parses NAME, or NAME.BB for a bit of a double word, with an optional ,#INDEX.
std::optional<Wiring::Place> Wiring::place(std::string_view name) {
  const size_t comma = std::min(name.find(",#"), name.size());
  const auto index =
      comma == name.size() ? std::optional<uint32_t>(0) : text::numberIn<uint32_t>(name.substr(comma + 2));
  name = name.substr(0, comma);
  const size_t dot = std::min(name.find('.'), name.size());
  const nc::Signal* signal = findSignal(nc::nctSignals(), name.substr(0, dot));
  const bool isBit = signal != nullptr && signal->type == nc::SignalType::Bit;
  const auto bit = dot == name.size() ? std::optional<uint32_t>(isBit ? signal->bit : 32)
                                      : text::numberIn<uint32_t>(name.substr(dot + 1));
  if (signal == nullptr || !index || *index >= signal->count || !bit || *bit > 31) return std::nullopt;
  if (isBit != (dot == name.size()) || signal->type == nc::SignalType::Real) return std::nullopt;
  return Place{(signal->byteOffset + *index * signal->strideBytes) / 4, *bit};
}

Handled Wiring::config(std::string_view key, std::string_view value) {
  constexpr std::string_view kPrefix = "follow.";
  if (!key.starts_with(kPrefix)) return std::nullopt;
  Wire wire;
  const auto input = place(key.substr(kPrefix.size()));
  const size_t at = std::min(value.find('@'), value.size());
  wire.inverted = value.starts_with('/');
  const auto source = place(value.substr(wire.inverted ? 1 : 0, at - (wire.inverted ? 1 : 0)));
  wire.delayUs = at == value.size() ? 0 : nc::durationUs(value.substr(at + 1));
  if (!input) return std::string(key) + ": expected the bit of a signal after 'follow.'";
  if (!source || wire.delayUs < 0)
    return std::string(key) + ": expected a bit such as OUT010.00, /OUT010.00 or OUT010.00@100ms, found '" +
           std::string(value) + "'";
  wire.input = *input;
  wire.source = *source;
  wires_.push_back(wire);
  return "";
}

// At power-on all wires are in a steady state.
void Wiring::powerOn(nc::PowerOn) {
  for (Wire& wire : wires_) {
    wire.level = links().signals.bit(wire.source.word, wire.source.bit);
    wire.sinceUs = links().nowUs - wire.delayUs;
    links().signals.setBit(wire.input.word, wire.input.bit, wire.level != wire.inverted);
  }
}

void Wiring::timeSlice() {
  const SignalMemory& signals = links().signals;
  for (Wire& wire : wires_) {
    const bool level = signals.bit(wire.source.word, wire.source.bit);
    if (level != wire.level) {
      wire.level = level;
      wire.sinceUs = links().nowUs;
    }
    if (links().nowUs - wire.sinceUs >= wire.delayUs)
      signals.setBit(wire.input.word, wire.input.bit, level != wire.inverted);
  }
}

} // namespace rung::sim::nct
