// The data that the control exchanges with a program.
#include "sim/technol/exchange.h"

#include <algorithm>
#include <cstring>

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/text/number.h"

namespace rung::sim::technol {

std::string Exchange::configure(std::string_view key, std::string_view value) {
  std::string problem;
  if (!ports_.configure(key, value, problem)) connections_.configure(key, value);
  return problem;
}

void Exchange::beforeInit(runtime::Instance& instance, bool powerOn) {
  program_ = &instance.program();
  shared_.clear();
  defined_ = false;
  if (powerOn) {
    cells_.reset();
    ports_.reset(instance);
  }
  connections_.preset(instance);
}

void Exchange::afterInit(runtime::Instance& instance) {
  connections_.build(instance, shared_, cells_);
  defined_ = false;
}

void Exchange::programChanged(runtime::Instance& instance) {
  if (program_ == nullptr) return; // before the first power-on
  shared_.relocate(runtime::Relocation(*program_, instance.program()));
  program_ = &instance.program();
  ports_.locate(instance);
  afterInit(instance);
}

bool Exchange::settle(runtime::Instance& instance) {
  const bool isPossible = shared_.settle(instance.program()) && cells_.settle();
  connections_.rebuild(instance, shared_, cells_);
  return isPossible;
}

uint32_t Exchange::works() const {
  constexpr uint32_t kPorts = 1u << nc::kHookBeforeInput | 1u << nc::kHookAfterMain;
  return connections_.configured() ? kPorts | 1u << nc::kHookFast | 1u << nc::kHookFastest : kPorts;
}

void Exchange::onHook(runtime::Instance& instance, uint32_t hook) {
  if (defined_) afterInit(instance); // variables were defined outside MODULE_INIT
  switch (hook) {
  case nc::kHookBeforeInput:
    ports_.beforeProgram(instance);
    connections_.copy(instance, cells_, nc::ExchangePeriod::Slow);
    return;
  case nc::kHookAfterMain:
    connections_.copy(instance, cells_, nc::ExchangePeriod::Slow);
    ports_.afterProgram(instance);
    return;
  case nc::kHookFast: connections_.copy(instance, cells_, nc::ExchangePeriod::Fast); return;
  case nc::kHookFastest: connections_.copy(instance, cells_, nc::ExchangePeriod::Fastest); return;
  default: return;
  }
}

void Exchange::define(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
  const auto variable = variableOf(request);
  if (!variable) return;
  bool isNew = false;
  if (!shared_.define(instance.program(), *variable, isNew)) return;
  defined_ = defined_ || isNew;
  reply.results[0] = 1;
  const auto otherwise = connections_.defaultOf(*variable);
  reply.results[1] = otherwise ? 1 : 0;
  reply.results[2] = static_cast<int64_t>(otherwise.value_or(0));
}

bool Exchange::respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
  using nc::technol::ServiceKind;
  const auto kind = static_cast<ServiceKind>(request.name->kind);
  if (kind != ServiceKind::Define && kind != ServiceKind::UpdateInput) return false;
  reply.ticket = request.ticket;
  reply.state = RUNG_SERVICE_DONE;
  reply.resultCount = 3;
  if (kind == ServiceKind::Define)
    define(instance, request, reply);
  else
    connections_.update(instance, cells_, request, reply);
  return true;
}

// Forcing and shorted outputs.

namespace {

constexpr uint8_t kNoShortReports = 2;  // IO_DIS_ERPIS (man. l.3526)
constexpr uint32_t kOutputsOfAUnit = 3; // OP0 to OP2

} // namespace

bool Ports::configure(std::string_view key, std::string_view value, std::string& problem) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  if (!nc::technol::takePrefix(rest, "CAN[1].INOUT08")) return false;
  const uint32_t unit = nc::technol::takeIndex(rest).value_or(0);
  const auto control = text::wholeIn<uint8_t>(value);
  if (rest != ".CONTROL" || unit >= kUnits)
    problem = "'" + std::string(key) + "' is not a unit's control byte: CAN[1].INOUT08[0].CONTROL to [31]";
  else if (!control)
    problem = "'" + std::string(key) + "' takes 0 to 255";
  else
    control_[unit] = *control;
  return true;
}

Ports::Family Ports::familyOf(const runtime::Instance& instance, const char* first, const char* second) {
  const auto a = nc::technol::signalPlace(instance.program(), first),
             b = nc::technol::signalPlace(instance.program(), second);
  return a && b ? Family{a->space, a->byte, b->byte - a->byte} : Family{};
}

std::optional<uint32_t> Ports::Family::find(uint32_t inSpace, uint32_t byte, uint32_t count) const {
  if (inSpace != space || stride == 0 || byte < first || (byte - first) % stride != 0) return std::nullopt;
  const uint32_t number = (byte - first) / stride;
  return number < count ? std::optional(number) : std::nullopt;
}

uint8_t Ports::read(const runtime::Instance& instance, const Family& family, uint32_t number) {
  return instance.memory().readByte(family.space, family.first + number * family.stride);
}

void Ports::write(runtime::Instance& instance, const Family& family, uint32_t number, uint8_t value) {
  instance.memory().writeByte(family.space, family.first + number * family.stride, value);
}

