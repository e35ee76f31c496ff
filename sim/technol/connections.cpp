// The table of connections.
#include "sim/technol/connections.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/control/technol/values.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/nc/technol/signals.h"
#include "sim/technol/exchange.h"

namespace rung::sim::technol {

namespace {

using host::inQuotes;

constexpr std::string_view kAnalogueIn = "ANALOG_INPUT_PHYSICAL", kAnalogueOut = "ANALOG_OUTPUT_PHYSICAL";

std::string canonicalOf(std::string_view written) { return nc::technol::canonical(nc::memoryText(written)); }

bool isFlag(const std::optional<double>& attribute) { return attribute.value_or(0) != 0; }

} // namespace

// ---- configuration --------------------------------------------------------------------------------------------------

void Connections::connect(std::string_view source, std::string_view destination) {
  connections_.push_back(
      {.source = std::string(source), .destination = std::string(destination), .number = connects_++, .place = {}});
}

void Connections::configure(std::string_view key, std::string_view value) {
  constexpr std::pair<std::string_view, std::optional<double> Attributes::*> kNames[] = {
      {"INVERT", &Attributes::invert},      {"SCALE", &Attributes::scale}, {"OFFSET", &Attributes::offset},
      {"MINVAL", &Attributes::least},       {"MAXVAL", &Attributes::most}, {"DEFAULT", &Attributes::otherwise},
      {"PORT", &Attributes::port},          {"BIT", &Attributes::bit},     {"PHYSNO", &Attributes::physical},
      {"CONNECTED", &Attributes::connected}};
  const std::string name = canonicalOf(key);
  const size_t point = name.rfind('.');
  if (point == std::string::npos) return;
  for (const auto& [attribute, member] : kNames) {
    if (std::string_view(name).substr(point + 1) != attribute) continue;
    Attributes& attributes = attributes_[name.substr(0, point)];
    attributes.*member = nc::technol::realOf(value);
    if (!(attributes.*member)) attributes.wrong = std::string(key) + " is not a number: " + inQuotes(value);
  }
}

void Connections::take(std::span<const host::ConnectionDefinition> connections,
                       std::span<const host::TerminalDefinition> terminals) {
  for (const host::ConnectionDefinition& given : connections)
    if (given.connected)
      connections_.push_back({.source = given.source,
                              .destination = given.destination,
                              .invert = given.invert,
                              .scale = given.scale,
                              .offset = given.offset,
                              .number = RUNG_NONE,
                              .place = given.place});
  for (const host::TerminalDefinition& given : terminals) {
    Attributes& attributes = attributes_[canonicalOf(given.id)];
    attributes = {.invert = given.invert,
                  .scale = given.scale,
                  .offset = given.offset,
                  .least = given.least,
                  .most = given.most,
                  .otherwise = given.otherwise,
                  .connected = given.connected,
                  .port = given.port,
                  .bit = given.bit,
                  .physical = given.physical,
                  .wrong = {},
                  .place = given.place};
    const bool analogue =
        given.kind == host::TerminalKind::AnalogInput || given.kind == host::TerminalKind::AnalogOutput;
    if (analogue && given.connected) channels_.emplace_back(given.kind, given.physical);
  }
}

const Connections::Attributes* Connections::attributesOf(std::string_view canonicalName) const {
  const auto found = attributes_.find(canonicalName);
  return found == attributes_.end() ? nullptr : &found->second;
}

// The attributes of a variable: `PLC.Input.ID.Scale` applies only to that input, `ID.Scale` to all with this
// identifier.
const Connections::Attributes* Connections::attributesOf(const SharedVariable& variable) const {
  const std::string name = nc::technol::canonical(variable.name);
  if (variable.isLogical()) {
    const char* module = variable.kind == nc::ExchangeKind::DefIn ? "PLC.INPUT." : "PLC.OUTPUT.";
    if (const Attributes* own = attributesOf(module + name)) return own;
  }
  return attributesOf(name);
}

std::optional<uint64_t> Connections::defaultOf(const SharedVariable& variable) const {
  const Attributes* attributes = attributesOf(variable);
  if (attributes == nullptr || !attributes->otherwise) return std::nullopt;
  const double value = *attributes->otherwise;
  if (variable.type == nc::ExchangeType::Real) return std::bit_cast<uint64_t>(value);
  return static_cast<uint64_t>(static_cast<int64_t>(value));
}

// ---- ends -----------------------------------------------------------------------------------------------------------

class Connections::Resolver {
public:
  Resolver(runtime::Instance& instance, const SharedVariables& variables, ModuleCells& cells)
      : instance_(instance), variables_(variables), cells_(cells) {}

