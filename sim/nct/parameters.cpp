// The parameters of the control.
#include "sim/nct/parameters.h"

#include <cmath>
#include <cstdlib>

#include "sim/nct/channels.h"
#include "sim/nct/checksum.h"

namespace rung::sim::nct {

namespace {

constexpr uint32_t kReadDword = 31;
constexpr uint32_t kReadDouble = 32;
constexpr uint32_t kWriteDword = 34;
constexpr uint32_t kWriteDouble = 35;
constexpr uint32_t kFirstBits = 1201; // the PLC constants (man. 7.11)
constexpr uint32_t kFirstDword = 1209;
constexpr uint32_t kFirstDouble = 1241;

// The index of the first value of a parameter, in the order of the rows.
uint32_t firstOf(const nc::nct::ParameterRow& wanted, uint32_t number) {
  uint32_t first = 0;
  for (const nc::nct::ParameterRow& row : nc::nct::parameterRows()) {
    if (row.number == wanted.number) return first + (number - row.number) * valuesOf(row.index);
    first += row.numbers * valuesOf(row.index);
  }
  return first;
}

uint32_t bitOf(double value, uint32_t bit) { return (static_cast<uint32_t>(value) >> bit) & 1; }

} // namespace

ParameterPlace::ParameterPlace(uint32_t number) {
  const nc::nct::ParameterRow* row = nc::nct::findParameter(number);
  if (row == nullptr) std::abort(); // the numbers come from this code only
  first_ = firstOf(*row, number);
  count_ = valuesOf(row->index);
}

Parameters::Parameters(Links& links) : Topic(links) {
  for (const nc::nct::ParameterRow& row : nc::nct::parameterRows())
    initial_.insert(initial_.end(), size_t{row.numbers} * valuesOf(row.index), row.initial);
  for (char i = '0'; i < '8'; ++i)
    for (char j = '0'; j < '8'; ++j) constantBits_.emplace_back(std::string("N_P") + i + j);
  values_ = initial_;
  changed();
}

void Parameters::setInitial(uint32_t number, uint32_t index, double value) {
  const nc::nct::ParameterRow* row = nc::nct::findParameter(number);
  if (row != nullptr && index < valuesOf(row->index)) initial_[firstOf(*row, number) + index] = value;
}

uint32_t Parameters::checksum() const { return nct::checksum(std::span<const double>(values_)); }

void Parameters::changed() {
  checksum_ = checksum();
  ++revision_;
}

void Parameters::powerOn(nc::PowerOn kind) {
  if (kind == nc::PowerOn::Cold) {
    values_ = initial_;
    changed();
  }
  ++revision_; // retained values may have been restored
  writeConstants();
}

void Parameters::retain(Retained& retained) {
  retained.values(std::span<double>(values_));
  retained.value(checksum_);
}

// Writes N1201… to N_Pij, N_PDW1 and N_PDB1 (man. 7.11).
void Parameters::writeConstants() const {
  const SignalMemory& signals = links().signals;
  const uint32_t bits = firstOf(*nc::nct::findParameter(kFirstBits), kFirstBits);
  for (uint32_t i = 0; i < constantBits_.size(); ++i)
    signals.set(constantBits_[i], bitOf(values_[bits + i / 8], i % 8) != 0);
  const uint32_t dwords = firstOf(*nc::nct::findParameter(kFirstDword), kFirstDword);
  const uint32_t reals = firstOf(*nc::nct::findParameter(kFirstDouble), kFirstDouble);
  for (uint32_t i = 0; i < constantWords_.count(); ++i)
    signals.set(constantWords_, i, static_cast<int32_t>(values_[dwords + i]));
  for (uint32_t i = 0; i < constantReals_.count(); ++i) signals.set(constantReals_, i, values_[reals + i]);
}

// ---- MR 31, 32, MW 34, 35 ----------------------------------------------------------------------------------------

bool Parameters::serves(bool write, uint32_t function) const {
  return write ? function == kWriteDword || function == kWriteDouble
               : function == kReadDword || function == kReadDouble;
}

Parameters::Found Parameters::find(int32_t number, int32_t index) const {
  Found found;
  found.row = nc::nct::findParameter(number);
  if (found.row == nullptr) {
    found.code = 30;
    return found;
  }
  const bool global = found.row->index == nc::nct::ParameterIndex::Global;
  if (global != (index == 0)) found.code = global ? 32 : 31;
  if (!global && index < 0) found.code = 31;
  if (found.code != 0) return found;
  const uint32_t at = global ? 0 : static_cast<uint32_t>(index) - 1;
  const uint32_t values = valuesOf(found.row->index);
  found.count = at < values ? values - at : 0;
  found.first = firstOf(*found.row, static_cast<uint32_t>(number)) + at;
  return found;
}

// The upper limit of the amount is printed one value too low (l.3708 and others): "max. n+2" for n values (l.3679) and
// the example with axes 2 and 3 are right.
std::optional<int32_t> Parameters::service(uint32_t function, Block& block) {
  const bool doubles = function == kReadDouble || function == kWriteDouble;
  const bool write = function == kWriteDword || function == kWriteDouble;
  const int32_t words = doubles ? 2 : 1;
  const int32_t amount = block.amount();
  if (amount < 2 + words || (amount - 2) % words != 0) return 2;
  if (function != kWriteDword && checksum() != checksum_) return 4; // MW 34 has no such code (l.3821-3829)
  const Found found = find(block.word(2), block.word(3));
  if (found.code != 0) return found.code;
  if (doubles != (found.row->format == nc::nct::ParameterFormat::Double)) return 33;
  const auto count = static_cast<uint32_t>((amount - 2) / words);
  if (count > found.count) return 2;
  for (uint32_t i = 0; i < count; ++i) {
    double& value = values_[found.first + i];
    const uint32_t at = 4 + i * static_cast<uint32_t>(words);
    if (write && doubles) value = block.real(at);
    if (write && !doubles)
      value = found.row->format == nc::nct::ParameterFormat::Bits ? block.word(at) & 0xFF : block.word(at);
    if (!write && doubles) block.setReal(at, value);
    if (!write && !doubles) block.setWord(at, static_cast<int32_t>(value));
  }
  if (!write) return 0;
  changed();
  writeConstants();
  return 0;
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

// "N0516.2" is parameter 516 of axis 2; without an index the value applies to all axes.
std::string Parameters::setConfigured(const std::vector<uint32_t>& key, double value, std::vector<double>& values) {
  const nc::nct::ParameterRow* row = key.size() <= 2 ? nc::nct::findParameter(key[0]) : nullptr;
  if (row == nullptr) return "there is no such parameter (rungc doc nct lists them)";
  const uint32_t count = valuesOf(row->index);
  const uint32_t first = firstOf(*row, key[0]);
  if (key.size() == 2 && (row->index == nc::nct::ParameterIndex::Global || key[1] < 1 || key[1] > count))
    return row->index == nc::nct::ParameterIndex::Global
               ? "the parameter is global"
               : "the parameter has the indices 1 to " + std::to_string(count);
  if (row->format != nc::nct::ParameterFormat::Double && (value != std::floor(value) || std::abs(value) > 0xFFFFFFFFu))
    return "the parameter takes whole numbers";
  if (row->format == nc::nct::ParameterFormat::Bits && (value < 0 || value > 255))
    return "the parameter has the bits 0 to 7";
  if (row->format == nc::nct::ParameterFormat::Dword && value > INT32_MAX) value -= 4294967296.0; // as 32 bits
  if (key.size() == 2)
    values[first + key[1] - 1] = value;
  else
    for (uint32_t i = 0; i < count; ++i) values[first + i] = value;
  return {};
}

Handled Parameters::config(std::string_view key, std::string_view value) {
  const auto place = numbersAfter(key, key.starts_with("param.N") ? "param.N" : "param.");
  if (!place) return std::nullopt;
  const std::optional<double> amount = text::realIn(value);
  if (!amount) return std::string(key) + ": expected a number, found '" + std::string(value) + "'";
  const std::string wrong = setConfigured(*place, *amount, initial_);
  return wrong.empty() ? std::string() : std::string(key) + ": " + wrong;
}

Handled Parameters::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey(name, keys, {}); !wrong.empty()) return wrong;
  checksum_ = ~checksum_;
  return "";
}

