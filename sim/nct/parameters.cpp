// The parameters of the control (see parameters.h).
#include "sim/nct/parameters.h"

#include <cmath>
#include <cstdlib>

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

// Where the values of a parameter begin, in the order of the rows.
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
  if (row == nullptr) std::abort(); // the numbers are in this code alone
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
  ++revision_; // what was kept may have come back
  writeConstants();
}

void Parameters::keep(Kept& kept) {
  kept.values(std::span<double>(values_));
  kept.value(checksum_);
}

// N1201… as N_Pij, N_PDW1 and N_PDB1 (man. 7.11).
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

// The upper limit of the amount is printed one value too low (l.3708 and so on): "max. n+2" for n values (l.3679) and
// the example with axes 2 and 3 hold.
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

// "N0516.2" is parameter 516 of axis 2; without an index the value holds for all of them.
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

} // namespace rung::sim::nct
