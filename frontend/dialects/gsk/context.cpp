// Names and operands that are addresses.
#include "frontend/dialects/gsk/context.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/gsk/instructions.h"
#include "rtlib/nc/gsk/signals.h"

namespace rung::gsk {
namespace {

bool isLetter(char c) { return upper(c) >= 'A' && upper(c) <= 'Z'; }
bool isNameChar(char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; }

bool isCommand(std::string_view text) {
  constexpr std::string_view kWords[] = {"FUNC", "PRM", "TABLE", "DIALECT", "SYMBOL"};
  if (findFunction(text) != nullptr) return true;
  for (const Row& row : allRows())
    if (row.info.number < 0 && equalNoCase(row.info.mnemonic, text)) return true;
  return std::any_of(std::begin(kWords), std::end(kWords), [&](std::string_view w) { return equalNoCase(w, text); });
}

// A name that cannot be taken for something else (P12).
bool isFreeName(std::string_view text) {
  if (text.empty() || !isLetter(text[0]) || !std::all_of(text.begin(), text.end(), isNameChar)) return false;
  const bool labelLike = (upper(text[0]) == 'L' || upper(text[0]) == 'P') && parseDigits(text.substr(1));
  return !labelLike && !splitAddress(text) && !isCommand(text);
}

std::string rangeOf(Area area) {
  const AreaInfo& info = areaInfo(area);
  return fmt::format("{0}0 to {0}{1}", info.letter, info.bytes - 1);
}

bool checkArea(Diagnostics& diagnostics, const Word& word, Area area, uint64_t byte, uint32_t length) {
  if (byte + length <= areaInfo(area).bytes) return true;
  const std::string shown = length > 1 ? fmt::format("{} with {} bytes", word.text, length) : std::string(word.text);
  diagnostics.report(Diag::AddressOutOfRange, word.range) << shown << rangeOf(area);
  return false;
}

// The range is checked by the caller, who knows the length.
std::optional<Address> addressOf(Diagnostics& diagnostics, const AddressText& text, const Word& word) {
  Address address{text.area, static_cast<uint32_t>(std::min<uint64_t>(text.byte, UINT32_MAX)), 0, text.hasPoint};
  if (!text.hasPoint) return address;
  if (text.bit.size() != 1 || text.bit[0] < '0' || text.bit[0] > '7') {
    diagnostics.report(Diag::BadBitNumber, word.range) << text.bit;
    return std::nullopt;
  }
  address.bit = static_cast<uint8_t>(text.bit[0] - '0');
  return address;
}

// Signals of the CNC and the panel whose symbols are names in the sense of P12; for `*ESP` and the like a program uses
// the address or declares a name of its own (inventory §13).
std::optional<Address> signalAddress(std::string_view name) {
  if (!isFreeName(name)) return std::nullopt;
  const nc::Signal* signal = nc::findSignal(nc::gskSignals(), name);
  if (signal == nullptr) return std::nullopt;
  const auto area = splitAddress(std::string(signal->area) + "0");
  if (!area) return std::nullopt;
  return Address{area->area, signal->byteOffset, signal->bit, signal->type == nc::SignalType::Bit};
}

struct Found {
  std::optional<Address> address;
  bool known = false; // as a name or by its shape; then nothing more is to be said about it
};

Found findAddress(Context& context, const Word& word) {
  if (const UserSymbol* symbol = context.names.findSymbol(word.text))
    return {symbol->bad ? std::nullopt : std::optional(symbol->address), true};
  if (const auto text = splitAddress(word.text)) return {addressOf(context.diagnostics, *text, word), true};
  if (const auto address = signalAddress(word.text)) return {address, true};
  return {};
}

} // namespace

bool Names::declare(Diagnostics& diagnostics, const Word& name) {
  if (name.quoted || !isFreeName(name.text)) {
    diagnostics.report(Diag::BadOperand, name.range)
        << name.text << "free name: a letter, then letters, digits and _, and no command, address, label or subprogram";
    return false;
  }
  const auto [at, isNew] = declared_.emplace(std::string(name.text), name.range);
  if (!isNew) diagnostics.report(Diag::DuplicateSymbol, name.range).note(at->second, "declared here") << name.text;
  return isNew;
}

void Names::addSymbol(Diagnostics& diagnostics, const Word& name, const Word& value, std::string_view comment) {
  if (!declare(diagnostics, name)) return;
  UserSymbol symbol{std::string(name.text), std::string(comment), {}, true, name.range};
  if (const auto text = splitAddress(value.text)) {
    if (const auto address = addressOf(diagnostics, *text, value)) {
      symbol.address = *address;
      symbol.bad = !checkArea(diagnostics, value, text->area, text->byte, 1);
    }
  } else {
    diagnostics.report(Diag::BadOperand, value.range) << value.text << "bit or byte address";
  }
  symbolByName_.emplace(symbol.name, static_cast<uint32_t>(symbols_.size()));
  symbols_.push_back(std::move(symbol));
}

void Names::addConstant(Diagnostics& diagnostics, const Word& name, const Word& value) {
  if (!declare(diagnostics, name)) return;
  const auto number = parseConstant(value.text);
  if (!number) diagnostics.report(Diag::BadOperand, value.range) << value.text << "constant";
  constants_.emplace(std::string(name.text), UserConstant{number.value_or(0), !number});
}

const UserSymbol* Names::findSymbol(std::string_view name) const {
  const auto at = symbolByName_.find(name);
  return at == symbolByName_.end() ? nullptr : &symbols_[at->second];
}

const UserConstant* Names::findConstant(std::string_view name) const {
  const auto at = constants_.find(name);
  return at == constants_.end() ? nullptr : &at->second;
}

std::optional<Address> bitOperand(Context& context, const Word& word) {
  if (!word.range.valid()) return std::nullopt;
  const Found found = findAddress(context, word);
  if (!found.known)
    context.diagnostics.report(Diag::BadOperand, word.range) << word.text << "bit address and no declared name";
  if (!found.address) return std::nullopt;
  if (!found.address->isBit) {
    context.diagnostics.report(Diag::BitAddressExpected, word.range) << word.text;
    return std::nullopt;
  }
  if (!checkArea(context.diagnostics, word, found.address->area, found.address->byte, 1)) return std::nullopt;
  return found.address;
}

std::optional<Address> byteOperand(Context& context, const Word& word, uint32_t length) {
  const Found found = findAddress(context, word);
  if (!found.known)
    context.diagnostics.report(Diag::BadOperand, word.range) << word.text << "byte address and no declared name";
  if (!found.address) return std::nullopt;
  if (found.address->isBit) {
    context.diagnostics.report(Diag::ByteAddressExpected, word.range) << word.text;
    return std::nullopt;
  }
  if (!checkArea(context.diagnostics, word, found.address->area, found.address->byte, length)) return std::nullopt;
  return found.address;
}

bool checkWritable(Context& context, const Address& address, uint32_t length, SourceRange range) {
  if (areaInfo(address.area).use == AreaUse::Input) {
    context.diagnostics.report(Diag::WriteToInput, range) << textOf(address);
    return false;
  }
  if (touchesPreset(address, length)) {
    context.diagnostics.report(Diag::WriteToPreset, range) << textOf(address);
    return false;
  }
  if (address.area == Area::R && address.byte + length > kSystemRelays)
    context.diagnostics.report(Diag::SystemAreaWrite, range) << textOf(address);
  return true;
}

} // namespace rung::gsk