std::optional<double> Parameters::quantity(std::string_view name) const {
  const auto key = numbersAfter(name, name.starts_with("PARAM.N") ? "PARAM.N" : "PARAM.");
  if (!key || key->size() > 2) return std::nullopt;
  const nc::nct::ParameterRow* row = nc::nct::findParameter((*key)[0]);
  const uint32_t index = key->size() == 2 ? (*key)[1] : 1;
  if (row == nullptr || index < 1 || index > valuesOf(row->index)) return std::nullopt;
  return values_[firstOf(*row, (*key)[0]) + index - 1];
}

Handled Parameters::setQuantity(std::string_view name, double value) {
  const auto key = numbersAfter(name, name.starts_with("PARAM.N") ? "PARAM.N" : "PARAM.");
  if (!key) return std::nullopt;
  std::string wrong = setConfigured(*key, value, values_);
  changed();
  writeConstants();
  return wrong;
}

// Macro variables.

namespace {

constexpr uint32_t kFromPlc = 1000;
constexpr uint32_t kToPlc = 1100;
constexpr uint32_t kBits = 32; // then the double word, then three doubles

uint32_t asWord(double value) {
  return std::abs(value) < 4294967296.0 ? static_cast<uint32_t>(static_cast<int64_t>(value)) : 0;
}

// Reads variable `n` of one of the two groups: bits, double word, doubles.
double groupRead(const SignalMemory& signals, const WordSignal& bits, const RealSignal (&reals)[3], uint32_t n,
                 uint32_t channel) {
  const auto word = static_cast<uint32_t>(signals.get(bits, channel));
  if (n < kBits) return word >> n & 1;
  return n == kBits ? word : signals.get(reals[n - kBits - 1], channel);
}

} // namespace

