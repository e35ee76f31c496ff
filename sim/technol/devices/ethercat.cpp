// The simulated EtherCAT net at work (see ethercat.h); its configuration is in ethercat_configuration.cpp.
#include "sim/technol/devices/ethercat.h"

#include <algorithm>

namespace rung::sim::technol {

using namespace io::ethercat;
using Kind = EthercatRequest::Kind;

namespace {

// A request that nobody answers: it waits, then it has failed.
std::optional<uint32_t> timeOut(const EthercatRequest& request) {
  return request.ageMs < EtherCat::kTimeoutMs ? std::nullopt : std::optional<uint32_t>(kTimedOut);
}

// Answered by serveChange, when its turn has come.
bool isChange(const EthercatRequest& request) {
  return request.kind == Kind::Command && stateOf(request.index) != State::Unknown;
}

} // namespace

// ---- requests ----------------------------------------------------------------------------------------------------

EtherCat::Ticket EtherCat::begin(const Station& station, Kind kind, uint32_t index, uint32_t sub, uint32_t elements,
                                 uint32_t most, std::span<const uint8_t> data) noexcept {
  EthercatRequest* request = requests_.add(station, kind, data);
  if (request == nullptr) return 0;
  request->index = index;
  request->sub = sub;
  request->elements = elements;
  request->most = most;
  return request->ticket;
}

EtherCat::Ticket EtherCat::upload(Station station, uint16_t index, uint8_t subindex, uint32_t most) noexcept {
  return begin(station, Kind::Upload, index, subindex, 0, most, {});
}

EtherCat::Ticket EtherCat::download(Station station, uint16_t index, uint8_t subindex,
                                    std::span<const uint8_t> data) noexcept {
  return begin(station, Kind::Download, index, subindex, 0, 0, data);
}

EtherCat::Ticket EtherCat::readIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn,
                                   uint32_t most) noexcept {
  return begin(station, Kind::ReadIdn, idn, drive, elements, most, {});
}

EtherCat::Ticket EtherCat::writeIdn(Station station, uint8_t drive, uint8_t elements, uint16_t idn,
                                    std::span<const uint8_t> data) noexcept {
  return begin(station, Kind::WriteIdn, idn, drive, elements, 0, data);
}

EtherCat::Ticket EtherCat::command(Station station, uint32_t command) noexcept {
  return begin(station, Kind::Command, command, 0, 0, 1, {});
}

Answer EtherCat::poll(Ticket ticket) const noexcept {
  const EthercatRequest* request = requests_.find(ticket);
  if (request == nullptr) return {.isDone = true, .code = kNoMaster};
  if (!request->isDone) return {};
  Answer answer{.isDone = true, .code = request->code};
  if (answer.code != kDone) return answer;
  const bool isRead = request->kind != Kind::Download && request->kind != Kind::WriteIdn;
  answer.length = isRead ? std::min(request->size, request->most) : request->size;
  answer.elements = static_cast<uint8_t>(request->elements);
  if (isRead) answer.data = std::span(request->data).first(answer.length);
  return answer;
}

// ---- time --------------------------------------------------------------------------------------------------------

void EtherCat::powerOn() {
  slaves_.powerOn();
  states_.powerOn();
  image_.powerOn();
  requests_.clear();
  stateRequests_.reset(byProgram_);
  commandTicket_ = 0;
  startInMs_ = byProgram_ ? 0 : delayMs_;
  if (!exists() || byProgram_) return;
  states_.start(delayMs_ == 0 ? State::Operational : State::SafeOperational);
}

void EtherCat::tick(StateBits& bits) {
  startLater();
  serveChange();
  serveAnswers();
  requests_.dropForgotten();
  image_.putOutputs();
  slaves_.tick();
  image_.takeInputs();
  stateRequests_.tick(bits);
}

void EtherCat::startLater() {
  if (startInMs_ == 0) return;
  --startInMs_;
  if (startInMs_ == 0 && states_.hasLink()) states_.start(State::Operational);
}

