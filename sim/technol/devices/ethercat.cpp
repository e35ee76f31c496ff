// The simulated EtherCAT net at work (see ethercat.h); and its configuration.
#include "sim/technol/devices/ethercat.h"

#include <algorithm>

#include "rtlib/text/number.h"
#include "rung/program.h"

namespace rung::sim::technol {

using namespace io::ethercat;
using Kind = EthercatRequest::Kind;

namespace {

// The result of a request without an answer: nothing while it waits, then kTimedOut.
std::optional<uint32_t> timeOut(const EthercatRequest& request) {
  return request.ageMs < EtherCat::kTimeoutMs ? std::nullopt : std::optional<uint32_t>(kTimedOut);
}

// Whether the request changes a state; serveChange answers it in its turn.
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

// State changes are executed one after the other, in the order of their requests.
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
    if (!ofSlave) startInMs_ = 0; // a request of the program replaces the automatic start
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

// The result of a request; nothing: there is none yet.
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

// Requests of the simulated EtherCAT master.

EthercatRequest* EthercatRequests::add(const io::ethercat::Station& station, EthercatRequest::Kind kind,
                                       std::span<const uint8_t> data) {
  const auto free = std::ranges::find(slots_, 0u, &EthercatRequest::ticket);
  if (free == slots_.end()) return nullptr;
  if (++lastTicket_ == 0) ++lastTicket_;
  free->kind = kind;
  free->station = station;
  free->ticket = lastTicket_;
  free->ageMs = 0;
  free->isDone = free->isForgotten = false;
  free->code = 0;
  free->size = static_cast<uint32_t>(data.size());
  std::copy_n(data.begin(), std::min(data.size(), free->data.size()), free->data.begin());
  order_[count_++] = static_cast<uint8_t>(free - slots_.begin());
  return &*free;
}

const EthercatRequest* EthercatRequests::find(uint32_t ticket) const {
  if (ticket == 0) return nullptr;
  const auto found = std::ranges::find(slots_, ticket, &EthercatRequest::ticket);
  return found == slots_.end() ? nullptr : &*found;
}

void EthercatRequests::forget(uint32_t ticket) {
  if (ticket == 0) return;
  const auto found = std::ranges::find(slots_, ticket, &EthercatRequest::ticket);
  if (found != slots_.end()) found->isForgotten = true;
  dropForgotten();
}

void EthercatRequests::finish(EthercatRequest& request, uint32_t code) {
  request.isDone = true;
  request.code = code;
}

void EthercatRequests::dropForgotten() {
  uint32_t left = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    EthercatRequest& request = slots_[order_[i]];
    if (request.isDone && request.isForgotten)
      request.ticket = 0;
    else
      order_[left++] = order_[i];
  }
  count_ = left;
}

void EthercatRequests::clear() {
  for (EthercatRequest& request : slots_) request.ticket = 0;
  count_ = 0;
}

// Configuration, events and quantities of the simulated EtherCAT net.

namespace {

using namespace io::ethercat;

constexpr std::string_view kPrefix = "ethercat.";

// Takes the text up to `end`, and `end` itself, from the text; all of it if it does not contain `end`.
std::string_view takeUpTo(std::string_view& text, char end) {
  const std::string_view taken = text.substr(0, text.find(end));
  text.remove_prefix(std::min(text.size(), taken.size() + 1));
  return taken;
}

std::string setFlag(bool& flag, std::string_view value) {
  if (value != "0" && value != "1") return "expected 0 or 1, found '" + std::string(value) + "'";
  flag = value == "1";
  return {};
}

// Parses a limit, "-100" or "0x64", in the width of the object. A negative limit makes the value signed, and a missing
// limit becomes that of the signed type.
std::string setLimit(EthercatObject& object, std::string_view text, uint64_t& limit) {
  EthercatObject limited;
  if (std::string wrong = parseObjectValue(std::string(text) + "/" + std::to_string(object.bytes), limited);
      !wrong.empty())
    return "the limit: " + wrong;
  if (text.starts_with('-') && !object.isSigned) {
    object.isSigned = true;
    object.most = std::min(object.most, onesOf(object.bytes) / 2);
    if (object.least == 0) object.least = onesOf(object.bytes) / 2 + 1;
  }
  limit = limited.value;
  return {};
}

// Takes an option after the value: "ro", "wo", "min=0", "max=100".
std::string setOption(EthercatObject& object, std::string_view option) {
  if (option == "ro") return object.mayWrite = false, "";
  if (option == "wo" && !object.isIdn) return object.mayRead = false, "";
  if (object.isIdn && option.starts_with("min=")) return setLimit(object, option.substr(4), object.least);
  if (object.isIdn && option.starts_with("max=")) return setLimit(object, option.substr(4), object.most);
  return "'" + std::string(option) + "' is not an option: " + (object.isIdn ? "ro, min=, max=" : "ro, wo");
}

} // namespace

// ---- keys --------------------------------------------------------------------------------------------------------

bool EtherCat::owns(std::string_view key) {
  return key.starts_with(kPrefix) || key == "EtherCATOPViaPLC" || key == "EtherCATDelayOP";
}

std::string EtherCat::configure(std::string_view key, std::string_view value) {
  std::string wrong = "unknown key";
  if (key == "EtherCATOPViaPLC") {
    wrong = setFlag(byProgram_, value);
  } else if (key == "EtherCATDelayOP") {
    const auto delay = text::wholeIn<uint32_t>(value);
    const bool fits = delay && *delay <= kMostDelayMs;
    wrong = fits ? "" : "expected 0 to " + std::to_string(kMostDelayMs) + " milliseconds";
    if (fits) delayMs_ = *delay;
  } else if (key.starts_with(kPrefix)) {
    wrong = configureSlave(key.substr(kPrefix.size()), value);
  }
  return wrong.empty() ? wrong : std::string(key) + ": " + wrong;
}

// "0", "0.name", "0.coe.0x6041.0", "0.pdo.Inputs.Status_word".
std::string EtherCat::configureSlave(std::string_view place, std::string_view value) {
  std::string_view rest = place;
  const auto number = text::numberIn<uint32_t>(takeUpTo(rest, '.'));
  if (!number) return "expected ethercat.DEVICE, a number from 0";
  if (rest.empty()) return slaves_.add(*number, value);
  if (*number >= slaves_.count()) return "there is no such device yet";
  std::string_view attribute = rest;
  const std::string_view first = takeUpTo(attribute, '.');
  if (first == "coe" || first == "soe") return configureObject(place, value);
  if (first == "pdo") return configureEntry(*number, attribute, value);
  return configureAttribute(*number, rest, value);
}

std::string EtherCat::configureAttribute(uint32_t slave, std::string_view attribute, std::string_view value) {
  if (attribute == "name") return setName(slave, value);
  if (attribute == "refuse") return setRefused(slave, value);
  if (attribute == "motor") return setMotor(slave, value);
  if (attribute != "ds402")
    return "a device has coe, soe, pdo, name, refuse, ds402, motor, not '" + std::string(attribute) + "'";
  bool isDrive = false;
  std::string wrong = setFlag(isDrive, value);
  if (!wrong.empty()) return wrong;
  if (isDrive && !slaves_[slave].protocols.coe) return "a drive by CiA 402 needs the protocol coe";
  slaves_.makeDrive(slave, isDrive);
  return {};
}

std::string EtherCat::setMotor(uint32_t slave, std::string_view value) {
  if (value != "position" && value != "velocity")
    return "a motor follows position or velocity, not '" + std::string(value) + "'";
  if (!slaves_[slave].isDrive) return "a motor needs a drive: ds402 1 before it";
  slaves_.giveMotor(slave, value == "position" ? EthercatMotor::Position : EthercatMotor::Velocity);
  return {};
}

std::string EtherCat::setName(uint32_t slave, std::string_view name) {
  if (name.empty()) return "expected a name";
  for (uint32_t i = 0; i < slaves_.count(); ++i)
    if (i != slave && slaves_[i].name == name) return "device " + std::to_string(i) + " has this name";
  slaves_[slave].name = name;
  return {};
}

// Sets the state that a slave refuses; not INIT, in which all begin.
std::string EtherCat::setRefused(uint32_t slave, std::string_view value) {
  const auto number = text::wholeIn<uint32_t>(value);
  const State state = number && *number <= 8 ? stateOf(*number) : State::Unknown;
  const bool fits = number && (*number == 0 || (state != State::Unknown && state != State::Init));
  if (!fits) return "expected a state, 2, 3, 4 or 8, or 0 for none";
  slaves_[slave].refused = state;
  return {};
}

std::string EtherCat::configureObject(std::string_view place, std::string_view value) {
  EthercatObject object;
  std::string wrong = parseObjectPlace(place, object);
  if (wrong.empty()) wrong = parseObjectValue(takeUpTo(value, ' '), object);
  while (wrong.empty() && !value.empty())
    if (const std::string_view option = takeUpTo(value, ' '); !option.empty()) wrong = setOption(object, option);
  if (!wrong.empty()) return wrong;
  const EthercatProtocols& spoken = slaves_[object.slave].protocols;
  if (!(object.isIdn ? spoken.soe : spoken.coe)) return "the device does not have this protocol";
  return slaves_.addObject(object);
}

// "Inputs.Status_word" and "0x6041.0".
std::string EtherCat::configureEntry(uint32_t slave, std::string_view place, std::string_view value) {
  const std::string_view group = takeUpTo(place, '.');
  if ((group != "Inputs" && group != "Outputs") || place.empty())
    return "expected pdo.Inputs.ENTRY or pdo.Outputs.ENTRY";
  EthercatObject object;
  const std::string wanted = std::to_string(slave) + ".coe." + std::string(value);
  if (!parseObjectPlace(wanted, object).empty()) return "expected INDEX.SUBINDEX of an object";
  const uint32_t found = slaves_.objectOfEntry(slave, object.index, object.sub);
  if (found == RUNG_NONE) return "there is no object " + std::string(value) + " yet";
  image_.add(slave, group == "Inputs", place, found);
  return {};
}

// ---- events ------------------------------------------------------------------------------------------------------

std::string EtherCat::unknownSlave(uint32_t slave) const {
  return slave < slaves_.count() ? "" : "there is no EtherCAT device " + std::to_string(slave);
}

std::string EtherCat::setError(uint32_t slave, uint32_t code) {
  std::string wrong = unknownSlave(slave);
  if (wrong.empty()) slaves_[slave].injectedError = code;
  return wrong;
}

std::string EtherCat::setSilent(uint32_t slave, bool isSilent) {
  std::string wrong = unknownSlave(slave);
  if (wrong.empty()) slaves_[slave].isSilent = isSilent;
  return wrong;
}

std::string EtherCat::fault(uint32_t slave, uint32_t code) {
  if (std::string wrong = unknownSlave(slave); !wrong.empty()) return wrong;
  if (!slaves_[slave].isDrive) return "EtherCAT device " + std::to_string(slave) + " is not a drive: ds402 1";
  if (code > 0xFFFF) return "an error code of a drive has 16 bits";
  slaves_[slave].drive.fault(static_cast<uint16_t>(code));
  return {};
}

// ---- quantities --------------------------------------------------------------------------------------------------

std::optional<uint64_t> EtherCat::object(uint32_t slave, uint32_t index, uint32_t sub) const {
  const uint32_t found = slaves_.find(slave, false, index, sub);
  return found == RUNG_NONE ? std::nullopt : std::optional(slaves_.objectAt(found).value);
}

std::optional<uint64_t> EtherCat::idn(uint32_t slave, uint32_t idn, uint32_t drive) const {
  const uint32_t found = slaves_.find(slave, true, idn, drive);
  return found == RUNG_NONE ? std::nullopt : std::optional(slaves_.objectAt(found).value);
}

bool EtherCat::setObject(uint32_t slave, uint32_t index, uint32_t sub, uint64_t value) {
  return slaves_.set(slaves_.find(slave, false, index, sub), value);
}

bool EtherCat::setIdn(uint32_t slave, uint32_t idn, uint32_t drive, uint64_t value) {
  return slaves_.set(slaves_.find(slave, true, idn, drive), value);
}

std::optional<EthercatState> EtherCat::slaveState(uint32_t slave) const {
  return slave < slaves_.count() ? std::optional(slaves_[slave].state) : std::nullopt;
}

} // namespace rung::sim::technol
