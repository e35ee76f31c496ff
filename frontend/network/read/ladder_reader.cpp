// Translates drawings into calls of the network builder.
#include "frontend/network/read/ladder_reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "frontend/ladder/rung.h"
#include "frontend/ladder/text/list_word.h"
#include "frontend/network/read/canonical.h"
#include "frontend/network/read/condition.h"
#include "frontend/network/read/drawn_comments.h"
#include "frontend/network/read/network_builder.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/source.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

using frontend::Access;
using ladder::Element;
using ladder::ElementId;
using ladder::ElementKind;
using ladder::NetId;
using ladder::StatementKind;

Coil coilOf(ladder::CoilKind kind) {
  switch (kind) {
  case ladder::CoilKind::Plain: return Coil::Out;
  case ladder::CoilKind::Negated: return Coil::OutInverted;
  case ladder::CoilKind::Set: return Coil::Set;
  case ladder::CoilKind::Reset: return Coil::Reset;
  }
  return Coil::Out;
}

Place placeOf(const Element& element) { return {element.range, element.line}; }

// The operand of a contact or coil. Where names have any characters, one may be in quotes.
Word operandIn(const Language& language, const Word& word) {
  const bool isQuoted =
      !language.nameMarks.empty() && word.text.size() > 2 && word.text.front() == '"' && word.text.back() == '"';
  return isQuoted ? Word{word.text.substr(1, word.text.size() - 2), word.range, true} : word;
}

bool isFalling(const Element& element) {
  return element.kind == ElementKind::Contact && element.edge == '%' && !element.negated;
}

std::string edgesOf(const Language& language) {
  return language.mnemonicsOf([](const Row& row) { return row.numbers == Row::Numbers::Edge; });
}

// Text that belongs to a rung beside its drawing.
struct RungText {
  std::string_view title;
  std::optional<std::vector<Logic>> blocks; // from a hint in a comment
};

// Reads one rung: finds its box and coils, and checks that a command list can express it.
class RungReader {
public:
  RungReader(Context& context, NetworkBuilder& builder, const ladder::Rung& rung, const RungText& text)
      : context_(context), diagnostics_(context.diagnostics), builder_(builder), rung_(rung), text_(text) {}

  // False if the drawing was rejected and reported; the builder has then received nothing.
  bool read();

private:
  void reportSecondBox(const Element& element);
  bool sort();
  bool checkKind(const Element& element);
  bool checkLeft(const Element& element);
  bool checkBox();
  bool checkPins();
  bool checkCoils();
  bool decomposeInputs();
  bool orderInputs();
  std::string nameOf(const Element& element) const;
  void emitInputs();
  void emitBox();

  Context& context_;
  Diagnostics& diagnostics_;
  NetworkBuilder& builder_;
  const ladder::Rung& rung_;
  const RungText& text_;
  const Element* box_ = nullptr;
  const Row* row_ = nullptr;
  std::vector<const Element*> coils_; // sorted from top to bottom
  std::vector<SpTree> inputs_;
  std::vector<CanonicalStep> steps_;
};

std::string RungReader::nameOf(const Element& element) const {
  return element.kind == ElementKind::Box    ? std::string(element.mnemonic)
         : element.kind == ElementKind::Coil ? "the coil"
                                             : "the contact";
}

bool RungReader::checkKind(const Element& element) {
  const bool hasFalling = !context_.language.nameOf(Command::LoadFalling).empty();
  if (element.edge != 0 && !(hasFalling && isFalling(element))) {
    diagnostics_.report(diag::UnsupportedElement, element.range)
        << (element.kind == ElementKind::Coil ? "a coil for an edge" : "an edge contact")
        << fmt::format("use {}", edgesOf(context_.language));
    return false;
  }
  if (element.kind == ElementKind::Contact && !element.output.valid()) {
    diagnostics_.report(diag::MissingClosingElement, element.range) << "this contact";
    return false;
  }
  return true;
}

// Checks what is on the left of an element: contacts may follow only contacts, coils also a box (GSK: l.3562).
bool RungReader::checkLeft(const Element& element) {
  for (const ladder::Pin& pin : rung_.pinsOf(element)) {
    for (ElementId id : rung_.driversOf(pin.input)) {
      const ElementKind left = rung_.element(id).kind;
      if (left == ElementKind::Contact || (left == ElementKind::Box && element.kind == ElementKind::Coil)) continue;
      const Row* row = left == ElementKind::Box ? context_.language.findFunction(rung_.element(id).mnemonic) : nullptr;
      if (row != nullptr && row->info.output == frontend::Output::None)
        diagnostics_.report(diag::ElementAfterClosing, element.range) << row->info.mnemonic;
      else
        diagnostics_.report(diag::MultiLevelOutput, element.range);
      return false;
    }
  }
  return true;
}

