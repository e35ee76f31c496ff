// Requests to EtherCAT (see ethercat_calls.h).
#include "tools/sim/technol/requests/ethercat_calls.h"

#include <string>

#include "rtlib/nc/control/technol/cells.h"

namespace rung::sim::technol {

using devices::ethercat::Master;
using devices::ethercat::StateBits;
using devices::ethercat::Station;

namespace {

using Room = std::array<uint8_t, devices::ethercat::kMostMailboxBytes>;

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

struct Order {
  std::string_view name;
  Master::Ticket (*begin)(Master&, Station, const DeviceCall&);
  bool writes = false;
};
constexpr Order kOrders[] = {{"ECAT_COE_READ", upload},
                             {"ECAT_COE_WRITE", download, true},
                             {"ECAT_SOE_READ", readIdn},
                             {"ECAT_SOE_WRITE", writeIdn, true},
                             {"ECAT_COMMAND", command}};

// Results: DR, Len, of what reads the number of its data, of an IDN its elements.
enum Result : uint32_t { kCode, kLength, kRest, kMostResults = 4 };

} // namespace

void EthercatCalls::clear() {
  for (Pending& pending : pending_) {
    if (pending.ticket != 0) master_.forget(pending.asked);
    pending = {};
  }
}

std::optional<uint32_t> EthercatCalls::orderOf(std::string_view service) {
  const auto* found = std::ranges::find(kOrders, service, &Order::name);
  return found == std::end(kOrders) ? std::nullopt : std::optional(static_cast<uint32_t>(found - kOrders));
}

void EthercatCalls::begin(uint32_t order, DeviceCall& call) {
  Pending* free = std::ranges::find(pending_, 0u, &Pending::ticket);
  const bool room = free != std::end(pending_);
  const Master::Ticket asked = room ? kOrders[order].begin(master_, {call.number(0), call.number(1)}, call) : 0;
  if (asked == 0) return call.set(kCode, devices::ethercat::kTimedOut);
  *free = {.ticket = call.request().ticket, .asked = asked, .writes = kOrders[order].writes};
  call.wait();
}

bool EthercatCalls::finish(host::Instance& instance, AnswerBytes& bytes) {
  bool any = false;
  for (Pending& pending : pending_) {
    if (pending.ticket == 0) continue;
    const devices::ethercat::Answer answer = master_.poll(pending.asked);
    if (!answer.isDone) continue;
    rt::ServiceReply reply{.ticket = pending.ticket, .resultCount = kMostResults};
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

template <class Struct>
struct Flag {
  const char* name;
  bool Struct::* member;
};
constexpr Flag<StateBits> kStateBits[] = {{"flEcatBootStrapReq", &StateBits::bootstrapRequest},
                                          {"flEcatInitReq", &StateBits::initRequest},
                                          {"flEcatPreOperationalReq", &StateBits::preOperationalRequest},
                                          {"flEcatSafeOperationalReq", &StateBits::safeOperationalRequest},
                                          {"flEcatOperationalReq", &StateBits::operationalRequest},
                                          {"flEcatStartCyclicOperation", &StateBits::startCyclicOperation},
                                          {"flEcatOperational", &StateBits::isOperational}};
// The servo's number follows.
constexpr Flag<ServoCells> kServoBits[] = {{"flEdrvInit", &ServoCells::init},
                                           {"flEdrvOn", &ServoCells::on},
                                           {"flEdrvEnable", &ServoCells::enable},
                                           {"flEdrvDisable", &ServoCells::disable},
                                           {"flEdrvDone", &ServoCells::done},
                                           {"flEdrvErase", &ServoCells::erase},
                                           {"flEdrvSimul", &ServoCells::isSimulated},
                                           {"flEdrvError", &ServoCells::isFaulty},
                                           {"flEdrvMoveDisReq", &ServoCells::blocksMotion}};
constexpr const char* kServoNumbers[] = {"wEdrvDriveStatus", "wEdrvDriveErrReg", "wEdrvDriveControl", "bEdrvState"};

} // namespace

EthercatPlaces::EthercatPlaces(const rung_program& program) {
  static_assert(std::size(kStateBits) == kBits && std::size(kServoBits) == kServoFlags &&
                std::size(kServoNumbers) == kServoWords);
  for (uint32_t i = 0; i < kBits; ++i) bits_[i] = nc::technol::locateSignal(program, kStateBits[i].name);
  for (uint32_t servo = 0; servo < EthercatServos::kCount; ++servo) {
    const std::string number = std::to_string(servo);
    for (uint32_t i = 0; i < kServoFlags; ++i)
      flags_[servo][i] = nc::technol::locateSignal(program, kServoBits[i].name + number);
    for (uint32_t i = 0; i < kServoWords; ++i)
      words_[servo][i] = nc::technol::locateSignal(program, kServoNumbers[i] + number);
  }
}

void EthercatPlaces::read(const rt::Memory& memory, StateBits& bits, EthercatServos::Cells& servos) const {
  for (uint32_t i = 0; i < kBits; ++i) bits.*kStateBits[i].member = memory.read(bits_[i]) != 0;
  for (uint32_t servo = 0; servo < servos.size(); ++servo) {
    for (uint32_t i = 0; i < kServoFlags; ++i) servos[servo].*kServoBits[i].member = memory.read(flags_[servo][i]) != 0;
    servos[servo].status = static_cast<uint16_t>(memory.read(words_[servo][0]));
    servos[servo].error = static_cast<uint16_t>(memory.read(words_[servo][1]));
  }
}

void EthercatPlaces::write(const rt::Memory& memory, const StateBits& bits, const EthercatServos::Cells& servos) const {
  for (uint32_t i = 0; i < kBits; ++i) memory.write(bits_[i], bits.*kStateBits[i].member ? 1 : 0);
  for (uint32_t servo = 0; servo < servos.size(); ++servo) {
    const ServoCells& cells = servos[servo];
    if (!cells.isSimulated && !cells.isConnected) continue;
    for (uint32_t i = 0; i < kServoFlags; ++i) memory.write(flags_[servo][i], cells.*kServoBits[i].member ? 1 : 0);
    const uint64_t numbers[] = {cells.status, cells.error, cells.control, static_cast<uint64_t>(cells.state)};
    for (uint32_t i = 0; i < kServoWords; ++i) memory.write(words_[servo][i], numbers[i]);
  }
}

} // namespace rung::sim::technol
