// A host without an EtherCAT master (see master.h).
#include "machine/io/ethercat/master.h"

namespace rung::io::ethercat {
namespace {

class NoMaster final : public Master {
public:
  Ticket upload(Station, uint16_t, uint8_t, uint32_t) noexcept override { return kTicket; }
  Ticket download(Station, uint16_t, uint8_t, std::span<const uint8_t>) noexcept override { return kTicket; }
  Ticket readIdn(Station, uint8_t, uint8_t, uint16_t, uint32_t) noexcept override { return kTicket; }
  Ticket writeIdn(Station, uint8_t, uint8_t, uint16_t, std::span<const uint8_t>) noexcept override { return kTicket; }
  Ticket command(Station, uint32_t) noexcept override { return kTicket; }
  Answer poll(Ticket) const noexcept override { return {.isDone = true, .code = kNoMaster}; }
  void forget(Ticket) noexcept override {}
  State state() const noexcept override { return State::Unknown; }

private:
  static constexpr Ticket kTicket = 1;
};

} // namespace

Master& noMaster() noexcept {
  static NoMaster none;
  return none;
}

} // namespace rung::io::ethercat
