// Names and operands that are addresses.
#include "frontend/network/read/context.h"

#include <algorithm>
#include <ranges>

#include <fmt/format.h>

#include "frontend/ladder/text/fix.h"
#include "frontend/network/read/list_reader.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::network {
namespace {

bool isNameChar(const Language& language, char c) {
  return text::isLetter(c) || text::isDigit(c) || c == '_' || language.nameMarks.find(c) != std::string_view::npos;
}

bool isCommand(const Language& language, std::string_view text) {
  const auto isIt = [&](std::string_view name) { return text::equalsIgnoringCase(name, text); };
  return std::ranges::any_of(language.commands, isIt) ||
         std::ranges::any_of(language.rows, [&](const Row* row) { return isIt(row->info.mnemonic); });
}

// Whether the text is a label or a subprogram.
bool isNumbered(const Language& language, std::string_view text) {
  return parseDigits(text.substr(1)) && std::ranges::any_of(language.rows, [&](const Row* row) {
           return (row->control == Control::Lbl || row->control == Control::Sp) &&
                  language.letterOf(row->control) == text::upper(text[0]);
         });
}

// Whether the text is a name that cannot mean anything else (P12).
bool isFreeName(const Language& language, std::string_view text) {
  if (text.empty() || (language.nameMarks.empty() && !text::isLetter(text[0]))) return false;
  if (!std::ranges::all_of(text, [&](char c) { return isNameChar(language, c); }) || parseConstant(language, text))
    return false;
  return !isNumbered(language, text) && !splitAddress(language, text) && !isCommand(language, text);
}

bool checkArea(Context& context, const Word& word, Area area, uint64_t byte, uint32_t length) {
  const AreaInfo& info = context.language.at(area);
  if (length <= info.room(byte)) return true;
  const std::string shown = length > 1 ? fmt::format("{} with {} bytes", word.text, length) : std::string(word.text);
  context.diagnostics.report(diag::AddressOutOfRange, word.range) << shown << bytesText(info);
  return false;
}

bool touchesPreset(const AreaInfo& area, uint32_t byte, uint32_t length) {
  for (uint32_t i = 0; i < std::min(length, area.presets.every); ++i)
    if ((byte + i) % area.presets.every < area.presets.bytes) return true;
  return false;
}

// Reads an address. The caller, who knows the length, checks the range.
std::optional<NamedAddress> readAddress(Diagnostics& diagnostics, const AddressText& text, const Word& word) {
  NamedAddress address{{text.area, static_cast<uint32_t>(std::min<uint64_t>(text.byte, UINT32_MAX)), 0, text.hasPoint}};
  if (!text.hasPoint) return address;
  if (text.bit.size() != 1 || text.bit[0] < '0' || text.bit[0] > '7') {
    DiagBuilder report = diagnostics.report(diag::BadBitNumber, word.range);
    report << text.bit;
    if (text.bit.empty()) report.note(fmt::format("a bit is missing after the point: {0}0 to {0}7", word.text));
    if (text.bit.find_first_of("oO") != std::string_view::npos) report.note("a zero is a digit, not the letter O");
    return std::nullopt;
  }
  address.bit = static_cast<uint8_t>(text.bit[0] - '0');
  return address;
}

struct Found {
  std::optional<NamedAddress> address;
  bool known = false; // a known name or address; no further error is reported
};

Found findAddress(Context& context, const Word& word) {
  if (const auto text = splitAddress(context.language, word.text))
    return {readAddress(context.diagnostics, *text, word), true};
  if (const uint32_t index = context.names.use(word, UserName::Kind::Symbol); index != frontend::kNoName) {
    const UserName& symbol = context.names[index];
    return {symbol.bad ? std::nullopt : std::optional(NamedAddress{symbol.address, index}), true};
  }
  if (const auto signal = context.names.useSignal(context.language, word)) return {signal, true};
  return {};
}

void suggestName(const Context& context, std::span<const UndeclaredName> uses, DiagBuilder& report) {
  if (!context.diagnostics.suggests()) return;
  const UndeclaredName& use = uses.front();
  const text::Likely similar = text::likeliest(use.name, context.names.ofKind(use.kind), &UserName::name);
  const bool isOneKind = std::ranges::count(uses, use.kind, &UndeclaredName::kind) == std::ssize(uses);
  ladder::suggest(report, context.sources, frontend::placesOf(uses), {similar.word, similar.certain && isOneKind});
  if (!similar.word.empty() || use.kind != UserName::Kind::Symbol) return;
  const nc::SignalTable& signals = context.language.signals();
  if (const nc::Signal* signal = nc::findSignal(signals, text::mostSimilar(use.name, signals, &nc::Signal::symbol)))
    report.note(fmt::format("did you mean {} ({}, {})?", signal->symbol,
                            textOf(context.language, addressOf(context.language, *signal)), signal->meaning));
}

// Suggests an instruction, or the list of all: the word may be an instruction of another control.
void suggestInstruction(const Context& context, SourceRange range, const text::Likely& similar, DiagBuilder& report) {
  ladder::suggest(report, context.sources, range, similar);
  if (similar.word.empty())
    report.note(fmt::format("`rungc explain {}` lists the instructions by what they do", context.language.name));
}

// Whether the text is an address in the style of IEC 61131 or Siemens, which this control does not have: I1.5, %QX0.0,
// MW10.
bool isOtherAddress(std::string_view text) {
  if (text.starts_with('%')) text.remove_prefix(1);
  const size_t letters = std::min(text.find_first_not_of("BDEIMQWXbdeimqwx"), text.size());
  return letters >= 1 && letters <= 2 && letters < text.size() && text::isDigit(text[letters]);
}

std::string areasText(const Language& language) {
  std::string text;
  for (const AreaInfo& area : language.areas)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", area.letter, area.doc);
  return text;
}

// Whether the operand is negated in the style of other languages: /X1.0, -X1.0, NOT X1.0.
bool isNegated(std::string_view operand) {
  return text::equalsIgnoringCase(operand, "NOT") ||
         (operand.size() > 1 && std::string_view("-/!~").find(operand[0]) != std::string_view::npos &&
          text::isLetter(operand[1]));
}

// Whether the operand is negated or one of a list with commas; replacing the command alone would not fix the line.
bool isForeignOperand(const Word& word) {
  return isNegated(word.text) || word.text.find(',') != std::string_view::npos;
}

// Explains how a bit is negated; the name alone would be the bit without negation. False if the operand is not negated.
bool noteNegation(const Language& language, std::string_view operand, DiagBuilder& report) {
  if (!isNegated(operand)) return false;
  report.note(fmt::format("a bit is negated by its command: {}, {}, {} or {}; in a drawing a closed contact is [/x]",
                          language.nameOf(Command::LoadNot), language.nameOf(Command::AndNot),
                          language.nameOf(Command::OrNot), language.nameOf(Command::OutNot)));
  return true;
}

// Explains K100, H1F and #100 of other controls; false for anything else.
bool noteLetter(const Language& language, std::string_view constant, DiagBuilder& report) {
  if (constant.size() < 2 || !text::isDigit(constant[1])) return false;
  const char mark = text::upper(constant[0]);
  const std::string_view digits = constant.substr(1);
  const bool isDecimal = std::ranges::all_of(digits, text::isDigit);
  const bool isHex = std::ranges::all_of(digits, [](char c) { return text::hexDigit(c) >= 0; });
  if (isDecimal && (mark == 'K' || mark == '#'))
    report.note(fmt::format("a number is written without '{}': {}", constant[0], digits));
  else if (isHex && (mark == 'H' || mark == '#'))
    report.note(language.hexadecimal ? fmt::format("a hexadecimal number is written 0x{}", digits)
                                     : std::string("a number is written with decimal digits"));
  else
    return false;
  return true;
}

// Explains how a constant of another language is written here; false if the name is not one.
bool noteConstant(const Language& language, const UndeclaredName& use, DiagBuilder& report) {
  if (const auto time = frontend::foreignTime(use.name)) {
    report.note(fmt::format("{} in milliseconds: {}", use.name, time->milliseconds()));
    return true;
  }
  const std::optional<frontend::ForeignNumber> number = frontend::foreignNumber(use.name);
  if (!number) return noteLetter(language, use.name, report);
  const auto value = text::numberIn<uint64_t>(number->digits, static_cast<int>(number->base));
  if (number->base == 16 && language.hexadecimal)
    report.meant(use.range, fmt::format("0x{}", number->digits));
  else if (value)
    report.meant(use.range, fmt::format("{}", *value));
  return true;
}

std::string bothOf(std::span<const Word> words) { return fmt::format("{} {}", words[0].text, words[1].text); }

// Explains a line of another kind of text: a drawing, a comment, a label. False if it is none of these.
bool noteSyntax(const Language& language, std::string_view word, DiagBuilder& report) {
  if (word.starts_with('|') || word.starts_with('+'))
    report.note(
        fmt::format("this is a drawing, and the file is read as a command list: a ladder has the extension .lad, "
                    "and above its drawings the statements `dialect {}`, `module {}` and `rung`",
                    language.name, language.levels[0].name));
  else if (looksLikeComment(word))
    report.note("a comment begins with ';'");
  else if (word.ends_with(':'))
    report.note(fmt::format("a label is `{}` with its number as a parameter; a title is a comment after ';'",
                            language.callOf(language.rowOf(Control::Lbl))));
  else
    return false;
  return true;
}

void explain(const Context& context, std::span<const UndeclaredName> uses, DiagBuilder& report) {
  const UndeclaredName& use = uses.front();
  report << use.expected;
  std::string pointed(use.name);
  std::ranges::replace(pointed, ',', '.');
  if (pointed != use.name && splitAddress(context.language, pointed))
    report.note(fmt::format("write {}", pointed)).fix(use.range, pointed);
  else if (use.kind == UserName::Kind::Constant ? !noteConstant(context.language, use, report)
                                                : !noteNegation(context.language, use.name, report))
    suggestName(context, uses, report);
  if (use.kind == UserName::Kind::Symbol && isOtherAddress(use.name))
    report.note("areas of this control: " + areasText(context.language));
}

// Reports [x>5]: comparisons are functions.
void reportComparison(Context& context, const Word& word) {
  DiagBuilder report = context.diagnostics.report(diag::BadOperand, word.range);
  report << word.text << "a bit";
  if (const frontend::ForeignWord* function = frontend::findForeign(context.language.foreign, "CMP"))
    report.note(fmt::format("a comparison is {}", function->here));
}

// Reports a byte address where a bit is expected. T00 to T31 are addresses although the table has signals of these
// names.
void reportNoBit(Context& context, const Word& word, const Address& address) {
  DiagBuilder report = context.diagnostics.report(diag::BitAddressExpected, word.range);
  report << word.text;
  const nc::Signal* signal = nc::findSignal(context.language.signals(), word.text);
  if (signal != nullptr && addressOf(context.language, *signal) != address)
    report.note(fmt::format("the signal {} of the {} code is written by its address, {}", signal->symbol,
                            context.language.at(address.area).letter,
                            textOf(context.language, addressOf(context.language, *signal))));
  if (const std::string_view instead = context.language.at(address.area).instead; !instead.empty())
    report.note(instead);
}

} // namespace

