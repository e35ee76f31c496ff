// The dispatcher of the simulated NCT control (see simulator.h).
#include "sim/nct/simulator.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "rtlib/load/program_info.h"
#include "sim/retained_tables.h"

namespace rung::sim::nct {

using nc::nct::ServiceKind;

Simulator::Simulator()
    : topics_{&parameters_, &nvram_,   &machineOn_, &wiring_,   &spindles_,         &axes_,  &macros_, &screen_,
              &network_,    &mailbox_, &drives_,    &channels_, &programSelection_, &tools_, &pallets_},
      waiting_(core::ServiceQueue::kMaxPending) {}

Links Simulator::makeLinks() {
  Links links;
  links.parameters = &parameters_;
  links.channels = &channels_;
  links.axes = &axes_;
  links.spindles = &spindles_;
  links.macros = &macros_;
  links.drives = &drives_;
  links.tools = &tools_;
  links.pallets = &pallets_;
  return links;
}

Handled Simulator::config(std::string_view key, std::string_view value) {
  for (Topic* topic : topics_)
    if (Handled handled = topic->config(key, value)) return handled;
  return std::nullopt;
}

std::vector<std::string_view> Simulator::events() const {
  std::vector<std::string_view> names;
  for (const Topic* topic : topics_) names.insert(names.end(), topic->events().begin(), topic->events().end());
  return names;
}

Handled Simulator::event(std::string_view name, const std::vector<NcArgument>& keys) {
  for (Topic* topic : topics_)
    if (std::ranges::find(topic->events(), name) != topic->events().end()) return topic->event(name, keys);
  return std::nullopt;
}

std::optional<double> Simulator::quantity(std::string_view name) const {
  for (const Topic* topic : topics_)
    if (const auto value = topic->quantity(name)) return value;
  return std::nullopt;
}

Handled Simulator::setQuantity(std::string_view name, double value) {
  for (Topic* topic : topics_)
    if (Handled handled = topic->setQuantity(name, value)) return handled;
  return std::nullopt;
}

void Simulator::retain(Retained& retained) {
  for (Topic* topic : topics_) topic->retain(retained);
}

void Simulator::deliver() {
  for (Topic* topic : topics_) topic->powerOn(nc::PowerOn::Cold);
}

// ---- time --------------------------------------------------------------------------------------------------------

void Simulator::attach(runtime::Instance& instance, const SignalMemory& signals) {
  program_ = &instance.program();
  links_.signals = signals;
  links_.memory = PlcMemory(instance);
  blocks_ = {};
  const uint32_t space = runtime::findSpace(instance.program(), nc::nct::kBlockSpace);
  if (space == RUNG_NONE) return;
  const rung_space& blocks = instance.program().spaces[space];
  if (blocks.range_count == 1 && blocks.ranges[0].repr == RUNG_REPR_PACKED)
    blocks_ = instance.block().subspan(blocks.ranges[0].offset, blocks.byte_count);
}

void Simulator::powerOn(runtime::Instance& instance, const SignalMemory& signals, nc::PowerOn kind) {
  attach(instance, signals);
  waitingCount_ = 0;
  links_.nowUs = sliceUs_ = instance.nowUs();
  links_.sliceUs = 0;
  for (Topic* topic : topics_) {
    topic->dropRequests();
    topic->powerOn(kind);
  }
}

void Simulator::programChanged(runtime::Instance& instance, const SignalMemory& signals) {
  if (program_ == nullptr) return; // the NC is not simulated
  const Relocation relocation(*program_, instance.program());
  for (uint32_t i = 0; i < waitingCount_; ++i) relocation.renumber(waiting_[i].request);
  attach(instance, signals);
}

void Simulator::timeSlice(runtime::Instance& instance, bool cycle) {
  links_.sliceUs = instance.nowUs() - sliceUs_;
  links_.nowUs = sliceUs_ = instance.nowUs();
  if (cycle)
    for (Topic* topic : topics_) topic->cycle();
  for (Topic* topic : topics_) topic->timeSlice();
}

// ---- services ----------------------------------------------------------------------------------------------------

namespace {

ServiceKind kindOf(const core::ServiceRequest& request) { return static_cast<ServiceKind>(request.name->kind); }
bool isOfArrays(ServiceKind kind) { return kind == ServiceKind::ReadArray || kind == ServiceKind::WriteArray; }

} // namespace

// MACR, MACW, SCP, MOVCMND (man. 6.15-6.17). A refusal sets FL_ER=1 in the box.
Simulator::Outcome Simulator::answer(ServiceKind kind, const int64_t* args, core::ServiceReply& reply) {
  const auto give = [&](std::optional<double> value) {
    if (!value) return Outcome::Refused;
    reply.resultCount = 1;
    reply.results[0] = std::bit_cast<int64_t>(*value);
    return Outcome::Done;
  };
  switch (kind) {
  case ServiceKind::Unknown:
  case ServiceKind::ReadArray:
  case ServiceKind::WriteArray: return Outcome::Refused;
  case ServiceKind::ReadMacro: return give(macros_.read(args[0], args[1]));
  case ServiceKind::WriteMacro:
    return macros_.write(args[0], args[1], std::bit_cast<double>(args[2])) ? Outcome::Done : Outcome::Refused;
  case ServiceKind::ReadScope: return give(scope_.read(args[0], args[1], args[2]));
  case ServiceKind::MoveAxis:
    switch (axes_.load(args[0], args[1], std::bit_cast<double>(args[2]), std::bit_cast<double>(args[3]))) {
    case Axes::Load::Accepted: return Outcome::Done;
    case Axes::Load::Full: return Outcome::Later;
    case Axes::Load::Refused: return Outcome::Refused;
    }
  }
  return Outcome::Refused;
}

bool Simulator::respond(const core::ServiceRequest& request, core::ServiceReply& reply) {
  const ServiceKind kind = kindOf(request);
  if (kind == ServiceKind::Unknown || isOfArrays(kind)) return false;
  reply = {.ticket = request.ticket};
  const Outcome outcome = answer(kind, request.args, reply);
  if (outcome == Outcome::Refused) reply.state = RUNG_SERVICE_ERROR;
  return outcome != Outcome::Later;
}

std::optional<int32_t> Simulator::execute(const core::ServiceRequest& request) {
  const bool write = kindOf(request) == ServiceKind::WriteArray;
  const auto function = static_cast<uint32_t>(request.args[0]);
  const uint64_t first = static_cast<uint64_t>(request.args[2]) * 4;
  if (first > blocks_.size() || sizeof words_ > blocks_.size() - first) return 1;
  uint8_t* buffer = blocks_.data() + first;
  std::memcpy(words_.data(), buffer, sizeof words_);
  Block block(words_);
  for (Topic* topic : topics_) {
    if (!topic->serves(write, function)) continue;
    const std::optional<int32_t> code = topic->service(function, block);
    std::memcpy(buffer, words_.data(), sizeof words_);
    return code;
  }
  return 1; // man. l.3465
}

void Simulator::betweenScans(runtime::Instance& instance) {
  links_.nowUs = instance.nowUs();
  while (waitingCount_ < waiting_.size() && instance.services().take(waiting_[waitingCount_].request))
    waiting_[waitingCount_++].sinceUs = links_.nowUs;
  uint32_t left = 0;
  for (uint32_t i = 0; i < waitingCount_; ++i) {
    const core::ServiceRequest& request = waiting_[i].request;
    links_.requestAgeUs = links_.nowUs - waiting_[i].sinceUs;
    core::ServiceReply reply{.ticket = request.ticket};
    Outcome outcome = Outcome::Done;
    if (isOfArrays(kindOf(request))) {
      const std::optional<int32_t> code = execute(request);
      reply.resultCount = 1;
      reply.results[0] = code.value_or(0);
      if (!code) outcome = Outcome::Later;
    } else {
      outcome = answer(kindOf(request), request.args, reply);
    }
    if (outcome == Outcome::Refused) reply.state = RUNG_SERVICE_ERROR;
    if (outcome == Outcome::Later)
      waiting_[left++] = waiting_[i];
    else
      instance.services().complete(reply);
  }
  waitingCount_ = left;
}

} // namespace rung::sim::nct