void Ports::reset(const runtime::Instance& instance) {
  in_.fill({});
  out_.fill({});
  active_ = false;
  locate(instance);
}

void Ports::locate(const runtime::Instance& instance) {
  inputs_ = familyOf(instance, "P1IN", "P2IN");
  outputs_ = familyOf(instance, "P0OUT", "P1OUT");
  lowIn_ = familyOf(instance, "SETL_P1IN", "SETL_P2IN");
  highIn_ = familyOf(instance, "SETH_P1IN", "SETH_P2IN");
  lowOut_ = familyOf(instance, "SETL_P0OUT", "SETL_P1OUT");
  highOut_ = familyOf(instance, "SETH_P0OUT", "SETH_P1OUT");
  shorts_ = familyOf(instance, "ERRLI_P0OUT", "ERRLI_P1OUT");
  findSwitches(instance);
}

// Finds the places of the cells in the block, with adjacent ones joined.
void Ports::findSwitches(const runtime::Instance& instance) {
  switches_.clear();
  const auto add = [&](const Family& family, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      const core::Place at = instance.memory().locateBit(family.space, family.first + i * family.stride, 0);
      const core::Place last = instance.memory().locateBit(family.space, family.first + i * family.stride, 7);
      if (!at.outside()) switches_.push_back({at.offset(), last.offset() - at.offset() + 1});
    }
  };
  add(shorts_, kOutputs);
  add(lowIn_, kInputs);
  add(highIn_, kInputs);
  add(lowOut_, kOutputs);
  add(highOut_, kOutputs);
  std::sort(switches_.begin(), switches_.end(), [](const Span& a, const Span& b) { return a.offset < b.offset; });
  size_t made = 0;
  for (const Span& span : switches_) {
    if (made > 0 && switches_[made - 1].offset + switches_[made - 1].size == span.offset)
      switches_[made - 1].size += span.size;
    else
      switches_[made++] = span;
  }
  switches_.resize(made);
}

bool Ports::anySwitch(const runtime::Instance& instance) const {
  const uint8_t* block = instance.block().data();
  for (const Span& span : switches_) {
    const uint8_t* at = block + span.offset;
    uint64_t any = 0;
    uint32_t left = span.size;
    for (; left >= 8; left -= 8, at += 8) { // without an exit, so that the compiler takes several at once
      uint64_t word = 0;
      std::memcpy(&word, at, 8);
      any |= word;
    }
    for (; left > 0; --left, ++at) any |= *at;
    if (any != 0) return true;
  }
  return false;
}

// Restores forced bits, except those that have changed since they were forced.
void Ports::restore(runtime::Instance& instance, const Family& family, uint32_t number, Port& port) {
  if (!port.active) return;
  const uint8_t now = read(instance, family, number);
  const auto changed = static_cast<uint8_t>(now ^ port.forced);
  write(instance, family, number, static_cast<uint8_t>((port.own & ~changed) | (now & changed)));
  port.active = false;
}

// Forces bits; low takes precedence over high.
void Ports::force(runtime::Instance& instance, const Family& family, uint32_t number, Port& port, uint8_t high,
                  uint8_t low) {
  if ((high | low) == 0) return;
  port.own = read(instance, family, number);
  port.forced = static_cast<uint8_t>((port.own | high) & ~low);
  port.active = true;
  write(instance, family, number, port.forced);
}

// The outputs that are zeroed until the program has acknowledged their error. A unit with error reports disabled has
// none.
uint8_t Ports::shorted(runtime::Instance& instance, uint32_t output) const {
  const uint8_t errors = read(instance, shorts_, output);
  if (errors == 0 || (control_[output / kOutputsOfAUnit] & kNoShortReports) == 0) return errors;
  write(instance, shorts_, output, 0);
  return 0;
}

void Ports::beforeProgram(runtime::Instance& instance) {
  const bool now = anySwitch(instance);
  if (!now && !active_) return;
  for (uint32_t i = 0; i < kOutputs; ++i) {
    restore(instance, outputs_, i, out_[i]);
    shorted(instance, i);
  }
  for (uint32_t i = 0; i < kInputs; ++i) {
    restore(instance, inputs_, i, in_[i]);
    force(instance, inputs_, i, in_[i], read(instance, highIn_, i), read(instance, lowIn_, i));
  }
  active_ = now;
}

void Ports::afterProgram(runtime::Instance& instance) {
  if (!anySwitch(instance)) return;
  active_ = true;
  for (uint32_t i = 0; i < kOutputs; ++i) {
    const auto low = static_cast<uint8_t>(read(instance, lowOut_, i) | shorted(instance, i));
    force(instance, outputs_, i, out_[i], read(instance, highOut_, i), low);
  }
}

void Ports::beforeWrite(runtime::Instance& instance, const runtime::Ref& place) {
  if (!active_) return;
  const uint32_t bits = place.bit + place.width * place.count;
  for (uint32_t byte = place.byte; byte < place.byte + (bits + 7) / 8; ++byte) {
    if (const auto input = inputs_.find(place.space, byte, kInputs)) restore(instance, inputs_, *input, in_[*input]);
    if (const auto output = outputs_.find(place.space, byte, kOutputs))
      restore(instance, outputs_, *output, out_[*output]);
  }
}

} // namespace rung::sim::technol