// Changes of state come one after the other, in the order in which they were asked for.
EthercatRequest* EtherCat::changeUnderWay() {
  for (uint32_t i = 0; i < requests_.count(); ++i) {
    EthercatRequest& request = requests_[i];
    if (isChange(request) && !request.isDone) return &request;
  }
  return nullptr;
}

void EtherCat::serveChange() {
  EthercatRequest* request = changeUnderWay();
  if (request == nullptr) return;
  const bool ofSlave = request->index > kSlaveCommands;
  if (!exists() || request->station.master != 0) return requests_.finish(*request, kNoMaster);
  if (ofSlave && request->station.slave >= slaves_.count()) return requests_.finish(*request, kNoSlave);
  if (request->ticket != commandTicket_) {
    commandTicket_ = request->ticket;
    states_.begin(stateOf(request->index), ofSlave ? std::optional(request->station.slave) : std::nullopt);
    if (!ofSlave) startInMs_ = 0; // the program has decided otherwise
  }
  if (const auto code = states_.tick()) requests_.finish(*request, *code);
}

// ---- answers -----------------------------------------------------------------------------------------------------

void EtherCat::serveAnswers() {
  for (uint32_t i = 0; i < requests_.count(); ++i) {
    EthercatRequest& request = requests_[i];
    ++request.ageMs;
    if (request.isDone || isChange(request)) continue;
    if (const auto code = answerOf(request)) requests_.finish(request, *code);
  }
}

// Nothing: not yet.
std::optional<uint32_t> EtherCat::answerOf(EthercatRequest& request) {
  if (!exists() || request.station.master != 0) return kNoMaster;
  const bool isCommand = request.kind == Kind::Command;
  if (isCommand && request.index != kMasterState && request.index != kSlaveState) return kUnknownCommand;
  if (!states_.hasLink()) return kNoSlave;
  const bool ofMaster = isCommand && request.index == kMasterState;
  if (!ofMaster && request.station.slave >= slaves_.count()) return kNoSlave;
  if (request.ageMs < kMailboxMs) return std::nullopt;
  if (!isCommand) return mailboxAnswer(request);
  if (!ofMaster && slaves_[request.station.slave].isSilent) return timeOut(request);
  const State state = ofMaster ? states_.master() : slaves_[request.station.slave].state;
  request.data[0] = static_cast<uint8_t>(state);
  request.size = 1;
  return kDone;
}

std::optional<uint32_t> EtherCat::mailboxAnswer(EthercatRequest& request) {
  const EthercatSlave& slave = slaves_[request.station.slave];
  const bool isCoe = request.kind == Kind::Upload || request.kind == Kind::Download;
  if (!slave.hasMailbox() || !(isCoe ? slave.protocols.coe : slave.protocols.soe)) return kNoMailbox;
  if (slave.isSilent) return timeOut(request);
  return slave.injectedError != 0 ? slave.injectedError : exchange(request);
}

uint32_t EtherCat::exchange(EthercatRequest& request) {
  const uint32_t slave = request.station.slave;
  if (request.kind == Kind::Download || request.kind == Kind::WriteIdn) {
    const bool isCoe = request.kind == Kind::Download;
    if (request.size > request.data.size()) return isCoe ? kSdoWrongLength : kSoeTooLong;
    const std::span<const uint8_t> data = std::span(request.data).first(request.size);
    return isCoe ? slaves_.download(slave, request.index, request.sub, data)
                 : slaves_.writeIdn(slave, request.sub, request.elements, request.index, data);
  }
  MailboxData data{request.data};
  const uint32_t code = request.kind == Kind::Upload
                            ? slaves_.upload(slave, request.index, request.sub, data)
                            : slaves_.readIdn(slave, request.sub, request.elements, request.index, data);
  request.size = static_cast<uint32_t>(data.size);
  return code;
}

} // namespace rung::sim::technol