frontend::NamedPlace placeOf(const Language& language, const Address& address, uint32_t bytes) {
  return {{&language.at(address.area).letter, 1}, address.byte * 8 + address.bit, address.isBit ? 1 : bytes * 8};
}

Names::Names(const Language& language)
    : SymbolTable(language.namesIgnoreCase ? [](std::string_view name) { return text::upper(name); }
                                           : frontend::asWritten) {
  addScope();
}

UserName* Names::declare(Context& context, const Word& name, UserName::Kind kind) {
  if (name.quoted || !isFreeName(context.language, name.text)) {
    refuse(name.text);
    context.diagnostics.report(diag::BadOperand, name.range)
        << name.text
        << "a free name: a letter, then letters, digits and _, and no command, address, label or subprogram";
    return nullptr;
  }
  const uint32_t index =
      SymbolTable::declare({.name = name.text, .declared = name.range, .kind = kind, .bad = true}, context.diagnostics);
  return index == frontend::kNoName ? nullptr : &edit(index);
}

void Names::addSymbol(Context& context, const Word& name, const Word& value, std::string_view comment) {
  UserName* symbol = declare(context, name, UserName::Kind::Symbol);
  if (symbol == nullptr) return;
  symbol->comment = comment;
  if (const auto text = splitAddress(context.language, value.text)) {
    if (const auto address = readAddress(context.diagnostics, *text, value)) {
      symbol->address = *address;
      symbol->bad = !checkArea(context, value, text->area, text->byte, 1);
    }
  } else if (const auto signal = useSignal(context.language, value)) {
    symbol->address = *signal;
    symbol->bad = false;
  } else {
    context.diagnostics.report(diag::BadOperand, value.range) << value.text << "a bit or byte address or a signal";
  }
}