// Reports a second box. Two boxes one below the other may be meant as one box with more pins than it has.
void RungReader::reportSecondBox(const Element& element) {
  const Row* row = context_.language.findFunction(box_->mnemonic);
  if (context_.language.findFunction(element.mnemonic) == nullptr && element.column == box_->column)
    diagnostics_.report(diag::UnknownPin, element.range)
        << box_->mnemonic << element.mnemonic
        << (row == nullptr || furtherPinsOf(row->info).empty() ? "no further pins"
                                                               : "its pins on the lines directly below");
  else
    diagnostics_.report(diag::MultiLevelOutput, element.range);
}

// Sorts the elements into box and coils; a network has at most one function.
bool RungReader::sort() {
  bool good = true;
  for (const Element& element : rung_.elements) {
    if (!checkKind(element) || !checkLeft(element)) {
      good = false;
    } else if (element.kind == ElementKind::Coil) {
      coils_.push_back(&element);
    } else if (element.kind == ElementKind::Box) {
      if (box_ != nullptr) reportSecondBox(element);
      good = good && box_ == nullptr;
      if (box_ == nullptr) box_ = &element;
    }
  }
  std::sort(coils_.begin(), coils_.end(), [](const Element* a, const Element* b) {
    return std::pair(a->line, a->column) < std::pair(b->line, b->column);
  });
  return good;
}

bool RungReader::checkBox() {
  if (box_ == nullptr) return true;
  row_ = context_.language.findFunction(box_->mnemonic);
  if (row_ == nullptr) {
    reportUnknownFunction(context_, box_->mnemonic, box_->mnemonicRange, ladder::drawnFor(box_->mnemonic));
    return false;
  }
  context_.analysis.use(frontend::InstructionUse{box_->mnemonicRange, &row_->info});
  if (isEnd(row_->control) || row_->control == Control::Sp) {
    diagnostics_.report(diag::UnsupportedElement, box_->range)
        << fmt::format("a box {}", row_->info.mnemonic) << "a `module` statement begins and ends what it would";
    return false;
  }
  if (row_->info.output == frontend::Output::None && box_->output.valid()) {
    const auto after = rung_.consumersOf(box_->output);
    diagnostics_.report(diag::ElementAfterClosing, after.empty() ? box_->range : rung_.element(after[0]).range)
        << row_->info.mnemonic;
    return false;
  }
  return checkPins();
}

bool RungReader::checkPins() {
  const auto pins = rung_.pinsOf(*box_);
  if (!ladder::checkPins(row_->info, pins, box_->range, text::equalsIgnoringCase, diagnostics_)) return false;
  for (size_t i = 0; i < pins.size(); ++i) {
    if (!isMisplaced(row_->info, pins[i])) continue;
    if (pins[i].input == ladder::kRail)
      diagnostics_.report(diag::MissingCondition, pins[i].range)
          << row_->info.mnemonic << fmt::format("pin {}", row_->info.pins[i].name);
    else
      diagnostics_.report(diag::FirstColumnRequired, pins[i].range) << row_->info.mnemonic;
    return false;
  }
  return true;
}

// Checks that all coils are on one net: that of the contacts, or the box's output and nothing else.
bool RungReader::checkCoils() {
  if (coils_.empty()) {
    if (row_ != nullptr && row_->info.output == frontend::Output::Always)
      diagnostics_.report(diag::MissingOutput, box_->range) << row_->info.mnemonic;
    return row_ != nullptr && row_->info.output != frontend::Output::Always;
  }
  const NetId net = box_ != nullptr ? box_->output : rung_.inputOf(*coils_[0]);
  for (const Element* coil : coils_) {
    if (net.valid() && rung_.inputOf(*coil) == net) continue;
    diagnostics_.report(diag::MultiLevelOutput, coil->range);
    return false;
  }
  if (net == ladder::kRail) {
    diagnostics_.report(diag::MissingCondition, coils_[0]->range) << "the coil" << "its left";
    return false;
  }
  if (box_ != nullptr && rung_.driversOf(net).size() > 1) {
    diagnostics_.report(diag::NotSeriesParallel, box_->range) << "the coils";
    return false;
  }
  return true;
}

