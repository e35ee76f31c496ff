// Names, addresses and their comments (see names.h).
#include "tools/view/names.h"

#include <optional>

#include <fmt/format.h>

#include "frontend/dialects/gsk/gsk.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/nct/signals.h"
#include "rtlib/text/number.h"

namespace rung::view {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

} // namespace

Names::Names(const frontend::Dialect& dialect, const ir::Module& module, const std::vector<ladder::LadderFile>& files)
    : gsk_(&dialect == &gsk::kGsk) {
  for (const ir::Space& space : module.spaces) spaceFlags_.emplace(space.name, space.flags);
  if (!module.retains.empty()) ownMemory_ = module.retains[0].byte;
  std::unordered_map<std::string_view, const ir::Symbol*> symbols;
  for (const ir::Symbol& symbol : module.symbols) symbols.emplace(symbol.name, &symbol);
  for (const ladder::LadderFile& file : files) {
    for (const ladder::Declaration& declaration : file.declarations) {
      const auto at = symbols.find(declaration.name.text);
      if (declaration.kind == ladder::DeclarationKind::Const)
        constants_.emplace(declaration.name.text, declaration.value.text);
      else if (at != symbols.end())
        addSymbol(module, *at->second);
    }
  }
  for (const ir::Symbol& symbol : module.symbols) addSymbol(module, symbol); // those that the dialect declares
  addSignals();
}

void Names::addSymbol(const ir::Module& module, const ir::Symbol& symbol) {
  if (!symbol.space.valid()) return; // a constant
  const std::string_view space = module.spaces[symbol.space.index].name;
  const bool isBit = symbol.type == RUNG_TYPE_BIT;
  add({{space, symbol.byte, symbol.bit, isBit}, symbol.name, symbol.comment});
}

// The first name of a place is the one that its address is told by, and declared names come first.
void Names::add(const Known& known) {
  const auto index = static_cast<uint32_t>(known_.size());
  if (!byName_.emplace(known.name, index).second) return;
  known_.push_back(known);
  byAddress_.emplace(textOf(known.place), index);
}

void Names::addSignals() {
  const nc::SignalTable& table = gsk_ ? nc::gskSignals() : nc::nctSignals();
  for (const nc::Signal& signal : table) {
    const bool isBit = signal.type == nc::SignalType::Bit;
    add({{signal.area, signal.byteOffset + signal.bit / 8, signal.bit % 8u, isBit}, signal.symbol, signal.meaning});
  }
}

std::string Names::textOf(const Place& place) const {
  if (gsk_) return fmt::format("{}{}", place.space, place.byte) + (place.isBit ? fmt::format(".{}", place.bit) : "");
  const uint32_t bit = place.byte % 4 * 8 + place.bit;
  return fmt::format("{:04}", place.byte / 4) + (place.isBit ? fmt::format(".{:02}", bit) : "");
}

const Names::Known* Names::known(std::string_view name) const {
  const auto at = byName_.find(name);
  return at == byName_.end() ? nullptr : &known_[at->second];
}

// Inputs and outputs of NCT share a space.
void Names::setTraffic(Named& named, const Place& place) const {
  if (!gsk_) named.input = named.output = place.byte < ownMemory_;
  const auto at = spaceFlags_.find(place.space);
  if (!gsk_ || at == spaceFlags_.end()) return;
  named.input = (at->second & RUNG_SPACE_INPUT) != 0;
  named.output = (at->second & RUNG_SPACE_OUTPUT) != 0;
}

Named Names::atAddress(const Place& place) const {
  Named named;
  named.key = textOf(place);
  setTraffic(named, place);
  const auto at = byAddress_.find(named.key);
  if (at == byAddress_.end()) return named;
  named.address = known_[at->second].name;
  named.comment = known_[at->second].comment;
  return named;
}

std::string_view Names::valueOf(std::string_view operand) const {
  const auto at = constants_.find(operand);
  return at == constants_.end() ? operand : at->second;
}

Named Names::find(std::string_view operand) const {
  const auto constant = constants_.find(operand);
  if (constant != constants_.end()) return {std::string(constant->second), {}, std::string(operand)};
  return gsk_ ? findGsk(operand) : findNct(operand);
}

// A name, or an area's letter and numbers.
Named Names::findGsk(std::string_view operand) const {
  if (const Known* name = known(operand)) {
    const std::string address = textOf(name->place);
    Named named{address, std::string(name->comment), address};
    setTraffic(named, name->place);
    return named;
  }
  if (operand.size() < 2 || !isDigit(operand[1])) return {{}, {}, isDigit(operand[0]) ? "" : std::string(operand)};
  const size_t point = operand.find('.');
  const auto byte = text::numberIn<uint32_t>(operand.substr(1, point == std::string_view::npos ? point : point - 1));
  const auto bit = point == std::string_view::npos ? 0u : text::numberIn<uint32_t>(operand.substr(point + 1));
  if (!byte || !bit || std::string_view("XYFGRDCTAK").find(operand[0]) == std::string_view::npos)
    return {{}, {}, isDigit(operand[0]) ? "" : std::string(operand)};
  return atAddress({operand.substr(0, 1), *byte, *bit, point != std::string_view::npos});
}

// [!] base [.bit | :register] [,index]; base is four digits or a name.
Named Names::findNct(std::string_view operand) const {
  const size_t start = operand.find_first_not_of("@%!");
  if (start == std::string_view::npos || operand[start] == '#' || operand[start] == '*') return {};
  operand.remove_prefix(start);
  const size_t end = std::min(operand.find_first_of(".:,"), operand.size());
  const std::string_view base = operand.substr(0, end);
  const std::string_view rest = operand.substr(end);
  const bool numeric = isDigit(base[0]);
  Place place;
  const Known* name = numeric ? nullptr : known(base);
  if (name != nullptr) {
    place = name->place;
  } else if (const auto word = text::numberIn<uint32_t>(base)) {
    place.byte = *word * 4;
  } else {
    return {{}, {}, std::string(base)};
  }
  const size_t comma = rest.find(',');
  const std::string_view bit = rest.substr(0, comma);
  const std::string_view index = comma == std::string_view::npos ? "" : rest.substr(comma + 1);
  std::string open; // what is known at run time only
  if (bit.starts_with('.')) {
    const uint32_t value = text::numberIn<uint32_t>(bit.substr(1)).value_or(0);
    place.isBit = true;
    place.byte = place.byte / 4 * 4 + value / 8;
    place.bit = value % 8;
  } else {
    open = bit;
  }
  std::string_view constant = valueOf(index);
  if (constant.starts_with('#') && text::numberIn<uint32_t>(constant.substr(1)))
    place.byte += 4 * *text::numberIn<uint32_t>(constant.substr(1));
  else if (!index.empty())
    open.append(",").append(index);
  Named named = atAddress(place);
  if (name != nullptr) {
    named.address = named.key + open;
    named.comment = name->comment;
  }
  if (!open.empty()) named.key += open;
  return named;
}

} // namespace rung::view