void Names::addConstant(Context& context, const Word& name, const Word& value) {
  UserName* constant = declare(context, name, UserName::Kind::Constant);
  if (constant == nullptr) return;
  const auto number = parseConstant(context.language, value.text);
  if (!number) {
    DiagBuilder report = context.diagnostics.report(diag::BadOperand, value.range);
    report << value.text << "a constant";
    noteConstant(context.language, {{value.text, value.range}, UserName::Kind::Constant, {}}, report);
  }
  constant->text = value.text;
  constant->value = number.value_or(0);
  constant->bad = !number;
}

void Names::addListed(Diagnostics& diagnostics, UserName name) {
  const uint32_t first = find(name.name);
  const UserName* known = first == frontend::kNoName ? nullptr : &all()[first];
  if (known != nullptr && known->kind == name.kind && known->address == name.address && known->value == name.value)
    return;
  name.isListed = true;
  SymbolTable::declare(std::move(name), diagnostics);
}

uint32_t Names::use(const Word& word, UserName::Kind kind) {
  const uint32_t index = find(word.text);
  if (index == frontend::kNoName || all()[index].kind != kind) return frontend::kNoName;
  SymbolTable::use(word.range, index);
  return index;
}

std::optional<NamedAddress> Names::useSignal(const Language& language, const Word& word) {
  const nc::Signal* signal = nc::findSignal(language.signals(), word.text);
  if (signal == nullptr) return std::nullopt;
  uint32_t index = find(signal->symbol, {kSignals});
  if (index == frontend::kNoName)
    index = enter({.name = signal->symbol,
                   .kind = UserName::Kind::Signal,
                   .comment = signal->meaning,
                   .address = addressOf(language, *signal)},
                  kSignals);
  SymbolTable::use(word.range, index);
  return NamedAddress{all()[index].address, index};
}