bool RungReader::decomposeInputs() {
  std::vector<NetId> nets;
  if (box_ == nullptr)
    nets.push_back(rung_.inputOf(*coils_[0]));
  else
    for (const ladder::Pin& pin : rung_.pinsOf(*box_))
      if (pin.input != ladder::kRail) nets.push_back(pin.input);
  for (NetId net : nets) {
    auto tree = decompose(rung_, net);
    if (!tree) {
      const Element& target = box_ != nullptr ? *box_ : *coils_[0];
      diagnostics_.report(diag::NotSeriesParallel, target.range) << nameOf(target);
      return false;
    }
    inputs_.push_back(std::move(*tree));
  }
  return true;
}

// The contacts as a list has them. Only the first one of a network may be a falling edge.
bool RungReader::orderInputs() {
  for (const SpTree& input : inputs_) {
    const std::vector<CanonicalStep> own = canonicalSteps(input);
    steps_.insert(steps_.end(), own.begin(), own.end());
  }
  if (text_.blocks)
    if (auto other = withBlocks(steps_, *text_.blocks, context_.language.stackDepth)) steps_ = std::move(*other);
  for (size_t i = 1; i < steps_.size(); ++i) {
    if (!steps_[i].contact.valid() || !isFalling(rung_.element(steps_[i].contact))) continue;
    diagnostics_.report(diag::UnsupportedElement, rung_.element(steps_[i].contact).range)
        << "an edge contact that does not begin its rung" << fmt::format("use {}", edgesOf(context_.language));
    return false;
  }
  return true;
}

void RungReader::emitInputs() {
  Place last;
  for (const CanonicalStep& step : steps_) {
    if (!step.contact.valid()) {
      builder_.block(step.kind, last);
      continue;
    }
    const Element& contact = rung_.element(step.contact);
    last = placeOf(contact);
    const Contact type = contact.negated ? Contact::Closed : isFalling(contact) ? Contact::Falling : Contact::Open;
    builder_.contact(step.kind, type, operandIn(context_.language, rung_.operandOf(contact)), last);
  }
}

// Whether the operand of a box begins its table. It may also be a name, in place of a parameter.
bool beginsTable(const Context& context, const Row& row, const Word& word, size_t index) {
  return row.hasTable && text::equalsIgnoringCase(word.text, context.language.nameOf(Command::Table)) &&
         (index == row.info.operands.size() || !context.names.has(word.text));
}

void RungReader::emitBox() {
  builder_.function(row_, placeOf(*box_));
  bool table = false;
  size_t index = 0;
  for (const Word& operand : rung_.operandsOf(*box_)) {
    const Place at{operand.range, box_->line};
    if (!table && beginsTable(context_, *row_, operand, index++))
      table = true;
    else if (table)
      builder_.tableRow(operand, at);
    else
      builder_.parameter(operand, at);
  }
}

bool RungReader::read() {
  if (!sort() || !checkBox() || !checkCoils() || !decomposeInputs() || !orderInputs()) return false;
  builder_.title(text_.title);
  emitInputs();
  if (box_ != nullptr) emitBox();
  for (const Element* coil : coils_)
    builder_.coil(coilOf(coil->coil), operandIn(context_.language, rung_.operandOf(*coil)), placeOf(*coil));
  builder_.finish();
  return true;
}

// Whether the box may begin or end a region, or be a label or a call. Unknown boxes may.
bool mayShapeProgram(const Language& language, std::string_view mnemonic) {
  const Row* row = language.findFunction(mnemonic);
  return row == nullptr || row->control != Control::Plain;
}

// Whether a rejected rung may contain a region, label or call.
bool mayShapeProgram(const Context& context, const ladder::Rung& rung) {
  return std::ranges::any_of(rung.elements, [&](const Element& element) {
    if (element.kind == ElementKind::Error)
      return std::ranges::any_of(ladder::boxWords(context.sources.text(element.range)),
                                 [&](std::string_view word) { return mayShapeProgram(context.language, word); });
    return element.kind == ElementKind::Box && mayShapeProgram(context.language, element.mnemonic);
  });
}

// Buttons exist in other dialects only, and are reported.
Item::Kind itemKindOf(ladder::DeclarationKind kind) {
  switch (kind) {
  case ladder::DeclarationKind::Symbol: return Item::Kind::Symbol;
  case ladder::DeclarationKind::Const: return Item::Kind::Const;
  case ladder::DeclarationKind::Message:
  case ladder::DeclarationKind::Button: return Item::Kind::Message;
  case ladder::DeclarationKind::Data: return Item::Kind::Data;
  }
  return Item::Kind::Comment;
}

