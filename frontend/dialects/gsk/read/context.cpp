// Names and operands that are addresses.
#include "frontend/dialects/gsk/read/context.h"

#include <algorithm>
#include <ranges>

#include <fmt/format.h>

#include "frontend/dialects/gsk/rows/instructions.h"
#include "ir/support/ascii.h"
#include "ir/support/similar.h"
#include "rtlib/text/letters.h"

namespace rung::gsk {
namespace {

bool isNameChar(char c) { return isLetter(c) || isDigit(c) || c == '_'; }

bool isCommand(std::string_view text) {
  if (findFunction(text) != nullptr) return true;
  for (const Row& row : allRows())
    if (row.info.number < 0 && text::equalsIgnoringCase(row.info.mnemonic, text)) return true;
  return std::ranges::any_of(kCommandNames, [&](std::string_view w) { return text::equalsIgnoringCase(w, text); });
}

// A name that cannot be taken for something else (P12).
bool isFreeName(std::string_view text) {
  if (text.empty() || !isLetter(text[0]) || !std::all_of(text.begin(), text.end(), isNameChar)) return false;
  const bool labelLike = (text::upper(text[0]) == 'L' || text::upper(text[0]) == 'P') && parseDigits(text.substr(1));
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
std::optional<NamedAddress> addressOf(Diagnostics& diagnostics, const AddressText& text, const Word& word) {
  NamedAddress address{{text.area, static_cast<uint32_t>(std::min<uint64_t>(text.byte, UINT32_MAX)), 0, text.hasPoint}};
  if (!text.hasPoint) return address;
  if (text.bit.size() != 1 || text.bit[0] < '0' || text.bit[0] > '7') {
    DiagBuilder report = diagnostics.report(Diag::BadBitNumber, word.range);
    report << text.bit;
    if (text.bit.find_first_of("oO") != std::string_view::npos) report.note("a zero is a digit, not the letter O");
    return std::nullopt;
  }
  address.bit = static_cast<uint8_t>(text.bit[0] - '0');
  return address;
}

struct Found {
  std::optional<NamedAddress> address;
  bool known = false; // as a name or by its shape; then nothing more is to be said about it
};

Found findAddress(Context& context, const Word& word) {
  if (const UserName* symbol = context.names.use(context.analysis, word, UserName::Kind::Symbol))
    return {symbol->bad ? std::nullopt : std::optional(NamedAddress{symbol->address, symbol->definition}), true};
  if (const auto text = splitAddress(word.text)) return {addressOf(context.diagnostics, *text, word), true};
  if (const auto signal = context.names.useSignal(context.analysis, word)) return {signal, true};
  return {};
}

void suggestName(const Context& context, const UndeclaredName& use, DiagBuilder& report) {
  if (!context.diagnostics.suggests()) return;
  const std::string_view similar = mostSimilar(use.name, context.names.ofKind(use.kind), &UserName::name);
  report.meant(use.range, similar);
  if (!similar.empty() || use.kind != UserName::Kind::Symbol) return;
  if (const nc::Signal* signal = similarSignal(use.name))
    report.note(
        fmt::format("did you mean {} ({}, {})?", signal->symbol, textOf(signalAddress(*signal)), signal->meaning));
}

// Of an instruction: names of other controls (TON, CTU) are like none of these.
void suggest(SourceRange range, std::string_view similar, DiagBuilder& report) {
  report.meant(range, similar);
  if (similar.empty()) report.note("`rungc explain gsk` lists the instructions by what they do");
}

void explain(const Context& context, const UndeclaredName& use, DiagBuilder& report) {
  report << use.expected;
  std::string pointed(use.name);
  std::ranges::replace(pointed, ',', '.');
  if (pointed != use.name && splitAddress(pointed))
    report.note(fmt::format("write {}", pointed)).fix(use.range, pointed);
  else
    suggestName(context, use, report);
}

// T00 to T31 are addresses although the table has signals of these names.
void reportNoBit(Context& context, const Word& word, const Address& address) {
  DiagBuilder report = context.diagnostics.report(Diag::BitAddressExpected, word.range);
  report << word.text;
  const nc::Signal* signal = findSignalByName(word.text);
  if (signal != nullptr && signalAddress(*signal) != address)
    report.note(fmt::format("the signal {} of the T code is written by its address, {}", signal->symbol,
                            textOf(signalAddress(*signal))));
}

// A signal that the configured machine does not have.
void checkMachine(Context& context, const Word& word, const Address& address, uint32_t length) {
  const nc::Signal* signal = foreignSignal(context.machine, address, length);
  if (signal == nullptr) return;
  const bool onMill = context.machine == Machine::Mill;
  context.diagnostics.report(Diag::SignalOfOtherMachine, word.range)
          .note(fmt::format("man. l.{}: {}", signal->manualLine, signal->meaning))
      << signal->symbol << (onMill ? "turning" : "milling") << (onMill ? "mill" : "turn");
}

} // namespace

frontend::NamedPlace placeOf(const Address& address, uint32_t bytes) {
  return {{&areaInfo(address.area).letter, 1}, address.byte * 8 + address.bit, address.isBit ? 1 : bytes * 8};
}

UserName* Names::declare(Diagnostics& diagnostics, const Word& name, UserName::Kind kind) {
  if (name.quoted || !isFreeName(name.text)) {
    diagnostics.report(Diag::BadOperand, name.range)
        << name.text << "free name: a letter, then letters, digits and _, and no command, address, label or subprogram";
    return nullptr;
  }
  const uint32_t index =
      table_.declare({.name = name.text, .declared = name.range, .kind = kind, .bad = true}, diagnostics);
  return index == frontend::kNoName ? nullptr : &table_[index];
}

void Names::addSymbol(Context& context, const Word& name, const Word& value, std::string_view comment) {
  UserName* symbol = declare(context.diagnostics, name, UserName::Kind::Symbol);
  if (symbol == nullptr) return;
  symbol->comment = comment;
  if (const auto text = splitAddress(value.text)) {
    if (const auto address = addressOf(context.diagnostics, *text, value)) {
      symbol->address = *address;
      symbol->bad = !checkArea(context.diagnostics, value, text->area, text->byte, 1);
    }
  } else if (const auto signal = useSignal(context.analysis, value)) {
    symbol->address = *signal;
    symbol->bad = false;
  } else {
    context.diagnostics.report(Diag::BadOperand, value.range) << value.text << "bit or byte address or signal";
  }
  symbol->definition = context.analysis.define({.name = name.text, .comment = comment, .range = name.range});
  if (!symbol->bad) context.analysis.definition(symbol->definition).place = placeOf(symbol->address, 1);
}

void Names::addConstant(Context& context, const Word& name, const Word& value) {
  UserName* constant = declare(context.diagnostics, name, UserName::Kind::Constant);
  if (constant == nullptr) return;
  const auto number = parseConstant(value.text);
  if (!number) context.diagnostics.report(Diag::BadOperand, value.range) << value.text << "constant";
  constant->value = number.value_or(0);
  constant->bad = !number;
  constant->definition = context.analysis.define({.name = name.text, .range = name.range, .value = value.text});
}

const UserName* Names::use(frontend::Analysis& analysis, const Word& word, UserName::Kind kind) const {
  const uint32_t index = table_.find(word.text);
  if (index == frontend::kNoName || table_[index].kind != kind) return nullptr;
  analysis.use(word.range, table_[index].definition);
  return &table_[index];
}

std::optional<NamedAddress> Names::useSignal(frontend::Analysis& analysis, const Word& word) {
  const nc::Signal* signal = findSignalByName(word.text);
  if (signal == nullptr) return std::nullopt;
  const auto [at, isNew] = signals_.emplace(signal, 0);
  if (isNew)
    at->second = analysis.define(
        {.name = signal->symbol, .comment = signal->meaning, .place = placeOf(signalAddress(*signal), 1)});
  analysis.use(word.range, at->second);
  return NamedAddress{signalAddress(*signal), at->second};
}

void reportUnknownCommand(Context& context, const Word& word, std::span<const std::string_view> commands) {
  DiagBuilder report = context.diagnostics.report(Diag::UnknownCommand, word.range);
  report << word.text;
  if (const Row* row = findFunction(word.text)) {
    report.note(fmt::format("{} is a function: write `FUNC {}`", row->info.mnemonic, row->info.mnemonic));
    return;
  }
  if (context.diagnostics.suggests()) suggest(word.range, mostSimilar(word.text, commands), report);
}

void reportUnknownFunction(Context& context, std::string_view name, SourceRange range) {
  DiagBuilder report = context.diagnostics.report(Diag::UnknownFunction, range);
  report << name;
  if (!context.diagnostics.suggests()) return;
  const auto isFunction = [](const Row& row) { return row.info.number >= 0; };
  const auto mnemonicOf = [](const Row& row) { return row.info.mnemonic; };
  suggest(range, mostSimilar(name, allRows() | std::views::filter(isFunction), mnemonicOf), report);
}

void unknownOperand(Context& context, const Word& word, UserName::Kind kind, std::string_view expected) {
  const UndeclaredName use{{word.text, word.range}, kind, expected};
  if (isFreeName(word.text) && !context.names.has(word.text)) return context.undeclared.add(use);
  DiagBuilder report = context.diagnostics.report(Diag::BadOperand, word.range);
  report << word.text;
  explain(context, use, report);
}

void reportUndeclared(Context& context) {
  context.undeclared.report(context.diagnostics, Diag::BadOperand,
                            [&](DiagBuilder& report, const UndeclaredName& use) { explain(context, use, report); });
}

void countStep(Context& context, SourceRange range) {
  if (++context.steps == kMaxSteps + 1) context.diagnostics.report(Diag::ProgramTooLarge, range) << kMaxSteps;
}

std::optional<NamedAddress> byteOperand(Context& context, const Word& word, uint32_t length) {
  const Found found = findAddress(context, word);
  if (!found.known) unknownOperand(context, word, UserName::Kind::Symbol, "byte address, signal or declared name");
  if (!found.address) return std::nullopt;
  if (found.address->isBit) {
    context.diagnostics.report(Diag::ByteAddressExpected, word.range) << word.text;
    return std::nullopt;
  }
  if (!checkArea(context.diagnostics, word, found.address->area, found.address->byte, length)) return std::nullopt;
  checkMachine(context, word, *found.address, length);
  return found.address;
}

bool checkWritable(Context& context, const Address& address, uint32_t length, SourceRange range) {
  if (areaInfo(address.area).use == AreaUse::Input) {
    context.diagnostics.report(Diag::WriteToInput, range) << textOf(address) << "an input and cannot be written";
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

std::optional<NamedAddress> bitOperand(Context& context, const Word& word) {
  if (!word.range.valid()) return std::nullopt;
  const Found found = findAddress(context, word);
  if (!found.known) unknownOperand(context, word, UserName::Kind::Symbol, "bit address, signal or declared name");
  if (!found.address) return std::nullopt;
  if (!found.address->isBit) {
    reportNoBit(context, word, *found.address);
    return std::nullopt;
  }
  if (!checkArea(context.diagnostics, word, found.address->area, found.address->byte, 1)) return std::nullopt;
  checkMachine(context, word, *found.address, 1);
  return found.address;
}

std::optional<Address> readBit(Context& context, const Word& word, frontend::Access access) {
  const std::optional<NamedAddress> bit = bitOperand(context, word);
  if (!bit) return std::nullopt;
  context.analysis.use({.range = word.range, .base = bit->name, .place = placeOf(*bit, 1), .access = access});
  if (access == frontend::Access::Write && !checkWritable(context, *bit, 1, word.range)) return std::nullopt;
  return bit;
}

} // namespace rung::gsk