void Names::addTo(frontend::Analysis& analysis, const Language& language) const {
  SymbolTable::addTo(analysis, [&](const UserName& name) {
    const bool isPlace = (name.kind == UserName::Kind::Symbol || name.kind == UserName::Kind::Signal) && !name.bad;
    return frontend::Definition{.name = name.name,
                                .comment = name.comment,
                                .range = name.declared,
                                .place = isPlace ? placeOf(language, name.address, 1) : frontend::NamedPlace{},
                                .isPlaced = isPlace && name.kind == UserName::Kind::Symbol,
                                .value = name.text,
                                .usedByControl =
                                    isPlace && language.at(name.address.area).isUsedOutside(name.address.byte),
                                .isListed = name.isListed};
  });
}

bool isForeign(const Language& language, std::span<const Word> words) {
  return words.size() > 1 && frontend::findForeign(language.foreign, bothOf(words)) != nullptr;
}

void reportUnknownCommand(Context& context, std::span<const Word> words) {
  const Language& language = context.language;
  const size_t count = isForeign(language, words) ? 2 : 1;
  const std::string written = count == 1 ? std::string(words[0].text) : bothOf(words);
  const Word word{written, join(words[0].range, words[count - 1].range), false};
  DiagBuilder report = context.diagnostics.report(diag::UnknownCommand, word.range);
  report << word.text;
  if (noteSyntax(language, word.text, report)) return;
  const auto fits = [&](std::string_view command) {
    const auto found = findCommand(language, command);
    const auto operands = words.subspan(count);
    return found && operandCount(*found) == operands.size() && std::ranges::none_of(operands, isForeignOperand);
  };
  const auto isCertain = [&](std::string_view command) {
    return fits(command) && !frontend::isAmbiguous(word.text, language.commands | std::views::filter(fits));
  };
  if (words.size() == count + 1 && noteNegation(language, words[count].text, report)) return;
  if (const frontend::ForeignWord* foreign = frontend::findForeign(language.foreign, word.text))
    return frontend::explainForeign(report, word.range, *foreign, isCertain(foreign->here));
  if (const Row* row = language.findFunction(word.text)) {
    report.note(
        fmt::format("{0} is a function: write `{1} {0}`", row->info.mnemonic, language.nameOf(Command::Function)));
    return;
  }
  if (!context.diagnostics.suggests()) return;
  const auto isName = [&](std::string_view name) {
    return !name.empty() && !text::equalsIgnoringCase(name, word.text);
  };
  text::Likely similar = text::likeliest(word.text, language.commands | std::views::filter(isName));
  if (frontend::isModified(word.text, similar.word)) similar = {};
  suggestInstruction(context, word.range, {similar.word, similar.certain && fits(similar.word)}, report);
}

void reportUnknownFunction(Context& context, std::string_view name, SourceRange range, std::string_view drawn) {
  DiagBuilder report = context.diagnostics.report(diag::UnknownFunction, range);
  report << name;
  if (!drawn.empty()) return static_cast<void>(report.note(fmt::format("in a drawing: {}", drawn)));
  if (findCommand(context.language, name)) {
    report.note(fmt::format("{} is a command: its line has no `{}`", name, context.language.nameOf(Command::Function)));
    return;
  }
  if (!context.diagnostics.suggests()) return;
  const auto isFunction = [](const Row* row) { return row->info.number >= 0; };
  const auto mnemonicOf = [](const Row* row) { return row->info.mnemonic; };
  const frontend::ForeignWord* foreign = frontend::findForeign(context.language.foreign, name);
  if (foreign != nullptr && !foreign->same) return frontend::explainForeign(report, range, *foreign, false);
  text::Likely similar = text::likeliest(name, context.language.rows | std::views::filter(isFunction), mnemonicOf);
  if (frontend::isModified(name, similar.word)) similar = {};
  suggestInstruction(context, range, similar, report);
}