class LadderReader {
public:
  LadderReader(Context& context, const ladder::LadderFile& file, UnitAssembler& units)
      : context_(context), file_(file), units_(units),
        builder_(context, file.file, [this](Network&& n) { take(std::move(n)); }) {}

  void read() {
    while (next_ < file_.statements.size()) readStatement(file_.statements[next_++]);
  }

private:
  void readStatement(const ladder::Statement& statement);
  void comment(const ladder::Comment& comment) {
    if (context_.sources.isEncodingComment(comment.range)) return;
    title_.comment(comment.text);
    context_.gaps.comment(comment.text);
  }
  void blank() {
    title_.blank();
    context_.gaps.blank();
  }
  void declaration(const ladder::Declaration& declaration);
  void module(const ladder::Module& module, std::string_view comment);
  std::vector<Written> condition();
  void readRung(const ladder::Rung& rung, std::string_view comment);
  void readRejected(const ladder::Rung& rung);
  void readOperands(const ladder::Rung& rung, const Element& element);
  void take(Network&& network) {
    network.firstLine = rung_->firstLine;
    network.lastLine = rung_->lastLine;
    network.range = rung_->range;
    if (context_.gaps.areKept()) attachComments(context_.language, *rung_, network);
    units_.at(unit_).networks.push_back(std::move(network));
  }

  Context& context_;
  const ladder::LadderFile& file_;
  UnitAssembler& units_;
  NetworkBuilder builder_;
  const ladder::Rung* rung_ = nullptr;
  uint32_t unit_ = kNone;
  TitleRule title_;
  size_t next_ = 0; // index of the next statement
};

void LadderReader::readStatement(const ladder::Statement& statement) {
  switch (statement.kind) {
  case StatementKind::Comment: return comment(file_.comments[statement.index]);
  case StatementKind::Blank: return blank();
  case StatementKind::Dialect: context_.gaps.dialect(statement.comment); break;
  case StatementKind::Declaration: declaration(file_.declarations[statement.index]); break;
  case StatementKind::Section:
    context_.gaps.section(file_.sections[statement.index].title.text, statement.comment);
    break;
  case StatementKind::Module: module(file_.modules[statement.index], statement.comment); break;
  case StatementKind::Rung: readRung(file_.rungs[statement.index], statement.comment); break;
  }
  title_.statement();
}

void LadderReader::declaration(const ladder::Declaration& declaration) {
  context_.gaps.declaration(itemKindOf(declaration.kind), declaration.name, declaration.value, declaration.comment);
}

// "module LEVEL1, module LEVEL2 or module SUB Pn"
std::string modulesText(const Language& language) {
  std::string text;
  for (const Level& level : language.levels) text += fmt::format("{}module {}", text.empty() ? "" : ", ", level.name);
  return fmt::format("{} or module {} {}n", text, language.subprogram, language.letterOf(Control::Sp));
}

void LadderReader::module(const ladder::Module& module, std::string_view comment) {
  unit_ = kNone;
  std::vector<Written> condition;
  const Language& language = context_.language;
  const auto level = module.name.size() == 1 ? language.findLevel(module.name[0].text) : std::nullopt;
  if (level) {
    unit_ = units_.openLevel(*level, module.range);
  } else if (module.name.size() == 2 && text::equalsIgnoringCase(module.name[0].text, language.subprogram)) {
    // The subprogram's number is checked like the operand of SP.
    Network sp{.function = {.row = &language.rowOf(Control::Sp), .range = module.range}};
    if (checkFunction(context_, {module.name[1]}, {}, sp))
      unit_ =
          units_.openSubprogram(static_cast<uint32_t>(sp.function.params[0].value), module.range, module.name[1].range);
    condition = this->condition();
  } else {
    context_.diagnostics.report(diag::MalformedStatement, module.range) << "module" << modulesText(language);
  }
  if (unit_ == kNone) return units_.setIncomplete();
  if (!context_.gaps.areKept()) return;
  Unit& unit = units_.at(unit_);
  unit.lead = context_.gaps.take();
  unit.comment = clean(comment);
  unit.condition = std::move(condition);
}

// Reads the condition of a subprogram from comments. It is warned of and its steps are counted as in a command list
// (P1, P13).
std::vector<Written> LadderReader::condition() {
  const auto rest = std::span(file_.statements).subspan(next_);
  const auto end = std::ranges::find_if(rest, [](const auto& one) { return one.kind != StatementKind::Comment; });
  if (end == rest.begin()) return {};
  const auto comments = std::span(file_.comments).subspan(rest[0].index, static_cast<size_t>(end - rest.begin()));
  std::vector<Written> commands = conditionIn(context_, comments);
  if (commands.empty()) return commands;
  next_ += commands.size();
  context_.diagnostics.report(diag::ConditionIgnored, commands.front().range)
      << context_.language.mnemonicOf(Control::Sp);
  for (const Written& written : commands) countStep(context_, written.range);
  return commands;
}