std::optional<double> Macros::read(int64_t variable, int64_t channel) const {
  if (variable < kFirst || variable > kLast || channel < 0 || channel >= nc::nct::kChannels) return std::nullopt;
  return const_cast<Macros*>(this)->place(static_cast<uint32_t>(variable), static_cast<uint32_t>(channel));
}

bool Macros::write(int64_t variable, int64_t channel, double value) {
  if (!read(variable, channel)) return false;
  place(static_cast<uint32_t>(variable), static_cast<uint32_t>(channel)) = value;
  return true;
}

std::optional<double> Macros::programRead(uint32_t variable, uint32_t channel) const {
  if (channel >= nc::nct::kChannels) return std::nullopt;
  if (variable >= kFromPlc && variable <= kFromPlc + kBits + 3)
    return groupRead(links().signals, bitsToProgram_, toProgram_, variable - kFromPlc, channel);
  if (variable >= kToPlc && variable <= kToPlc + kBits + 3)
    return groupRead(links().signals, bitsToPlc_, toPlc_, variable - kToPlc, channel);
  return read(variable, channel);
}

bool Macros::programWrite(uint32_t variable, uint32_t channel, double value) {
  if (channel >= nc::nct::kChannels) return false;
  if (variable >= kFirst && variable <= kLast) {
    place(variable, channel) = value;
    return true;
  }
  if (variable < kToPlc || variable > kToPlc + kBits + 3) return false;
  const SignalMemory& signals = links().signals;
  const uint32_t n = variable - kToPlc;
  const auto word = static_cast<uint32_t>(signals.get(bitsToPlc_, channel));
  const uint32_t mask = n < kBits ? uint32_t{1} << n : 0;
  if (n < kBits)
    signals.set(bitsToPlc_, channel, static_cast<int32_t>(value != 0 ? word | mask : word & ~mask));
  else if (n == kBits)
    signals.set(bitsToPlc_, channel, static_cast<int32_t>(asWord(value)));
  else
    signals.set(toPlc_[n - kBits - 1], channel, value);
  return true;
}

std::optional<double> Macros::quantity(std::string_view name) const {
  const auto key = numbersAfter(name, "MACRO.");
  if (!key || key->size() != 2 || (*key)[0] < 1) return std::nullopt;
  return programRead((*key)[1], (*key)[0] - 1);
}

Handled Macros::setQuantity(std::string_view name, double value) {
  const auto key = numbersAfter(name, "MACRO.");
  if (!key) return std::nullopt;
  if (key->size() != 2 || (*key)[0] < 1 || !programWrite((*key)[1], (*key)[0] - 1, value))
    return "NC.MACRO.C.N: channel 1 to 8, variable 100 to 999 or 1100 to 1135";
  return "";
}

