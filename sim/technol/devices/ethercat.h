// Requests that the simulated EtherCAT master has accepted, in the order in which they were begun. All memory is
// allocated with the object.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "machine/io/ethercat/ethercat_requests.h"
#include "machine/io/ethercat/master.h"
#include "sim/technol/devices/ethercat_slaves.h"

namespace rung::sim::technol {

struct EthercatRequest {
  enum class Kind : uint8_t { Upload, Download, ReadIdn, WriteIdn, Command };
  Kind kind = Kind::Command;
  io::ethercat::Station station;
  uint32_t index = 0;    // index, IDN or command
  uint32_t sub = 0;      // subindex or drive
  uint32_t elements = 0; // of an IDN
  uint32_t most = 0;     // number of bytes requested
  // State.
  uint32_t ticket = 0; // 0: free
  uint32_t ageMs = 0;
  bool isDone = false;
  bool isForgotten = false;
  uint32_t code = 0;
  uint32_t size = 0; // size of the data to write, or of the data read
  std::array<uint8_t, io::ethercat::kMostMailboxBytes> data{};

  template <class Archive>
  void state(Archive& archive) {
    archive(kind, station, index, sub, elements, most, ticket, ageMs, isDone, isForgotten, code, size);
    archive.bytes(std::span(data).first(std::min<size_t>(size, data.size())));
  }
};

class EthercatRequests {
public:
  static constexpr uint32_t kMost = 64;

  // Returns null if all requests are in use. Data beyond the room are dropped, but included in `size`.
  EthercatRequest* add(const io::ethercat::Station& station, EthercatRequest::Kind kind, std::span<const uint8_t> data);
  const EthercatRequest* find(uint32_t ticket) const;
  // A request that is not finished is freed when it finishes.
  void forget(uint32_t ticket);
  void finish(EthercatRequest& request, uint32_t code);
  void clear();

  // Access by age, from the oldest on.
  uint32_t count() const { return count_; }
  EthercatRequest& operator[](uint32_t number) { return slots_[order_[number]]; }
  void dropForgotten();

  template <class Archive>
  void state(Archive& archive) {
    if constexpr (Archive::kLoads) clear();
    archive(lastTicket_);
    archive.atMost(count_, kMost);
    for (uint32_t i = 0; i < count_; ++i) {
      archive.atMost(order_[i], kMost - 1);
      archive(slots_[order_[i]]);
    }
  }

private:
  std::array<EthercatRequest, kMost> slots_;
  std::array<uint8_t, kMost> order_{}; // numbers of slots
  uint32_t count_ = 0;
  uint32_t lastTicket_ = 0;
};

// The simulated EtherCAT network (TECHNOL manual, chapter 26): a master with the slaves of the configuration. It is the
// io::ethercat::Master of the instructions ECAT_…, and serves the request bits flEcat…Req and the process image.
//
// A mailbox answers after 5 ms, or, if the slave is silent, after 1 s with kTimedOut. Without slaves there is no
// master. Only the configuration allocates.

class EtherCat final : public io::ethercat::Master {
public:
  using Station = io::ethercat::Station;
  static constexpr uint32_t kMailboxMs = 5;
  static constexpr uint32_t kTimeoutMs = 1000;
  static constexpr uint32_t kMostDelayMs = 3'600'000;

  EtherCat() = default;
  EtherCat(const EtherCat&) = delete;
  EtherCat& operator=(const EtherCat&) = delete;

  // Configuration keys: ethercat.…, EtherCATOPViaPLC, EtherCATDelayOP. Returns "", or the error.
  static bool owns(std::string_view key);
  std::string configure(std::string_view key, std::string_view value);

  // Restarts everything and forgets tickets. With EtherCATOPViaPLC = 0 the master is in OPERATIONAL afterwards, or
  // after EtherCATDelayOP (l.17741-17755, l.17910-17916).
  void powerOn();
  // One millisecond.
  void tick(io::ethercat::StateBits& bits);

  // For the instructions (see master.h). Answers are available after a tick.
  Ticket upload(Station station, uint16_t index, uint8_t subindex, uint32_t most) noexcept override;
  Ticket download(Station station, uint16_t index, uint8_t subindex, std::span<const uint8_t> data) noexcept override;
  Ticket readIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn, uint32_t most) noexcept override;
  Ticket writeIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn,
                  std::span<const uint8_t> data) noexcept override;
  Ticket command(Station station, uint32_t command) noexcept override;
  io::ethercat::Answer poll(Ticket ticket) const noexcept override;
  void forget(Ticket ticket) noexcept override { requests_.forget(ticket); }
  EthercatState state() const noexcept override { return exists() ? states_.master() : EthercatState::Unknown; }

  bool exists() const { return slaves_.count() != 0; }
  EthercatImage& image() { return image_; }
  const EthercatImage& image() const { return image_; }

  // Events; they return "", or the error.
  std::string setError(uint32_t slave, uint32_t code); // of its mailbox, from now on; 0: normal answers
  std::string setSilent(uint32_t slave, bool isSilent);
  std::string fault(uint32_t slave, uint32_t code); // of a CiA 402 drive: sets 603Fh
  void setLink(bool isUp) { states_.setLink(isUp); }

  // Quantities. Objects by their numbers, regardless of their access rights; nothing or false: there is no such object.
  std::optional<uint64_t> object(uint32_t slave, uint32_t index, uint32_t sub) const;
  std::optional<uint64_t> idn(uint32_t slave, uint32_t idn, uint32_t drive) const;
  bool setObject(uint32_t slave, uint32_t index, uint32_t sub, uint64_t value);
  bool setIdn(uint32_t slave, uint32_t idn, uint32_t drive, uint64_t value);
  std::optional<EthercatState> slaveState(uint32_t slave) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(slaves_, states_, image_, requests_, stateRequests_, commandTicket_, startInMs_);
  }

private:
  std::string configureSlave(std::string_view place, std::string_view value);
  std::string configureAttribute(uint32_t slave, std::string_view attribute, std::string_view value);
  std::string configureObject(std::string_view place, std::string_view value);
  std::string configureEntry(uint32_t slave, std::string_view place, std::string_view value);
  std::string setName(uint32_t slave, std::string_view name);
  std::string setMotor(uint32_t slave, std::string_view value);
  std::string setRefused(uint32_t slave, std::string_view value);
  std::string unknownSlave(uint32_t slave) const;

  Ticket begin(const Station& station, EthercatRequest::Kind kind, uint32_t index, uint32_t sub, uint32_t elements,
               uint32_t most, std::span<const uint8_t> data) noexcept;
  void startLater();
  void serveAnswers();
  void serveChange();
  EthercatRequest* changeUnderWay();
  std::optional<uint32_t> answerOf(EthercatRequest& request);
  std::optional<uint32_t> mailboxAnswer(EthercatRequest& request);
  uint32_t exchange(EthercatRequest& request);

  EthercatSlaves slaves_;
  EthercatStates states_{slaves_};
  EthercatImage image_{slaves_, states_};
  EthercatRequests requests_;
  io::ethercat::StateRequests stateRequests_{*this};
  uint32_t commandTicket_ = 0; // ticket of the change of state in progress
  bool byProgram_ = false;     // EtherCATOPViaPLC
  uint32_t delayMs_ = 0;       // EtherCATDelayOP
  uint32_t startInMs_ = 0;     // until the master enters OPERATIONAL by itself; 0: it does not
};

} // namespace rung::sim::technol