// The title is the text after the word `rung`; if that cannot be a title, the rule of command lists applies.
void LadderReader::readRung(const ladder::Rung& rung, std::string_view comment) {
  rung_ = &rung;
  if (unit_ == kNone) return; // reported with the module
  const std::string_view own = text::trimmed(rung.comment);
  if (!own.empty()) context_.gaps.title(own);
  if (!comment.empty()) context_.gaps.remark(comment);
  const RungText text{isTitle(own) ? own : title_.title(), blocksIn(context_.language, rung)};
  RungReader reader(context_, builder_, rung, text);
  if (rung.bad || !reader.read()) readRejected(rung);
}

// Checks the operands of a rung whose drawing was rejected.
void LadderReader::readRejected(const ladder::Rung& rung) {
  if (mayShapeProgram(context_, rung)) units_.setIncomplete();
  for (const Element& element : rung.elements) readOperands(rung, element);
}

void LadderReader::readOperands(const ladder::Rung& rung, const Element& element) {
  const std::span<const Word> words = rung.operandsOf(element);
  switch (element.kind) {
  case ElementKind::Contact: readBit(context_, operandIn(context_.language, words[0]), Access::Read); return;
  case ElementKind::Coil: readBit(context_, operandIn(context_.language, words[0]), Access::Write); return;
  case ElementKind::Error: return;
  case ElementKind::Box: break;
  }
  Function function{.row = context_.language.findFunction(element.mnemonic), .range = element.range};
  const bool mayBePin = words.empty();
  if (function.row == nullptr && !mayBePin)
    reportUnknownFunction(context_, element.mnemonic, element.mnemonicRange, ladder::drawnFor(element.mnemonic));
  if (function.row == nullptr) return;
  context_.analysis.use(frontend::InstructionUse{element.mnemonicRange, &function.row->info});
  size_t index = 0;
  const auto table = std::ranges::find_if(
      words, [&](const Word& word) { return beginsTable(context_, *function.row, word, index++); });
  const auto rows = table == words.end() ? words.end() : table + 1;
  Network network{.function = std::move(function)};
  checkFunction(context_, {words.begin(), table}, {rows, words.end()}, network);
}

} // namespace

ladder::LadderFile parseLadderFile(Context& context, FileId file) {
  return ladder::parseLadder(context.sources, file, context.diagnostics, context.language.findBox);
}

namespace {

void declareSymbol(Context& context, const ladder::Declaration& declaration) {
  if (const auto addSymbol = context.language.list.addSymbol)
    addSymbol(context, declaration.name, declaration.value, declaration.comment);
  else
    context.names.addSymbol(context, declaration.name, declaration.value, declaration.comment);
}

// Messages and data belong to languages whose lists have sections for them; the dialect reads them there and here.
void checkText(Context& context, const ladder::Declaration& declaration) {
  const bool hasSections = context.language.list.frame != nullptr;
  if (hasSections && declaration.kind != ladder::DeclarationKind::Button) return;
  context.diagnostics.report(diag::UnsupportedElement, declaration.range)
      << "a statement for texts" << context.language.messageTexts;
}

} // namespace

void readLadderDeclarations(Context& context, const ladder::LadderFile& file) {
  Diagnostics& diagnostics = context.diagnostics;
  const std::string_view own = context.language.name;
  if (!file.dialect.empty() && !text::equalsIgnoringCase(file.dialect, own))
    diagnostics.report(diag::DialectConflict, file.dialectRange) << file.dialect << own;
  for (const ladder::Declaration& declaration : file.declarations) {
    switch (declaration.kind) {
    case ladder::DeclarationKind::Symbol: declareSymbol(context, declaration); break;
    case ladder::DeclarationKind::Const: context.names.addConstant(context, declaration.name, declaration.value); break;
    case ladder::DeclarationKind::Message:
    case ladder::DeclarationKind::Button:
    case ladder::DeclarationKind::Data: checkText(context, declaration); break;
    }
  }
}

void readLadder(Context& context, const ladder::LadderFile& file, UnitAssembler& units) {
  LadderReader(context, file, units).read();
}

} // namespace rung::frontend::network
