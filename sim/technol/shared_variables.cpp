// Variables that the control knows by names (see shared_variables.h).
#include "sim/technol/shared_variables.h"

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/technol/code_page.h"

namespace rung::sim::technol {
namespace {

// One name space each for logical inputs, logical outputs, and all others.
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

// All of its bytes, which stay together.
runtime::Ref extentOf(const SharedVariable& variable) {
  if (variable.type == nc::ExchangeType::Bit && variable.count == 1) return placeOf(variable, 0);
  runtime::Ref whole = runtime::intRef(variable.space, variable.byte, 8);
  whole.count = bytesOf(variable);
  return whole;
}

// False: it is not there, or not with all of its parts.
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