  // The end of a connection; nothing, and `problem` says why, if there is no such end.
  std::optional<End> end(std::string_view written, std::string& problem) {
    const std::string name = canonicalOf(written);
    problem = inQuotes(written) + " is not an end of a connection";
    std::string_view rest = name;
    std::optional<End> made;
    if (nc::technol::takePrefix(rest, "PLC.INPUT."))
      made = logical(nc::ExchangeKind::DefIn, rest, problem);
    else if (nc::technol::takePrefix(rest, "PLC.OUTPUT."))
      made = logical(nc::ExchangeKind::DefOut, rest, problem);
    else if (nc::technol::takePrefix(rest, "CAN"))
      made = unit(rest, problem);
    else if (name.starts_with("RTM.") || name.starts_with("ECAT.") || name.starts_with("VKEYBOARD."))
      made = module(name, problem);
    else
      made = cell(name, problem);
    return made;
  }

  std::optional<End> variable(const SharedVariable& found, uint32_t element, std::optional<uint32_t> bit,
                              std::string& problem) {
    if (element >= (found.isText() ? 1 : found.count))
      return no(problem, "it has " + std::to_string(found.count) + " elements, counted from 0");
    auto made = ofBit(placeOf(found, element), bit, found.type, problem);
    if (!made) return made;
    made->period = found.period;
    made->variable = &found;
    made->isDestination = found.isInput();
    made->isSource = !made->isDestination;
    if (found.kind == nc::ExchangeKind::DefIn) made->target = Wire::targetOf(found.space, placeOf(found, element).byte);
    made->whole = !bit;
    return made;
  }

private:
  static std::optional<End> no(std::string& problem, std::string_view reason) {
    problem.append(": ").append(reason);
    return std::nullopt;
  }

  std::optional<End> ofBit(const runtime::Ref& place, std::optional<uint32_t> bit, nc::ExchangeType type,
                           std::string& problem) {
    if (!bit) return End{.pin = pinAt(instance_.program(), place, type)};
    const auto at = runtime::bitOf(place, *bit);
    if (!at) return no(problem, "it has no bit " + std::to_string(*bit));
    return End{.pin = pinAt(instance_.program(), *at, nc::ExchangeType::Bit)};
  }

  std::optional<End> logical(nc::ExchangeKind kind, const std::string_view identifier, std::string& problem) {
    const nc::technol::Reference whole{.base = identifier, .element = 0, .bit = {}},
        bit = nc::technol::withoutBit(identifier);
    for (const nc::technol::Reference& tried : {whole, withoutIndex(whole), bit, withoutIndex(bit)})
      if (const SharedVariable* found = variables_.logical(kind, tried.base))
        return variable(*found, tried.element, tried.bit, problem);
    return no(problem, kind == nc::ExchangeKind::DefIn ? "the program defines no input of this identifier (DEF_IN)"
                                                       : "the program defines no output of this identifier (DEF_OUT)");
  }

  std::optional<End> port(bool input, uint32_t number, std::optional<uint32_t> bit, std::string& problem) {
    const auto place = nc::technol::signalPlace(instance_.program(), input ? "P" + std::to_string(number) + "IN"
                                                                           : "P" + std::to_string(number) + "OUT");
    const bool there = input ? number >= 1 && number <= Ports::kInputs : number < Ports::kOutputs;
    if (!place || !there)
      return no(problem, input ? "input ports are P1IN to P128IN" : "output ports are P0OUT to P95OUT");
    auto made = ofBit(*place, bit, nc::ExchangeType::Uns8, problem);
    if (!made) return made;
    made->isSource = input;
    made->isDestination = !input;
    return made;
  }

  // CAN[1].INOUT08[i].IPk or .OPk; units count from 0 (man. l.12485, l.13286).
  std::optional<End> unit(std::string_view rest, std::string& problem) {
    constexpr std::string_view kForms = "there are CAN[1].INOUT08[0] to [31] with IP0 to IP3 and OP0 to OP2";
    if (!nc::technol::takePrefix(rest, "[1].INOUT08")) return no(problem, kForms);
    const uint32_t number = nc::technol::takeIndex(rest).value_or(0);
    const bool input = rest.starts_with(".IP");
    const nc::technol::Reference reference = nc::technol::withoutBit(rest);
    const auto member = nc::technol::decimal(reference.base.substr(std::min<size_t>(3, reference.base.size())));
    const bool named = (input || rest.starts_with(".OP")) && member && *member < (input ? 4u : 3u);
    if (!named || number >= Ports::kUnits) return no(problem, kForms);
    return port(input, input ? 4 * number + 1 + *member : 3 * number + *member, reference.bit, problem);
  }

  std::optional<End> module(const std::string& name, std::string& problem) {
    const nc::technol::Reference reference = nc::technol::withoutBit(name);
    std::string reason;
    const auto element = cells_.element(reference.base, reason);
    if (!element) return no(problem, reason.empty() ? "this module has no such element" : reason);
    End made;
    made.period = element->period;
    made.isSource = element->isSource;
    made.isDestination = element->isDestination;
    made.pin.cell = cells_.cellOf(*element);
    made.pin.type = cells_.at(made.pin.cell).type;
    made.pin.kind = reference.bit ? Pin::Kind::CellBit : Pin::Kind::Cell;
    made.isOpen = element->typeIsOpen && !reference.bit;
    made.signIsOpen = element->signIsOpen && !reference.bit;
    if (!reference.bit) return made;
    const uint32_t width = element->typeIsOpen ? 64 : widthOf(made.pin.type);
    if (made.pin.type == nc::ExchangeType::Real || *reference.bit >= width)
      return no(problem, "it has no bit " + std::to_string(*reference.bit));
    made.pin.type = nc::ExchangeType::Bit;
    made.pin.bit = static_cast<uint8_t>(*reference.bit);
    return made;
  }

