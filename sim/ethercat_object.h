// Objects of simulated EtherCAT slaves: their text in the configuration of a simulated control, and the elements of an
// IDN in a mailbox answer. Each control has its own answers to requests.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rung::sim {

// An object of CoE (index, subindex) or the operation data of SoE (IDN, drive).
struct EthercatObject {
  uint32_t slave = 0;
  bool isIdn = false;
  uint32_t index = 0; // index or IDN
  uint32_t sub = 0;   // subindex or drive
  uint32_t bytes = 4; // 1 to 8
  uint64_t initial = 0;
  uint64_t value = 0;
  bool mayRead = true, mayWrite = true;
  // Limits of an IDN; if they are signed, so is its value.
  uint64_t least = 0, most = UINT64_MAX;
  bool isSigned = false;

  template <class Archive>
  void state(Archive& archive) {
    archive(value);
  }
};

struct EthercatProtocols {
  bool coe = false, soe = false, voe = false;
};

// A number of this many bytes with all bits set.
constexpr uint64_t onesOf(uint32_t bytes) { return bytes >= 8 ? UINT64_MAX : (uint64_t{1} << 8 * bytes) - 1; }
// Reads at most the first eight bytes.
uint64_t littleEndian(std::span<const uint8_t> bytes);
// Parses 12 or 0x0C.
std::optional<uint64_t> unsignedIn(std::string_view text);

// "coe+soe". This and the next two functions return "", or the error.
std::string parseProtocols(std::string_view text, EthercatProtocols& protocols);
// "1.coe.0x6041.0", "2.soe.47.1": slave, index and subindex, IDN and drive.
std::string parseObjectPlace(std::string_view text, EthercatObject& object);
// "0x237/2", "-5/2", "100": value and bytes; 4 bytes if not given.
std::string parseObjectValue(std::string_view text, EthercatObject& object);

// Data assembled in a buffer; bytes that do not fit are dropped.
struct MailboxData {
  std::span<uint8_t> room;
  size_t size = 0;

  void append(uint64_t value, uint32_t bytes);
};

// Elements of an IDN, by the bit number in a request's flags.
enum SoeElement : uint32_t { kState, kName, kAttribute, kUnit, kMinimum, kMaximum, kValue, kDefault };
// Appends the elements in `flags`, from bit 0 up. The name is "IDN12345", the unit an empty text.
void appendSoeElements(const EthercatObject& idn, uint32_t flags, MailboxData& to);

} // namespace rung::sim