void unknownOperand(Context& context, const Word& word, UserName::Kind kind, std::string_view expected) {
  if (context.names.wasRefused(word.text)) return; // its declaration has been reported
  const UndeclaredName use{{word.text, word.range}, kind, std::string(expected)};
  if (isFreeName(context.language, word.text) && !context.names.has(word.text))
    return context.names.noteUndeclared(use);
  DiagBuilder report = context.diagnostics.report(diag::BadOperand, word.range);
  report << word.text;
  if (const uint32_t declared = context.names.find(word.text); declared != frontend::kNoName) {
    const bool isConstant = context.names[declared].kind == UserName::Kind::Constant;
    report.note(fmt::format("{} is declared as {}", word.text, isConstant ? "a constant" : "the name of an address"));
  }
  explain(context, {&use, 1}, report);
}

void reportUndeclared(Context& context) {
  context.names.reportUndeclared(context.diagnostics, context.language.undeclared,
                                 [&](DiagBuilder& report, auto uses) { explain(context, uses, report); });
}

void countStep(Context& context, SourceRange range) {
  const uint32_t most = context.language.maxSteps;
  if (++context.steps == most + 1) context.diagnostics.report(diag::ProgramTooLarge, range) << most;
}

std::optional<NamedAddress> byteOperand(Context& context, const Word& word, uint32_t length,
                                        std::string_view expected) {
  const Found found = findAddress(context, word);
  if (!found.known) unknownOperand(context, word, UserName::Kind::Symbol, expected);
  if (!found.address) return std::nullopt;
  if (found.address->isBit) {
    context.diagnostics.report(diag::ByteAddressExpected, word.range) << word.text;
    return std::nullopt;
  }
  if (!checkArea(context, word, found.address->area, found.address->byte, length)) return std::nullopt;
  if (context.onPlace) context.onPlace(word, *found.address, length);
  return found.address;
}

bool checkWritable(Context& context, const Address& address, uint32_t length, SourceRange range) {
  const AreaInfo& area = context.language.at(address.area);
  const std::string text = textOf(context.language, address);
  if (area.use == AreaUse::Input) {
    context.diagnostics.report(diag::WriteToInput, range) << text << "an input and cannot be written";
    return false;
  }
  if (address.byte + length > area.readOnly) {
    context.diagnostics.report(diag::WriteToInput, range) << text << "written by the control alone";
    return false;
  }
  if (touchesPreset(area, address.byte, length)) {
    context.diagnostics.report(diag::WriteToPreset, range) << text;
    return false;
  }
  if (address.byte + length > area.system)
    context.diagnostics.report(diag::SystemAreaWrite, range) << text << area.letter;
  return true;
}

std::optional<NamedAddress> bitOperand(Context& context, const Word& word) {
  if (!word.range.valid()) return std::nullopt;
  if (frontend::foreignComparison(word.text) && !context.names.has(word.text)) {
    reportComparison(context, word);
    return std::nullopt;
  }
  const Found found = findAddress(context, word);
  if (!found.known) unknownOperand(context, word, UserName::Kind::Symbol, "a bit address, a signal or a declared name");
  if (!found.address) return std::nullopt;
  if (!found.address->isBit) {
    reportNoBit(context, word, *found.address);
    return std::nullopt;
  }
  if (!checkArea(context, word, found.address->area, found.address->byte, 1)) return std::nullopt;
  if (context.onPlace) context.onPlace(word, *found.address, 1);
  return found.address;
}

std::optional<Address> readBit(Context& context, const Word& word, frontend::Access access, CoilTraits coil) {
  const std::optional<NamedAddress> bit = bitOperand(context, word);
  if (!bit) return std::nullopt;
  context.analysis.use({.range = word.range,
                        .base = bit->name,
                        .place = placeOf(context.language, *bit, 1),
                        .access = access,
                        .isVariable = true,
                        .isSet = coil.isSet,
                        .isDue = coil.isDue});
  if (access == frontend::Access::Write && !checkWritable(context, *bit, 1, word.range)) return std::nullopt;
  return bit;
}

} // namespace rung::frontend::network