void Macros::powerOn(nc::PowerOn kind) {
  volatile_ = {};
  if (kind == nc::PowerOn::Cold) retained_ = {};
}

void Macros::retain(Retained& retained) { retained.value(retained_); }

// MR 10 and MW 11.

namespace {

constexpr uint32_t kRead = 10;
constexpr uint32_t kWrite = 11;

uint32_t sumOf(const std::array<int32_t, kNvramWords>& words) { return nct::checksum(std::span<const int32_t>(words)); }

} // namespace

Nvram::Nvram(Links& links) : Topic(links), checksum_(sumOf(words_)) {}

bool Nvram::serves(bool write, uint32_t function) const { return function == (write ? kWrite : kRead); }

// Errors are checked in the order of the manual (l.3586-3598, 3627-3636), except the checksum: the error of an invalid
// request comes first. A destination beyond word 9999 is an error of the PLC address (11).
std::optional<int32_t> Nvram::service(uint32_t function, Block& block) {
  if (block.amount() != 3) return 2;
  const int32_t first = block.word(2);
  const int32_t address = block.word(3);
  const int32_t count = block.word(4);
  if (first < 0 || first >= kNvramWords) return 10;
  const PlcMemory& memory = links().memory;
  if (address < 0 || static_cast<uint32_t>(address) < memory.plcNvram()) return 11;
  if (count < 1 || count > kNvramWords - first) return 12;
  if (!memory.contains(address, count)) return 11;
  if (function == kRead && sumOf(words_) != checksum_) return 4;
  auto place = static_cast<uint32_t>(address);
  for (int32_t& word : std::span(words_).subspan(static_cast<size_t>(first), static_cast<size_t>(count))) {
    if (function == kRead)
      memory.setWord(place, word);
    else
      word = memory.word(place);
    ++place;
  }
  if (function == kWrite) checksum_ = sumOf(words_); // l.3606: the new checksum is made before the answer
  return 0;
}

Handled Nvram::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey(name, keys, {}); !wrong.empty()) return wrong;
  words_[0] ^= 1;
  return "";
}

std::optional<double> Nvram::quantity(std::string_view name) const {
  const auto key = numbersAfter(name, "NVRAM.");
  if (!key || key->size() != 1 || (*key)[0] >= words_.size()) return std::nullopt;
  return words_[(*key)[0]];
}

Handled Nvram::setQuantity(std::string_view name, double value) {
  const auto key = numbersAfter(name, "NVRAM.");
  if (!key) return std::nullopt;
  if (key->size() != 1 || (*key)[0] >= words_.size()) return "NC.NVRAM has the words 0 to 1023";
  words_[(*key)[0]] = static_cast<int32_t>(static_cast<int64_t>(value));
  checksum_ = sumOf(words_);
  return "";
}

void Nvram::powerOn(nc::PowerOn kind) {
  if (kind == nc::PowerOn::Warm) return;
  words_ = {};
  checksum_ = sumOf(words_);
}

void Nvram::retain(Retained& retained) {
  retained.value(words_);
  retained.value(checksum_);
}

// MW 40.

bool ProgramSelection::serves(bool write, uint32_t function) const { return write && function == 40; }

// Code 2 is printed as "not 1", the amount as "always 2" (l.3905-3925). A request waits while a program runs, CN_START
// or CN_STOP (l.5890): its output is not TRUE until then (l.3899). Word 3 is printed as 0 after the execution (l.3919).
// Codes of other functions (6.29) fill gaps of this function's table: 41 for the channel.
std::optional<int32_t> ProgramSelection::service(uint32_t, Block& block) {
  if (block.amount() != 2) return 2;
  const int32_t number = block.word(2);
  const int32_t channel = block.word(3);
  if (channel < 1 || channel > static_cast<int32_t>(nc::nct::kChannels)) return 41;
  const auto index = static_cast<uint32_t>(channel) - 1;
  if (links().signals.get(start_, index) || links().signals.get(stop_, index)) return std::nullopt;
  if (!links().channels->hasProgram(number)) return 40;
  links().channels->select(index, number);
  block.setWord(3, 0);
  return 0;
}

} // namespace rung::sim::nct