  // P2IN.2, P1OUT, ANALOG_INPUT_PHYSICAL[n], a variable of MAP_* or DEF_*.
  std::optional<End> cell(std::string_view name, std::string& problem) {
    nc::technol::Reference reference = nc::technol::withoutBit(name);
    const size_t point = reference.base.rfind('.');
    if (!reference.bit && point != std::string_view::npos) {
      reference.bit = nc::technol::decimal(reference.base.substr(point + 1));
      if (reference.bit) reference.base = reference.base.substr(0, point);
    }
    std::string_view digits = reference.base;
    if (nc::technol::takePrefix(digits, "P") && (digits.ends_with("IN") || digits.ends_with("OUT"))) {
      const bool input = digits.ends_with("IN");
      digits.remove_suffix(input ? 2 : 3);
      if (const auto number = nc::technol::decimal(digits)) return port(input, *number, reference.bit, problem);
    }
    for (const std::string_view array : {kAnalogueIn, kAnalogueOut}) {
      const nc::technol::Reference element = withoutIndex(reference);
      if (element.base != array || reference.bit) continue;
      const auto place = nc::technol::signalPlace(instance_.program(), array);
      const auto at = place ? runtime::element(*place, element.element) : std::nullopt;
      if (!at) return no(problem, "channels are 0 to 99");
      End made{.pin = pinAt(instance_.program(), *at, nc::ExchangeType::Real)};
      made.isSource = array == kAnalogueIn;
      made.isDestination = !made.isSource;
      return made;
    }
    const auto place = nc::resolve(instance_.program(), reference.base);
    if (!place) return no(problem, "there is no module, port or variable of this name");
    uint32_t element = 0;
    const SharedVariable* found = place->kind == runtime::RefKind::Constant ? nullptr : variables_.at(*place, element);
    if (found == nullptr)
      return no(problem, "only variables of MAP_IN, MAP_OUT, MAP_AIN, MAP_AOUT, DEF_IN and DEF_OUT can be connected");
    return variable(*found, element, reference.bit, problem);
  }

