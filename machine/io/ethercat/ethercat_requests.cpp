// Requests to EtherCAT.
#include "machine/io/ethercat/ethercat_requests.h"

#include <iterator>

#include "machine/io/ethercat/master.h"
#include "rtlib/nc/control/technol/cells.h"

namespace rung::io {

using ethercat::Master;
using ethercat::StateBits;
using ethercat::Station;

namespace {

using Room = std::array<uint8_t, ethercat::kMostMailboxBytes>;

uint8_t byteOf(const DeviceCall& call, uint32_t at) { return static_cast<uint8_t>(call.arg(at)); }
uint16_t wordOf(const DeviceCall& call, uint32_t at) { return static_cast<uint16_t>(call.arg(at)); }

// Master, Slave, Index, Subindex, Len
Master::Ticket upload(Master& master, Station at, const DeviceCall& call) {
  return master.upload(at, wordOf(call, 2), byteOf(call, 3), call.number(4));
}
// Master, Slave, Index, Subindex, Val, Len
Master::Ticket download(Master& master, Station at, const DeviceCall& call) {
  Room room;
  return master.download(at, wordOf(call, 2), byteOf(call, 3), call.bytes(4, room));
}
// Master, Slave, DrNo, ElemFl, IDN, Len
Master::Ticket readIdn(Master& master, Station at, const DeviceCall& call) {
  return master.readIdn(at, byteOf(call, 2), byteOf(call, 3), wordOf(call, 4), call.number(5));
}
// Master, Slave, DrNo, ElemFl, IDN, Val, Len
Master::Ticket writeIdn(Master& master, Station at, const DeviceCall& call) {
  Room room;
  return master.writeIdn(at, byteOf(call, 2), byteOf(call, 3), wordOf(call, 4), call.bytes(5, room));
}
Master::Ticket command(Master& master, Station at, const DeviceCall& call) {
  return master.command(at, call.number(2));
}

// Returns 0 if the master does not accept the request.
Master::Ticket ask(Master& master, const DeviceCall& call) {
  const Station at = {call.number(0), call.number(1)};
  switch (call.kind()) {
  case ServiceKind::EthercatReadObject: return upload(master, at, call);
  case ServiceKind::EthercatWriteObject: return download(master, at, call);
  case ServiceKind::EthercatReadIdn: return readIdn(master, at, call);
  case ServiceKind::EthercatWriteIdn: return writeIdn(master, at, call);
  default: return command(master, at, call);
  }
}

bool writes(ServiceKind kind) {
  return kind == ServiceKind::EthercatWriteObject || kind == ServiceKind::EthercatWriteIdn;
}

// Results: DR, Len, then for reads the number of data bytes, and for an IDN its elements.
enum Result : uint32_t { kCode, kLength, kRest, kMostResults = 4 };

} // namespace

void EthercatCalls::clear() {
  for (Pending& pending : pending_) {
    if (pending.ticket != 0) master_.forget(pending.asked);
    pending = {};
  }
}

void EthercatCalls::begin(DeviceCall& call) {
  Pending* free = std::ranges::find(pending_, 0u, &Pending::ticket);
  const bool room = free != std::end(pending_);
  const Master::Ticket asked = room ? ask(master_, call) : 0;
  if (asked == 0) return call.set(kCode, ethercat::kTimedOut);
  *free = {.ticket = call.request().ticket, .asked = asked, .writes = writes(call.kind())};
  call.wait();
}

bool EthercatCalls::finish(runtime::Instance& instance, AnswerBytes& bytes) {
  bool any = false;
  for (Pending& pending : pending_) {
    if (pending.ticket == 0) continue;
    const ethercat::Answer answer = master_.poll(pending.asked);
    if (!answer.isDone) continue;
    core::ServiceReply reply{.ticket = pending.ticket, .resultCount = kMostResults};
    reply.results[kCode] = answer.code;
    reply.results[kLength] = answer.length;
    if (!pending.writes) reply.results[kRest] = static_cast<int64_t>(answer.data.size());
    reply.results[pending.writes ? kRest : kRest + 1] = answer.elements;
    std::ranges::copy(answer.data, bytes.make(pending.ticket, static_cast<uint32_t>(answer.data.size())).begin());
    instance.services().complete(reply);
    master_.forget(pending.asked);
    pending = {};
    any = true;
  }
  return any;
}

namespace {

struct Bit {
  const char* name;
  bool StateBits::* member;
};
constexpr Bit kStateBits[] = {{"flEcatBootStrapReq", &StateBits::bootstrapRequest},
                              {"flEcatInitReq", &StateBits::initRequest},
                              {"flEcatPreOperationalReq", &StateBits::preOperationalRequest},
                              {"flEcatSafeOperationalReq", &StateBits::safeOperationalRequest},
                              {"flEcatOperationalReq", &StateBits::operationalRequest},
                              {"flEcatStartCyclicOperation", &StateBits::startCyclicOperation},
                              {"flEcatOperational", &StateBits::isOperational}};

} // namespace

StatePlaces::StatePlaces(const rung_program& program) {
  static_assert(std::size(kStateBits) == std::tuple_size_v<decltype(bits_)>);
  for (uint32_t i = 0; i < bits_.size(); ++i) bits_[i] = nc::technol::locateSignal(program, kStateBits[i].name);
}

void StatePlaces::read(const core::Memory& memory, StateBits& bits) const {
  for (uint32_t i = 0; i < bits_.size(); ++i) bits.*kStateBits[i].member = memory.read(bits_[i]) != 0;
}

void StatePlaces::write(const core::Memory& memory, const StateBits& bits) const {
  for (uint32_t i = 0; i < bits_.size(); ++i) memory.write(bits_[i], bits.*kStateBits[i].member ? 1 : 0);
}

// Requested states of the master.

namespace ethercat {

namespace {

struct Request {
  bool StateBits::* bit;
  State state;
};
constexpr Request kRequests[] = {{&StateBits::initRequest, State::Init},
                                 {&StateBits::bootstrapRequest, State::Bootstrap},
                                 {&StateBits::preOperationalRequest, State::PreOperational},
                                 {&StateBits::safeOperationalRequest, State::SafeOperational},
                                 {&StateBits::operationalRequest, State::Operational}};

} // namespace

void StateRequests::reset(bool byProgram) noexcept {
  if (ticket_ != 0) master_.forget(ticket_);
  ticket_ = current_ = next_ = 0;
  byProgram_ = byProgram;
  startSeen_ = start_ = false;
}

// The start bit stays set after the start, so only its rising edge counts.
void StateRequests::tick(StateBits& bits) noexcept {
  if (byProgram_ && bits.startCyclicOperation && !startSeen_) start_ = true;
  startSeen_ = bits.startCyclicOperation;
  finish(bits);
  if (ticket_ == 0) begin(bits);
  bits.isOperational = master_.state() == State::Operational;
}

void StateRequests::finish(StateBits& bits) noexcept {
  if (ticket_ == 0) return;
  const Answer answer = master_.poll(ticket_);
  if (!answer.isDone) return;
  master_.forget(ticket_);
  ticket_ = 0;
  const bool reached = answer.code == kDone;
  next_ = reached ? 0 : current_ + 1;
  if (current_ == kStart) start_ = false;
  if (reached && current_ != kStart) bits.*kRequests[current_].bit = false;
}

bool StateRequests::isWanted(uint32_t request, const StateBits& bits) const noexcept {
  return request == kStart ? start_ : bits.*kRequests[request].bit;
}

void StateRequests::begin(const StateBits& bits) noexcept {
  for (uint32_t i = 0; i <= kStart; ++i) {
    current_ = (next_ + i) % (kStart + 1);
    if (!isWanted(current_, bits)) continue;
    const State target = current_ == kStart ? State::Operational : kRequests[current_].state;
    ticket_ = master_.command({}, static_cast<uint32_t>(target));
    return;
  }
}

} // namespace ethercat

// A host without an EtherCAT master.

namespace ethercat {

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

} // namespace ethercat

} // namespace rung::io
