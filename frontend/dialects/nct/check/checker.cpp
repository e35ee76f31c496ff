// Checks rungs (see checker.h). Only the first error of an operand is reported, in the order of the inventory.
#include "frontend/dialects/nct/check/checker.h"

#include <ranges>

#include <fmt/format.h>

#include "frontend/dialects/nct/read/operand_parser.h"
#include "frontend/dialects/nct/rows/operand_kinds.h"
#include "frontend/dialects/nct/signal_text.h"
#include "frontend/ladder/rung.h"
#include "frontend/ladder/text/fix.h"
#include "frontend/ladder/text/list_word.h"
#include "frontend/sema/operand_count.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/structure.h"

namespace rung::frontend::nct {
namespace {

using frontend::Access;
using frontend::OperandInfo;
using frontend::Output;
using frontend::Placement;
using ladder::ElementKind;

std::string_view describe(Form form) {
  switch (form) {
  case Form::Bad: return "wrong";
  case Form::Constant: return "a constant";
  case Form::Word: return "a word";
  case Form::Bit: return "a bit";
  case Form::Text: return "a text";
  }
  return "";
}
std::string_view describe(ConstantKind kind) {
  switch (kind) {
  case ConstantKind::Decimal: return "a decimal constant";
  case ConstantKind::Hex: return "a hexadecimal constant";
  case ConstantKind::Real: return "a floating-point constant";
  }
  return "";
}

// Name of an element in messages; `operand` is that of a contact or a coil.
std::string nameOf(const ladder::Element& element, const Row& row, std::string_view operand) {
  switch (element.kind) {
  case ElementKind::Contact: return "a contact";
  case ElementKind::Coil:
    return row.reservation == Reservation::SetReset ? fmt::format("({} {})", row.variant == 2 ? 'S' : 'R', operand)
                                                    : "a coil";
  case ElementKind::Box:
  case ElementKind::Error: return std::string(row.info.mnemonic);
  }
  return {};
}

bool isBox(const Row& row) { return row.shape == Shape::Box; }
std::string_view mnemonicOf(const Row& row) { return row.info.mnemonic; }

// Explanation for a box with a double operand; `here` begins with the box for integers.
std::string forDoubles(std::string_view here) {
  const size_t end = std::min(here.find_first_of(" ,;"), here.size());
  const std::string_view doubles = doublesOf(here.substr(0, end));
  if (doubles.empty()) return std::string(here);
  const bool compares = here[0] == 'C';
  return fmt::format("{}{}; a constant is written *0.5", doubles, compares ? "" : ", whose result comes first");
}

bool sameName(std::string_view a, std::string_view b) { return a == b; }

// Explains a box that is written like a line of an instruction list: its word and one operand.
std::string listNote(const ladder::Element& element) {
  const std::string_view drawn = element.operands.count == 1 ? ladder::drawnFor(element.mnemonic) : std::string_view();
  return drawn.empty() ? std::string() : fmt::format("in a drawing: {}", drawn);
}

} // namespace

// --- each output once ------------------------------------------------------------------------------------------
void OutputReservations::add(const Row& row, const Operand& operand) {
  const Reservation reservation = row.reservation;
  const Address& address = operand.address;
  if (reservation == Reservation::None || !address.isFixed()) return;
  const uint64_t key = address.isBit ? address.word * 32 + address.bit : (1ull << 32) + address.word;
  Owner& owner = owners_[key];
  const SourceRange here = operand.source->range;
  if (reservation == Reservation::Once && owner.once.valid()) {
    diagnostics_.report(diag::DuplicateOutput, here).note(owner.once, "here")
        << operand.source->text << (owner.row->shape == Shape::Coil ? "a coil" : owner.row->info.mnemonic);
    return;
  }
  const bool wasMixed = owner.once.valid() && owner.setReset.valid();
  if (reservation == Reservation::Once) owner.once = here, owner.row = &row;
  if (reservation == Reservation::SetReset && !owner.setReset.valid()) owner.setReset = here;
  if (!wasMixed && owner.once.valid() && owner.setReset.valid())
    diagnostics_.report(diag::MixedOutput, here)
            .note(reservation == Reservation::Once ? owner.setReset : owner.once, "the other one")
        << operand.source->text;
}

// --- rungs ------------------------------------------------------------------------------------------
RungChecker::RungChecker(Symbols& symbols, OutputReservations& reservations, frontend::Analysis& analysis,
                         Diagnostics& diagnostics, std::string_view module)
    : symbols_(symbols), reservations_(reservations), analysis_(analysis), diagnostics_(diagnostics), module_(module),
      inInt0_(module != "MAIN"), handwheel_(nc::findSignal(nc::nctSignals(), "HWMOVE")),
      fastClock_(nc::findSignal(nc::nctSignals(), "N_P2MS")) {}

TypedRung RungChecker::check(const ladder::LadderFile& file, const ladder::Rung& rung) {
  TypedRung typed;
  typed.file = &file;
  typed.rung = &rung;
  typed.bad = rung.bad;
  typed.elements.reserve(rung.elements.size());
  typed.operands.reserve(rung.operandPool.size());
  dueNets_.clear();
  for (const ladder::Element& element : rung.elements) checkElement(typed, element);
  // An element that marks a place in the program needs a rung of its own (l.2926, l.2968, l.3022).
  for (const TypedElement& element : typed.elements) {
    if (typed.elements.size() == 1 || element.row == nullptr || element.row->info.placement != Placement::AtRail)
      continue;
    if (typed.bad) break;
    typed.bad = true;
    diagnostics_.report(diag::FirstColumnRequired, element.element->range).note("it needs a rung of its own")
        << element.row->info.mnemonic;
  }
  return typed;
}

const Row* RungChecker::rowOf(const ladder::Element& element, const Operand* first) {
  switch (element.kind) {
  case ElementKind::Contact: return &contactRow(first->form == Form::Bit, element.negated);
  case ElementKind::Coil: return &coilRow(static_cast<int>(element.coil));
  case ElementKind::Box: return findBox(element.mnemonic);
  case ElementKind::Error: return nullptr;
  }
  return nullptr;
}

RungChecker::Numbers RungChecker::numbersOf(std::span<const Word> operands) {
  Numbers numbers;
  for (const Word& word : operands) {
    if (word.quoted || word.text.empty()) continue;
    const Symbol* symbol = symbols_.find(word.text);
    const bool isConstant = symbol != nullptr && symbol->kind == SymbolKind::Constant;
    numbers.integers |= word.text[0] == '#' || (isConstant && symbol->constant.kind != ConstantKind::Real);
    numbers.doubles |= word.text[0] == '*' || (isConstant && symbol->constant.kind == ConstantKind::Real) ||
                       (symbol != nullptr && symbol->signal != nullptr && symbol->signal->type == nc::SignalType::Real);
  }
  return numbers;
}

void RungChecker::reportUnknown(const ladder::Element& element, std::span<const Word> operands) {
  DiagBuilder report = diagnostics_.report(diag::UnknownInstruction, element.mnemonicRange);
  report << element.mnemonic;
  if (const std::string note = listNote(element); !note.empty()) {
    report.note(note);
    return;
  }
  if (const frontend::ForeignWord* foreign = frontend::findForeign(foreignWords(), element.mnemonic))
    return explainForeign(report, element, *foreign, numbersOf(operands));
  if (!diagnostics_.suggests()) return;
  text::Likely likely = text::likeliest(element.mnemonic, allRows() | std::views::filter(isBox), mnemonicOf);
  const std::string_view doubles = numbersOf(operands).doubles ? doublesOf(likely.word) : std::string_view();
  if (!doubles.empty()) likely = {doubles, false};
  ladder::suggest(report, symbols_.sources(), element.mnemonicRange, likely);
}

// Explains an instruction of another language. A fix is offered only if the box certainly means the same: equal number
// and format of operands.
void RungChecker::explainForeign(DiagBuilder& report, const ladder::Element& element,
                                 const frontend::ForeignWord& foreign, Numbers numbers) {
  const SourceRange range = element.mnemonicRange;
  if (!foreign.same) {
    const std::string here = numbers.doubles ? forDoubles(foreign.here) : std::string(foreign.here);
    return frontend::explainForeign(report, range, {foreign.word, here, false}, false);
  }
  const std::string_view doubles = doublesOf(foreign.here);
  if (!doubles.empty() && numbers.doubles == numbers.integers) {
    report.note(fmt::format("in this language: {}; for doubles {}", foreign.here, doubles));
    return;
  }
  const std::string_view here = doubles.empty() || numbers.integers ? foreign.here : doubles;
  const auto fits = [&](const Row& row) { return isBox(row) && row.info.operands.size() == element.operands.count; };
  const Row* row = findBox(here);
  const bool isCertain = row != nullptr && fits(*row) &&
                         !frontend::isAmbiguous(element.mnemonic, allRows() | std::views::filter(fits), mnemonicOf);
  if (isCertain)
    ladder::meant(report, symbols_.sources(), range, here);
  else
    report.meant({}, here);
}

void RungChecker::checkElement(TypedRung& typed, const ladder::Element& element) {
  const ladder::Rung& rung = *typed.rung;
  TypedElement& added = typed.elements.emplace_back();
  added.element = &element;
  added.firstOperand = static_cast<uint32_t>(typed.operands.size());
  if (element.kind == ElementKind::Error) return;
  if (element.kind != ElementKind::Box) {
    typed.operands.push_back(parseOperand(rung.operandOf(element), symbols_, diagnostics_));
    added.operandCount = 1;
    Operand& operand = typed.operands.back();
    if (element.edge != 0 && operand.edge != 0) {
      diagnostics_.report(diag::ModifierNotAllowed, operand.source->range)
          << std::string(1, operand.edge) << fmt::format("a contact with '{}'", element.edge);
      operand.form = Form::Bad;
    }
    if (element.edge != 0) operand.edge = element.edge;
  }
  added.row = rowOf(element, typed.operands.empty() ? nullptr : &typed.operands.back());
  if (added.row == nullptr) {
    // In a drawing with an error it may be a pin of a box that could not be read.
    const bool mayBePin = rung.bad && element.operands.count == 0;
    if (!mayBePin) reportUnknown(element, rung.operandsOf(element));
    typed.bad = true;
    return;
  }
  if (element.kind == ElementKind::Box)
    analysis_.use(frontend::InstructionUse{element.mnemonicRange, &added.row->info});
  const bool drawn = rung.bad || checkDrawn(rung, element, *added.row); // the nets of a bad drawing are unknown
  bool ok = readOperands(typed, added) && drawn;
  if (element.kind == ElementKind::Box && added.row->info.output == Output::Always)
    dueNets_.insert(element.output.index);
  if (ok && !added.row->isBuilt()) {
    diagnostics_.report(diag::NotBuiltYet, element.mnemonicRange) << added.row->info.mnemonic;
    ok = false;
  }
  if (!ok) typed.bad = true;
}

// The two checks concern different errors, so both may report.
bool RungChecker::checkDrawn(const ladder::Rung& rung, const ladder::Element& element, const Row& row) {
  const bool placed = checkPlacement(rung, element, row);
  return ladder::checkPins(row.info, rung.pinsOf(element), element.range, sameName, diagnostics_) && placed;
}

bool RungChecker::checkPlacement(const ladder::Rung& rung, const ladder::Element& element, const Row& row) {
  bool ok = true;
  const bool isBox = element.kind == ElementKind::Box;
  const auto complain = [&](Diag code, SourceRange range, std::string_view note = {}) {
    DiagBuilder report = diagnostics_.report(code, range);
    report << nameOf(element, row, isBox ? "" : rung.operandOf(element).text);
    if (!note.empty()) report.note(note);
    ok = false;
  };
  for (const ladder::Pin& pin : rung.pinsOf(element))
    if (isMisplaced(row.info, pin))
      complain(pin.input == ladder::kRail ? diag::FirstColumnNotAllowed : diag::FirstColumnRequired, pin.range);
  const bool connected = element.output.valid();
  if (row.info.output == Output::None && connected) complain(diag::ElementAfterClosing, element.range);
  if (row.info.output == Output::Always && !connected)
    complain(diag::MissingClosingElement, element.range,
             isBox ? fmt::format("any free bit will do: {{{} ...}}--(DONE), and above it `symbol DONE {:04}.00`",
                                 element.mnemonic, symbols_.config().plcRam)
                   : std::string());
  return ok;
}

// Reads the number of a label or subroutine; both share one set of numbers per module (l.2942, l.2996).
bool RungChecker::readLabel(TypedElement& element, const Word& word) {
  element.label = parseLabel(word, symbols_, diagnostics_);
  if (!element.label) return false;
  const bool defines = element.row->flow == Flow::Label || element.row->flow == Flow::Subroutine;
  analysis_.use({.range = word.range, .scope = module_, .number = *element.label, .defines = defines});
  return true;
}

// A coil is due if it is a plain coil directly after a box that requires one, such as MSG, TOND and CNT.
RungChecker::CoilTraits RungChecker::coilTraits(const ladder::Rung& rung, const ladder::Element& element) const {
  if (element.kind != ElementKind::Coil) return {};
  const bool isDue =
      element.coil == ladder::CoilKind::Plain && !rung.bad && dueNets_.contains(rung.inputOf(element).index);
  return {.isSet = element.coil == ladder::CoilKind::Set, .isDue = isDue};
}

// Checks each word by itself if the number of operands is wrong and their positions are unknown.
void RungChecker::readUncounted(const Row& row, std::span<const Word> words) {
  const auto isValue = [](const OperandInfo& operand) { return kindOf(operand).parse == OperandClass::Value; };
  if (!std::ranges::all_of(row.info.operands.all(), isValue)) return;
  for (const Word& word : words) parseOperand(word, symbols_, diagnostics_);
}

bool RungChecker::readOperands(TypedRung& typed, TypedElement& typedElement) {
  const ladder::Element& element = *typedElement.element;
  const Row& row = *typedElement.row;
  const std::span<const Word> words = typed.rung->operandsOf(element);
  const size_t most = row.info.operands.size();
  const SourceRange count = words.size() > most ? words[most].range : element.mnemonicRange;
  if (element.kind == ElementKind::Box &&
      !frontend::countFits(row.info, words.size(), count, diagnostics_, listNote(element))) {
    readUncounted(row, words);
    return false;
  }
  bool ok = true;
  for (size_t i = 0; i < words.size(); ++i) {
    switch (kindOf(row.info.operands[i]).parse) {
    case OperandClass::Label: ok = readLabel(typedElement, words[i]) && ok; continue;
    case OperandClass::Scope:
      typed.operands.push_back(parseScopeSymbol(words[i], diagnostics_));
      ++typedElement.operandCount;
      ok = typed.operands.back().form != Form::Bad && ok;
      continue;
    case OperandClass::Text: continue;
    case OperandClass::Value: break;
    }
    if (element.kind == ElementKind::Box) {
      typed.operands.push_back(parseOperand(words[i], symbols_, diagnostics_));
      ++typedElement.operandCount;
    }
    const Operand& operand = typed.operands.back();
    note(row.info.operands[i], operand, coilTraits(*typed.rung, element));
    ok = operand.form != Form::Bad && checkOperand(row, i, operand) && checkModifiers(row, element, operand) && ok;
  }
  if (!ok) return false;
  const std::span<const Operand> operands = typed.operandsOf(typedElement);
  if (row.check != nullptr) {
    const size_t before = diagnostics_.errorCount();
    row.check(operands, symbols_.config(), diagnostics_);
    if (diagnostics_.errorCount() != before) return false;
  }
  for (const Operand& operand : operands) warnInt0Only(operand);
  if (!operands.empty()) reservations_.add(row, operands[0]);
  return true;
}

// --- operands ------------------------------------------------------------------------------------------
bool RungChecker::checkOperand(const Row& row, size_t index, const Operand& operand) {
  const OperandKind& kind = kindOf(row.info.operands[index]);
  const std::string_view text = operand.source->text;
  const SourceRange range = operand.source->range;
  if (operand.form == Form::Constant) {
    if (kind.constants != 0) return checkConstant(row, index, operand);
    if (operand.fromSymbol)
      diagnostics_.report(diag::SymbolKindMismatch, range)
          << text << "a constant" << (kind.form == Form::Bit ? "a bit" : "an address");
    else
      reportNoRegister(row, index, range);
    return false;
  }
  if (operand.form != kind.form) {
    DiagBuilder report = diagnostics_.report(diag::SymbolKindMismatch, range);
    report << text << describe(operand.form) << describe(kind.form);
    const bool isWholeWord = operand.form == Form::Word && text.find(',') == std::string_view::npos;
    if (isWholeWord && kind.form == Form::Bit) report.note(fmt::format("its first bit is {}.00", text));
    return false;
  }
  return checkRegister(row, index, operand);
}

void RungChecker::reportNoRegister(const Row& row, size_t index, SourceRange range) {
  DiagBuilder report = diagnostics_.report(diag::OperandNotRegister, range);
  report << static_cast<int>(index + 1)
         << (row.shape == Shape::Contact ? "a contact"
             : row.shape == Shape::Coil  ? "a coil"
                                         : row.info.mnemonic);
  if (row.info.operands.size() > 1) report.note(frontend::operandOrder(row.info));
}

bool RungChecker::checkRegister(const Row& row, size_t index, const Operand& operand) {
  const OperandInfo& info = row.info.operands[index];
  const OperandKind& kind = kindOf(info);
  const Address& address = operand.address;
  const SourceRange range = operand.source->range;
  if (kind.words == 2) {
    if (address.word == kWords - 1 && address.isFixed()) {
      diagnostics_.report(diag::DoubleAt9999, range);
      return false;
    }
    if (address.oddIndex) {
      diagnostics_.report(diag::OddDoubleIndex, range) << operand.source->text;
      return false;
    }
  }
  const uint32_t userMemory = symbols_.config().plcNvram;
  if (kind.userMemory && address.isFixed() && address.word < userMemory) {
    diagnostics_.report(diag::UserAreaRequired, range) << operand.source->text << fmt::format("{:04}", userMemory);
    return false;
  }
  return info.access == Access::Read || checkDestination(info, operand);
}

bool RungChecker::checkDestination(const OperandInfo& info, const Operand& operand) {
  const Address& address = operand.address;
  if (address.indexRegister != kNoRegister) return true;
  const SourceRange range = operand.source->range;
  if (address.word == kFlagsWord) {
    diagnostics_.report(diag::WriteToFlags, range);
    return false;
  }
  const bool isDouble = kindOf(info).words == 2;
  if (symbols_.isInputWord(address.word) || (isDouble && symbols_.isInputWord(address.word + 1)))
    diagnostics_.report(diag::WriteToInput, range).severity(Severity::Warning)
        << operand.source->text
        << (address.word == kReserved ? "a reserved word and the next one an input; nothing that is written there stays"
                                      : "an input; what is written there stays until the NC writes it again");
  return true;
}

bool RungChecker::checkConstant(const Row& row, size_t index, const Operand& operand) {
  const OperandInfo& info = row.info.operands[index];
  const ConstantKind is = operand.constant.kind;
  const bool fits = (kindOf(info).constants & setOf(is)) != 0;
  const int64_t value = operand.constant.integer;
  if (fits && info.min <= info.max && (value < info.min || value > info.max)) {
    diagnostics_.report(diag::ConstantOutOfRange, operand.source->range)
        << operand.source->text << fmt::format("{} to {}", info.min, info.max);
    return false;
  }
  if (!fits) reportOtherConstant(row, index, operand);
  return fits;
}

// Reports a constant of the wrong format; suggests the constant, or the box, of the other format.
void RungChecker::reportOtherConstant(const Row& row, size_t index, const Operand& operand) {
  const OperandKind& kind = kindOf(row.info.operands[index]);
  const Constant& constant = operand.constant;
  DiagBuilder report = diagnostics_.report(diag::OperandTypeMismatch, operand.source->range);
  report << operand.source->text << describe(constant.kind) << row.info.mnemonic << kind.wanted;
  const std::string_view doubles = doublesOf(row.info.mnemonic);
  if (constant.kind == ConstantKind::Real && !doubles.empty())
    report.note(fmt::format("{} is for integers; for doubles there is {}", row.info.mnemonic, doubles));
  else if (constant.kind == ConstantKind::Decimal && kind.constants == setOf(ConstantKind::Real))
    report.note(fmt::format("as a double it is written *{}.0", constant.integer));
  else if (constant.kind == ConstantKind::Decimal && kind.constants == setOf(ConstantKind::Hex))
    report.note(fmt::format("in hexadecimal it is written #${:X}", static_cast<uint32_t>(constant.integer)));
  else if (constant.kind == ConstantKind::Hex && kind.constants == setOf(ConstantKind::Decimal))
    report.note(fmt::format("in decimal it is written #{}", constant.integer));
}

// Checks the modifiers: edges belong to contacts; `!` belongs to single bits of the NC area in INT0 (l.546, l.590-596).
bool RungChecker::checkModifiers(const Row& row, const ladder::Element& element, const Operand& operand) {
  const SourceRange range = operand.source->range;
  const bool immediate = operand.address.immediate;
  const std::string edge(operand.edge == 0 ? 0 : 1, operand.edge);
  if (immediate && operand.edge != 0) {
    diagnostics_.report(diag::EdgeWithImmediate, range) << edge;
    return false;
  }
  if (immediate && !inInt0_) {
    DiagBuilder report = diagnostics_.report(diag::ImmediateOutsideInt0, range);
    if (element.kind == ElementKind::Contact) report.note("a closed contact is written [/x]");
    if (element.kind == ElementKind::Coil) report.note("a negated coil is written (/x)");
    return false;
  }
  if (immediate && element.kind == ElementKind::Box) {
    diagnostics_.report(diag::ImmediateNotAllowed, range) << "an operand of " + std::string(row.info.mnemonic);
    return false;
  }
  if (immediate && operand.form == Form::Word) {
    diagnostics_.report(diag::ImmediateNotAllowed, range) << "a contact on a word";
    return false;
  }
  if (immediate && !symbols_.isNcWord(operand.address.word)) {
    diagnostics_.report(diag::ImmediateNotAllowed, range) << "an address outside the NC's area";
    return false;
  }
  if (operand.edge != 0 && element.kind != ElementKind::Contact) {
    diagnostics_.report(diag::ModifierNotAllowed, range) << edge << nameOf(element, row, operand.source->text);
    return false;
  }
  return true;
}

// The part of an operand that is added at run time: for 7000:REG,IREG everything from the ':' on, for 7000:REG,#1
// ":REG".
std::string_view computedPart(const Operand& operand) {
  const Address& address = operand.address;
  const std::string_view text = operand.source->text;
  const size_t comma = std::min(text.find(','), text.size());
  const size_t begin = address.bitRegister == kNoRegister ? comma : text.find(':');
  const size_t end = address.indexRegister == kNoRegister ? comma : text.size();
  return begin < end ? text.substr(begin, end - begin) : std::string_view();
}

// The memory of an address. A bit whose number is in a register counts as its whole word.
frontend::NamedPlace placeOf(const OperandInfo& info, const Address& address) {
  if (address.isBit && address.bitRegister == kNoRegister) return {"M", address.word * 32 + address.bit, 1};
  return {"M", address.word * 32, kindOf(info).words * 32};
}

// The symbol an operand refers to. If a constant index leads from a signal into another one, that signal's symbol.
uint32_t RungChecker::baseOf(const Operand& operand) {
  if (operand.base == nullptr) return frontend::kNoDefinition;
  const nc::Signal* signal = operand.base->signal;
  if (signal == nullptr || operand.address.indexRegister != kNoRegister) return operand.base->index;
  const nc::Signal* other = signalAfter(*signal, int64_t{operand.address.word} - signal->byteOffset / 4);
  const Symbol* found = other == nullptr ? nullptr : symbols_.find(other->symbol);
  return found == nullptr || found->signal != other ? operand.base->index : found->index;
}

void RungChecker::note(const OperandInfo& info, const Operand& operand, CoilTraits coil) {
  if (operand.form != Form::Bit && operand.form != Form::Word) return;
  analysis_.use({.range = operand.source->range,
                 .base = baseOf(operand),
                 .place = placeOf(info, operand.address),
                 .computed = computedPart(operand),
                 .access = info.access,
                 .isVariable = true,
                 .isSet = coil.isSet,
                 .isDue = coil.isDue});
}

void RungChecker::warnInt0Only(const Operand& operand) {
  if (inInt0_ || (operand.form != Form::Bit && operand.form != Form::Word)) return;
  const auto concerns = [&](const nc::Signal* signal) {
    if (signal == nullptr) return false;
    const uint32_t first = signal->byteOffset / 4;
    if (operand.address.word < first || operand.address.word >= first + signal->count) return false;
    return signal->type != nc::SignalType::Bit || (operand.address.isBit && operand.address.bit == signal->bit);
  };
  for (const nc::Signal* signal : {handwheel_, fastClock_})
    if (concerns(signal)) diagnostics_.report(diag::Int0OnlySignal, operand.source->range) << operand.source->text;
}

} // namespace rung::frontend::nct