  runtime::Instance& instance_;
  const SharedVariables& variables_;
  ModuleCells& cells_;
};

// ---- the table ------------------------------------------------------------------------------------------------------

namespace {

// The type of an integer of process data: it is signed, or a real, if the other end is.
nc::ExchangeType withSignOf(nc::ExchangeType integer, nc::ExchangeType other) {
  using enum nc::ExchangeType;
  if (other != Int8 && other != Int16 && other != Int32 && other != Int64 && other != Real) return integer;
  switch (integer) {
  case Uns8: return Int8;
  case Uns16: return Int16;
  case Uns32: return Int32;
  default: return Int64;
  }
}

bool addStage(Wire& wire, const Stage& stage) {
  if (stage == Stage{} || wire.stageCount == Wire::kStages) return false;
  wire.stages[wire.stageCount++] = stage;
  return true;
}

} // namespace

// Sets the conversions of the value: by the attributes of the output, of the connection, and of the input.
void Connections::shape(Wire& wire, const Connection& connection, const End& from, const End& to) const {
  wire.invert = connection.invert;
  const Attributes* output = from.variable ? attributesOf(*from.variable) : nullptr;
  const Attributes* input = to.variable ? attributesOf(*to.variable) : nullptr;
  if (output == input) input = nullptr; // the same identifier: applied once
  for (const Attributes* attributes : {output, input})
    if (attributes && isFlag(attributes->invert)) wire.invert = !wire.invert;
  const bool bits = wire.from.type == nc::ExchangeType::Bit && wire.to.type == nc::ExchangeType::Bit;
  if (bits) return;
  const auto scaled = [](double scale, double offset) { return Stage{.scale = scale, .after = offset}; };
  if (output) {
    Stage stage = scaled(output->scale.value_or(1), output->offset.value_or(0));
    const bool mapped = from.variable->kind == nc::ExchangeKind::MapAout; // l.5735-5748
    (mapped ? stage.least : stage.low) = output->least.value_or(-Stage::kInfinity);
    (mapped ? stage.most : stage.high) = output->most.value_or(Stage::kInfinity);
    addStage(wire, stage);
  }
  addStage(wire, scaled(connection.scale, connection.offset));
  if (input) {
    const bool mapped = to.variable->kind == nc::ExchangeKind::MapAin; // l.5683-5686
    Stage stage = scaled(input->scale.value_or(1), mapped ? 0 : input->offset.value_or(0));
    if (mapped) stage.before = input->offset.value_or(0);
    stage.low = input->least.value_or(-Stage::kInfinity);
    stage.high = input->most.value_or(Stage::kInfinity);
    addStage(wire, stage);
  }
}

void Connections::report(const Connection& connection, std::string text) {
  if (!connection.place.empty()) text.insert(0, connection.place + ": ");
  problems_.push_back({.connection = connection.number, .text = std::move(text)});
}

void Connections::add(Resolver& resolver, const Connection& connection) {
  std::string problem;
  const auto from = resolver.end(connection.source, problem);
  if (!from) return report(connection, problem);
  const auto to = resolver.end(connection.destination, problem);
  if (!to) return report(connection, problem);
  addWire(connection, *from, *to);
}

void Connections::addWire(const Connection& connection, const End& from, const End& to) {
  if (!from.isSource)
    return report(connection, inQuotes(connection.source) + " is an input: a connection cannot begin there");
  if (!to.isDestination)
    return report(connection, inQuotes(connection.destination) + " is an output: a connection cannot end there");
  for (const End* end : {&from, &to})
    if (const Attributes* used = end->variable ? attributesOf(*end->variable) : nullptr; used && !used->wrong.empty())
      return report(connection, used->wrong);
  const bool fromText = from.pin.kind == Pin::Kind::Text, toText = to.pin.kind == Pin::Kind::Text;
  if (fromText != toText)
    return report(connection, inQuotes(connection.source) + " and " + inQuotes(connection.destination) +
                                  " do not fit: one is a text");
  Wire wire;
  wire.from = from.pin;
  wire.to = to.pin;
  if (from.signIsOpen) wire.from.type = withSignOf(wire.from.type, wire.to.type);
  if (to.signIsOpen) wire.to.type = withSignOf(wire.to.type, wire.from.type);
  wire.period = std::max(from.period, to.period);
  wire.target = to.target;
  wire.whole = to.whole;
  wire.isBit = isMemoryBit(from.pin) && isMemoryBit(to.pin);
  shape(wire, connection, from, to);
  wires_.push_back(wire);
}

// The type of an EtherCAT element is that of the other end of its connection.
void Connections::openCells(Resolver& resolver, ModuleCells& cells) const {
  for (const Connection& connection : connections_) {
    std::string problem;
    const auto from = resolver.end(connection.source, problem), to = resolver.end(connection.destination, problem);
    if (!from || !to || from->isOpen == to->isOpen) continue;
    const Pin &open = from->isOpen ? from->pin : to->pin, &other = from->isOpen ? to->pin : from->pin;
    if (other.kind != Pin::Kind::Text) cells.at(open.cell).type = other.type;
  }
}

// Mapped variables whose own configuration connects them to a port or channel (man. l.5572-5760); ports count from 0,
// the first input port is P1IN.
void Connections::addTerminals(Resolver& resolver, const SharedVariables& variables) {
  const auto whole = [](const std::optional<double>& number) {
    return std::to_string(static_cast<int64_t>(number.value_or(0)));
  };
  for (const SharedVariable& variable : variables.all()) {
    const Attributes* given = variable.isMapped() ? attributesOf(variable) : nullptr;
    if (given == nullptr || !isFlag(given->connected)) continue;
    const std::string bit = "." + whole(given->bit), channel = "[" + whole(given->physical) + "]";
    std::string terminal, problem;
    switch (variable.kind) {
    case nc::ExchangeKind::MapIn: terminal = "P" + whole(given->port.value_or(0) + 1) + "IN" + bit; break;
    case nc::ExchangeKind::MapOut: terminal = "P" + whole(given->port) + "OUT" + bit; break;
    case nc::ExchangeKind::MapAin: terminal = std::string(kAnalogueIn) + channel; break;
    case nc::ExchangeKind::MapAout: terminal = std::string(kAnalogueOut) + channel; break;
    case nc::ExchangeKind::DefIn:
    case nc::ExchangeKind::DefOut:
    case nc::ExchangeKind::Variable:
    case nc::ExchangeKind::Bit: continue;
    }
    Connection connection{.source = terminal, .destination = variable.name, .place = given->place};
    if (!variable.isInput()) std::swap(connection.source, connection.destination);
    const auto far = resolver.end(terminal, problem), near = resolver.variable(variable, 0, std::nullopt, problem);
    if (!far || !near)
      report(connection, problem);
    else
      addWire(connection, variable.isInput() ? *far : *near, variable.isInput() ? *near : *far);
  }
}

// Bits that several connections set are ORed (man. l.5563): the first connection sets the bit, the others are ORed to
// it. All have the period of the fastest of them.
void Connections::order() {
  const auto key = [](const Wire& wire) {
    const bool inCell = wire.to.kind == Pin::Kind::CellBit || wire.to.kind == Pin::Kind::Cell;
    if (inCell) return uint64_t{1} << 63 | uint64_t{wire.to.cell} << 8 | wire.to.bit;
    return uint64_t{wire.to.located.offset()} << 8 | wire.to.located.bit();
  };
  const auto isJoined = [](const Wire& wire) {
    return wire.to.type == nc::ExchangeType::Bit && wire.period != nc::ExchangePeriod::OnDemand;
  };
  std::unordered_map<uint64_t, std::pair<uint32_t, nc::ExchangePeriod>> setters; // first wire, and the fastest period
  for (uint32_t i = 0; i < wires_.size(); ++i) {
    Wire& wire = wires_[i];
    if (!isJoined(wire)) continue;
    const auto [entry, isFirst] = setters.emplace(key(wire), std::pair(i, wire.period));
    wire.joins = !isFirst;
    if (wire.joins) wire.isShared = wires_[entry->second.first].isShared = true;
    entry->second.second = std::min(entry->second.second, wire.period);
  }
  for (Wire& wire : wires_)
    if (isJoined(wire)) wire.period = setters.at(key(wire)).second;
  std::vector<Wire> ordered;
  ordered.reserve(wires_.size());
  for (size_t period = 0; period < std::size(ends_); ++period) {
    std::copy_if(wires_.begin(), wires_.end(), std::back_inserter(ordered),
                 [&](const Wire& wire) { return static_cast<size_t>(wire.period) == period; });
    ends_[period] = ordered.size();
  }
  wires_ = std::move(ordered);
  targets_.clear();
  for (uint32_t i = 0; i < wires_.size(); ++i)
    if (wires_[i].target != Wire::kNoTarget) targets_.push_back({.place = wires_[i].target, .wire = i});
  std::sort(targets_.begin(), targets_.end());
}

void Connections::build(runtime::Instance& instance, const SharedVariables& variables, ModuleCells& cells) {
  rebuild(instance, variables, cells);
  for (const Wire& wire : wires_) markAnalogue(instance, wire);
}

void Connections::rebuild(runtime::Instance& instance, const SharedVariables& variables, ModuleCells& cells) {
  wires_.clear();
  problems_.clear();
  Resolver resolver(instance, variables, cells);
  openCells(resolver, cells);
  addTerminals(resolver, variables);
  for (const Connection& connection : connections_) add(resolver, connection);
  order();
}

// ---- analogue channels ----------------------------------------------------------------------------------------------

namespace {

// Sets the weight bits of ANALOG_CONNECTED (man. l.5898).
void mark(runtime::Instance& instance, uint32_t channel, bool input) {
  const auto array = nc::technol::signalPlace(instance.program(), "ANALOG_CONNECTED");
  const auto cell = array ? runtime::element(*array, channel) : std::nullopt;
  const nc::Signal* weight = findSignal(nc::technolSignals(), input ? "AIN_CONNECTED" : "AOUT_CONNECTED", "W");
  if (cell && weight) runtime::writeRaw(instance.memory(), runtime::bitRef(cell->space, cell->byte, weight->bit), 1);
}

void markByName(runtime::Instance& instance, std::string_view written) {
  const std::string name = canonicalOf(written);
  for (const std::string_view array : {kAnalogueIn, kAnalogueOut}) {
    const nc::technol::Reference element = nc::technol::withoutIndex({.base = name, .element = 0, .bit = {}});
    if (element.base == array) mark(instance, element.element, array == kAnalogueIn);
  }
}

} // namespace

void Connections::preset(runtime::Instance& instance) const {
  for (const Connection& connection : connections_) {
    markByName(instance, connection.source);
    markByName(instance, connection.destination);
  }
  for (const auto& [kind, channel] : channels_) mark(instance, channel, kind == host::TerminalKind::AnalogInput);
}

void Connections::markAnalogue(runtime::Instance& instance, const Wire& wire) {
  const auto channelOf = [&](const Pin& pin, std::string_view name) -> std::optional<uint32_t> {
    const auto array = nc::technol::signalPlace(instance.program(), name);
    if (!array || pin.place.space != array->space || pin.place.byte < array->byte) return std::nullopt;
    const uint32_t channel = (pin.place.byte - array->byte) / 8;
    return channel < array->count ? std::optional(channel) : std::nullopt;
  };
  if (const auto channel = channelOf(wire.from, kAnalogueIn)) mark(instance, *channel, true);
  if (const auto channel = channelOf(wire.to, kAnalogueOut)) mark(instance, *channel, false);
}

// ---- while the program runs -----------------------------------------------------------------------------------------

void Connections::copy(runtime::Instance& instance, ModuleCells& cells, nc::ExchangePeriod slowest) const {
  const WireMemory memory(instance, cells);
  const size_t end = ends_[static_cast<size_t>(slowest)];
  for (size_t i = 0; i < end; ++i) memory.copy(wires_[i]);
}

void Connections::copyBetweenModules(runtime::Instance& instance, ModuleCells& cells) const {
  const WireMemory memory(instance, cells);
  for (const Wire& wire : wires_)
    if (isOfModule(wire.from) && isOfModule(wire.to) && !wire.isShared) memory.copy(wire);
}

void Connections::update(runtime::Instance& instance, ModuleCells& cells, const core::ServiceRequest& request,
                         core::ServiceReply& reply) const {
  const nc::ExchangePlace at = nc::placeOfArgument(request.args[0]);
  const WireMemory memory(instance, cells);
  const uint64_t wanted = Wire::targetOf(at.space, at.byte);
  auto target = std::lower_bound(targets_.begin(), targets_.end(), Target{wanted, 0});
  uint64_t bits = 0;
  for (uint32_t i = 0; i < 8; ++i) bits |= uint64_t{instance.memory().readByte(at.space, at.byte + i)} << i * 8;
  bool joined = false;
  for (; target != targets_.end() && target->place == wanted; ++target) {
    const Wire& wire = wires_[target->wire];
    const uint64_t value = memory.valueOf(wire);
    if (wire.whole && wire.to.type == nc::ExchangeType::Bit) {
      bits = joined ? bits | value : value;
      joined = true;
    } else if (wire.whole) {
      bits = value;
    } else {
      const uint32_t bit = (wire.to.place.byte - at.byte) * 8 + wire.to.place.bit;
      bits = (bits & ~(uint64_t{1} << bit)) | value << bit;
    }
    reply.results[0] = 1;
  }
  reply.results[1] = static_cast<int64_t>(bits);
}

// Copying along a connection.

namespace {

bool isSigned(nc::ExchangeType type) {
  return type == nc::ExchangeType::Int8 || type == nc::ExchangeType::Int16 || type == nc::ExchangeType::Int32 ||
         type == nc::ExchangeType::Int64;
}

uint64_t extended(uint64_t bits, nc::ExchangeType type) {
  const uint32_t width = widthOf(type);
  if (width == 64) return bits;
  const uint64_t value = bits & ((uint64_t{1} << width) - 1);
  const uint64_t sign = uint64_t{1} << (width - 1);
  return isSigned(type) ? (value ^ sign) - sign : value;
}

double realOf(uint64_t bits, nc::ExchangeType type) {
  if (type == nc::ExchangeType::Real) return std::bit_cast<double>(bits);
  const uint64_t value = extended(bits, type);
  return type == nc::ExchangeType::Uns64 ? static_cast<double>(value)
                                         : static_cast<double>(static_cast<int64_t>(value));
}

// Rounds to the nearest integer, ties to even, saturated to the type's range; NaN gives 0.
uint64_t integerOf(double value, nc::ExchangeType type) {
  const int bits = static_cast<int>(widthOf(type)) - (isSigned(type) ? 1 : 0);
  const double end = std::ldexp(1.0, bits), rounded = std::nearbyint(value);
  if (std::isnan(value)) return 0;
  if (rounded >= end) return bits == 64 ? UINT64_MAX : (uint64_t{1} << bits) - 1;
  if (isSigned(type)) return static_cast<uint64_t>(static_cast<int64_t>(std::max(rounded, -end)));
  return rounded <= 0 ? 0 : static_cast<uint64_t>(rounded);
}

double through(const Stage& stage, double x) {
  x = (std::min(std::max(x, stage.least), stage.most) + stage.before) * stage.scale + stage.after;
  return std::min(std::max(x, stage.low), stage.high);
}

uint64_t converted(const Wire& wire, uint64_t bits) {
  const nc::ExchangeType from = wire.from.type, to = wire.to.type;
  if (from == nc::ExchangeType::Bit && wire.invert) bits ^= 1;
  const bool numeric = wire.stageCount > 0 || from == nc::ExchangeType::Real || to == nc::ExchangeType::Real;
  if (!numeric) {
    if (to != nc::ExchangeType::Bit) return extended(bits, from);
    return (extended(bits, from) != 0) != (wire.invert && from != nc::ExchangeType::Bit) ? 1 : 0;
  }
  double value = realOf(bits, from);
  for (uint8_t i = 0; i < wire.stageCount; ++i) value = through(wire.stages[i], value);
  if (to == nc::ExchangeType::Bit) return (value != 0) != (wire.invert && from != nc::ExchangeType::Bit) ? 1 : 0;
  return to == nc::ExchangeType::Real ? std::bit_cast<uint64_t>(value) : integerOf(value, to);
}

} // namespace

Pin pinAt(const rung_program& program, const runtime::Ref& place, nc::ExchangeType type) {
  const core::Memory memory(program, nullptr); // for its places only
  Pin pin{.type = type, .place = place};
  if (place.kind == runtime::RefKind::Text)
    pin.kind = Pin::Kind::Text;
  else if (place.kind == runtime::RefKind::Bit)
    pin.located = memory.locateBit(place.space, place.byte, place.bit);
  else
    pin.located = memory.locate(place.space, place.byte, bytesOf(type));
  return pin;
}

uint64_t WireMemory::read(const Pin& pin) const {
  switch (pin.kind) {
  case Pin::Kind::Memory: return memory_.read(pin.located);
  case Pin::Kind::Cell: return cells_->at(pin.cell).bits;
  case Pin::Kind::CellBit: return cells_->at(pin.cell).bits >> pin.bit & 1;
  case Pin::Kind::Text: return 0;
  }
  return 0;
}

void WireMemory::write(const Pin& pin, uint64_t bits) const {
  switch (pin.kind) {
  case Pin::Kind::Memory: memory_.write(pin.located, pin.located.width() == 1 ? bits != 0 : bits); return;
  case Pin::Kind::Cell: {
    const uint32_t width = widthOf(pin.type);
    cells_->at(pin.cell).bits = width == 64 ? bits : bits & ((uint64_t{1} << width) - 1);
    return;
  }
  case Pin::Kind::CellBit: {
    uint64_t& cell = cells_->at(pin.cell).bits;
    cell = (cell & ~(uint64_t{1} << pin.bit)) | uint64_t{bits != 0} << pin.bit;
    return;
  }
  case Pin::Kind::Text: return;
  }
}

// Copies as much as fits in the target; the last byte of a text is its terminator.
void WireMemory::copyText(const Wire& wire) const {
  const runtime::Ref &from = wire.from.place, &to = wire.to.place;
  const bool terminated = wire.to.type == nc::ExchangeType::Text;
  const uint32_t room = terminated ? to.count - 1 : to.count;
  for (uint32_t i = 0; i < to.count; ++i) {
    const uint8_t byte = i < room && i < from.count ? memory_.readByte(from.space, from.byte + i) : 0;
    memory_.writeByte(to.space, to.byte + i, byte);
  }
}

uint64_t WireMemory::valueOf(const Wire& wire) const { return converted(wire, read(wire.from)); }

void WireMemory::copy(const Wire& wire) const {
  if (wire.to.kind == Pin::Kind::Text) return copyText(wire);
  if (wire.isBit) {
    const bool value = ((memory_.read(wire.from.located) & 1) != 0) != wire.invert;
    if (value || !wire.joins) memory_.write(wire.to.located, value ? 1 : 0);
    return;
  }
  const uint64_t value = valueOf(wire);
  if (wire.joins && value == 0) return;
  write(wire.to, value);
}

// Variables that the control knows by names.

namespace {

// Logical inputs, logical outputs and all other variables have separate name spaces.
char spaceOf(nc::ExchangeKind kind) {
  if (kind == nc::ExchangeKind::DefIn) return 'I';
  return kind == nc::ExchangeKind::DefOut ? 'O' : 'S';
}

std::string keyOf(nc::ExchangeKind kind, std::string_view identifier) {
  return std::string(1, spaceOf(kind)).append(nc::technol::canonical(identifier));
}

uint32_t bytesOf(const SharedVariable& variable) { return nc::bytesOf(variable.type) * variable.count; }

bool sameMeaning(const SharedVariable& a, const SharedVariable& b) {
  return a.kind == b.kind && a.type == b.type && a.period == b.period && a.count == b.count && a.space == b.space &&
         a.byte == b.byte && a.bit == b.bit && a.least == b.least && a.most == b.most;
}

std::optional<runtime::Ref> limitOf(int64_t argument) {
  if (argument == nc::kNoPlace) return std::nullopt;
  const nc::ExchangePlace place = nc::placeOfArgument(argument);
  return runtime::realRef(place.space, place.byte);
}

} // namespace

std::optional<SharedVariable> variableOf(const core::ServiceRequest& request) {
  SharedVariable made;
  const auto what = static_cast<uint64_t>(request.args[0]);
  made.kind = static_cast<nc::ExchangeKind>(what & 0xFF);
  made.type = static_cast<nc::ExchangeType>(what >> 8 & 0xFF);
  made.period = static_cast<nc::ExchangePeriod>(what >> 16 & 0xFF);
  made.count = static_cast<uint32_t>(what >> 24);
  const nc::ExchangePlace place = nc::placeOfArgument(request.args[1]);
  made.space = place.space;
  made.byte = place.byte;
  made.bit = place.bit;
  made.least = limitOf(request.args[2]);
  made.most = limitOf(request.args[3]);
  char name[nc::kDefineBytes];
  made.name = nc::technol::charactersOf(std::span(request.args).subspan(nc::kDefineHead), name);
  if (made.name.empty() || made.kind > nc::ExchangeKind::Bit || made.type > nc::ExchangeType::Binary)
    return std::nullopt;
  return made;
}

runtime::Ref placeOf(const SharedVariable& variable, uint32_t element) {
  const uint32_t bytes = nc::bytesOf(variable.type);
  const uint32_t byte = variable.byte + element * bytes;
  switch (variable.type) {
  case nc::ExchangeType::Bit: return runtime::bitRef(variable.space, byte, variable.bit);
  case nc::ExchangeType::Real: return runtime::realRef(variable.space, byte);
  case nc::ExchangeType::Text:
  case nc::ExchangeType::Binary: {
    runtime::Ref text = runtime::intRef(variable.space, variable.byte, 8);
    text.kind = runtime::RefKind::Text;
    text.count = variable.count;
    return text;
  }
  case nc::ExchangeType::Int8:
  case nc::ExchangeType::Uns8:
  case nc::ExchangeType::Int16:
  case nc::ExchangeType::Uns16:
  case nc::ExchangeType::Int32:
  case nc::ExchangeType::Uns32:
  case nc::ExchangeType::Int64:
  case nc::ExchangeType::Uns64: return runtime::intRef(variable.space, byte, bytes * 8);
  }
  return {};
}

void SharedVariables::clear() {
  all_.clear();
  byKey_.clear();
}

bool SharedVariables::define(const rung_program& program, SharedVariable variable, bool& isNew) {
  isNew = false;
  const core::Memory bounds(program, nullptr);
  if (!bounds.contains(variable.space, variable.byte, bytesOf(variable))) return false;
  for (const auto& limit : {variable.least, variable.most})
    if (limit && !bounds.contains(limit->space, limit->byte, 8)) return false;
  const auto [entry, added] = byKey_.emplace(keyOf(variable.kind, variable.name), static_cast<uint32_t>(all_.size()));
  if (!added) return sameMeaning(all_[entry->second], variable);
  all_.push_back(std::move(variable));
  isNew = true;
  return true;
}

namespace {

// All bytes of a variable, which stay adjacent.
runtime::Ref extentOf(const SharedVariable& variable) {
  if (variable.type == nc::ExchangeType::Bit && variable.count == 1) return placeOf(variable, 0);
  runtime::Ref whole = runtime::intRef(variable.space, variable.byte, 8);
  whole.count = bytesOf(variable);
  return whole;
}

// Finds the variable in another program. False: it does not exist there completely.
bool moveTo(const runtime::Relocation& relocation, SharedVariable& variable) {
  const auto place = relocation.place(extentOf(variable));
  if (!place) return false;
  for (std::optional<runtime::Ref>* limit : {&variable.least, &variable.most}) {
    if (!*limit) continue;
    *limit = relocation.place(**limit);
    if (!*limit) return false;
  }
  variable.space = place->space;
  variable.byte = place->byte;
  if (place->kind == runtime::RefKind::Bit) variable.bit = place->bit;
  return true;
}

} // namespace

bool SharedVariables::settle(const rung_program& program) {
  std::vector<SharedVariable> loaded;
  loaded.reserve(kUsual);
  loaded.swap(all_);
  clear();
  for (SharedVariable& variable : loaded) {
    bool isNew = false;
    if (define(program, std::move(variable), isNew) && isNew) continue;
    clear();
    return false;
  }
  return true;
}

void SharedVariables::relocate(const runtime::Relocation& relocation) {
  byKey_.clear();
  uint32_t kept = 0;
  for (SharedVariable& variable : all_) {
    if (!moveTo(relocation, variable)) continue;
    byKey_.emplace(keyOf(variable.kind, variable.name), kept);
    if (&all_[kept] != &variable) all_[kept] = std::move(variable);
    ++kept;
  }
  all_.resize(kept);
}

const SharedVariable* SharedVariables::logical(nc::ExchangeKind kind, std::string_view identifier) const {
  const auto found = byKey_.find(std::string(1, spaceOf(kind)).append(identifier));
  return found == byKey_.end() ? nullptr : &all_[found->second];
}

const SharedVariable* SharedVariables::byName(std::string_view name, bool toWrite) const {
  const bool in = nc::technol::takePrefix(name, "PLC.INPUT.");
  const bool out = !in && nc::technol::takePrefix(name, "PLC.OUTPUT.");
  const auto fits = [&](const SharedVariable* v) { return v != nullptr && (!toWrite || v->isInput()); };
  const SharedVariable* input = out ? nullptr : logical(nc::ExchangeKind::DefIn, name);
  if (fits(input)) return input;
  const SharedVariable* output = in ? nullptr : logical(nc::ExchangeKind::DefOut, name);
  if (fits(output)) return output;
  const SharedVariable* other = in || out ? nullptr : logical(nc::ExchangeKind::Variable, name);
  return fits(other) ? other : nullptr;
}

std::optional<runtime::Ref> SharedVariables::find(std::string_view name, bool toWrite) const {
  const std::string inMemory = nc::technol::canonical(nc::memoryText(name));
  const nc::technol::Reference whole{.base = inMemory, .element = 0, .bit = {}},
      bit = nc::technol::withoutBit(inMemory);
  for (const nc::technol::Reference& tried : {whole, withoutIndex(whole), bit, withoutIndex(bit)}) {
    const SharedVariable* found = byName(tried.base, toWrite);
    if (found == nullptr) continue;
    if (tried.element >= (found->isText() ? 1 : found->count)) return std::nullopt;
    const runtime::Ref place = placeOf(*found, tried.element);
    return tried.bit ? runtime::bitOf(place, *tried.bit) : place;
  }
  return std::nullopt;
}

const SharedVariable* SharedVariables::at(const runtime::Ref& place, uint32_t& element) const {
  for (const SharedVariable& variable : all_) {
    if (!variable.isMapped() && !variable.isLogical()) continue;
    if (variable.space != place.space || place.byte < variable.byte) continue;
    element = (place.byte - variable.byte) / nc::bytesOf(variable.type);
    if (place.byte - variable.byte < bytesOf(variable)) return &variable;
  }
  return nullptr;
}

} // namespace rung::sim::technol
