// MR 10 and MW 11 (see nvram.h).
#include "sim/nct/nvram.h"

#include "sim/nct/checksum.h"

namespace rung::sim::nct {
namespace {

constexpr uint32_t kRead = 10;
constexpr uint32_t kWrite = 11;

uint32_t sumOf(const std::array<int32_t, kNvramWords>& words) { return checksum(std::span<const int32_t>(words)); }

} // namespace

Nvram::Nvram(Links& links) : Topic(links), checksum_(sumOf(words_)) {}

bool Nvram::serves(bool write, uint32_t function) const { return function == (write ? kWrite : kRead); }

// The codes in the order of the manual (l.3586-3598, 3627-3636), but for the checksum: a request that is wrong in
// itself is answered as that. A destination that reaches beyond word 9999 is the PLC address' error (11).
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
  if (function == kWrite) checksum_ = sumOf(words_); // l.3606: the code follows the new checksum
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

void Nvram::keep(Kept& kept) {
  kept.value(words_);
  kept.value(checksum_);
}

} // namespace rung::sim::nct
