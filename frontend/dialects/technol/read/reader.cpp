// Reads files as statements (see reader.h).
#include "frontend/dialects/technol/read/reader.h"

#include "frontend/dialects/technol/read/file_reader.h"
#include "frontend/dialects/technol/read/lexer.h"
#include "frontend/sema/operand_count.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/technol.h"
#include "ir/support/meant.h"
#include "rtlib/text/letters.h"

#include <algorithm>
#include <ranges>

namespace rung::frontend::technol {
namespace {

constexpr size_t kMaxFiles = 64; // man. l.2721

std::string describe(std::span<const Token> tokens) {
  if (tokens.empty()) return "the end of the line";
  return "'" + std::string(tokens[0].text) + "'";
}

// A command of another language at the beginning of a statement, such as LD, AND NOT, RD.NOT.STK or ST -X.
struct ForeignCommand {
  const ForeignWord* word = nullptr;
  size_t tokens = 1;
};

ForeignCommand foreignCommand(std::span<const Token> tokens) {
  constexpr size_t kLongest = 5;
  for (size_t count = std::min(tokens.size(), kLongest); count > 0; --count)
    if (const ForeignWord* word = foreignWord(spelled(tokens.first(count)))) return {word, count};
  return {};
}

// Whether an operand is negated: -X or NOT X.
bool areNegated(std::span<const Token> operands) {
  const auto isNegated = [](std::span<const Token> operand) {
    return !operand.empty() && (operand[0].is('-') || text::equalsIgnoringCase(operand[0].text, "NOT"));
  };
  return std::ranges::any_of(splitOperands(operands), isNegated);
}

// Whether the instruction takes this number of operands. True for a macro, which has no row.
bool takesAsMany(const Row* row, std::span<const Token> operands) {
  Diagnostics discarded;
  return row == nullptr || countFits(row->info, splitOperands(operands).size(), {}, discarded);
}

// Notes that a label may lack its colon: NAME INSTRUCTION …, or NAME alone, unless it resembles a word that opens,
// closes or declares something.
void noteLabel(std::span<const Token> tokens, std::string_view similar, DiagBuilder& report) {
  const Row* like = findRow(similar);
  const bool alone = tokens.size() == 1 && (like == nullptr || like->role == Role::Code);
  if (alone || (tokens.size() > 1 && tokens[1].kind == TokenKind::Name && findRow(tokens[1].text) != nullptr &&
                reservedWord(tokens[1].text) == Reserved::Yes))
    report.note("a label ends with a colon: " + std::string(tokens[0].text) + ":");
}

} // namespace

// Reports `A-B:`, a label that is not a valid name; a colon has no other meaning. True if it was reported.
bool FileReader::splitLabel(uint32_t& first, uint32_t& count) {
  const std::span<const Token> tokens = std::span<const Token>(program_.tokens).subspan(first, count);
  if (count > 2 && tokens[2].is(':') && takeSign(tokens, c_.diagnostics)) { // the label is the name without its sign
    ++first, --count;
    return false;
  }
  const auto colon = std::find_if(tokens.begin(), tokens.end(), [](const Token& token) { return token.is(':'); });
  if (colon == tokens.end() || colon - tokens.begin() < 2 || tokens[0].kind == TokenKind::Punct) return false;
  if (tokens[0].kind == TokenKind::Name && findRow(tokens[0].text) != nullptr) return false;
  const auto label = tokens.first(static_cast<size_t>(colon - tokens.begin()));
  c_.report(diag::BadIdentifier, rangeOf(program_.sources, label, tokens[0].range())) << spelled(label);
  first += static_cast<uint32_t>(label.size()) + 1;
  count -= static_cast<uint32_t>(label.size()) + 1;
  return true;
}

// Takes `name :` off the front; returns the token of the name, or kNone.
uint32_t FileReader::readLabel(uint32_t& first, uint32_t& count) {
  if (splitLabel(first, count)) return kNone;
  if (count < 2 || !program_.tokens[first + 1].is(':')) return kNone;
  const Token name = program_.tokens[first];
  uint32_t label = first;
  if (name.kind == TokenKind::Number) {
    c_.report(diag::BadIdentifier, name.range()) << name.text;
    label = kNone;
  } else if (name.kind != TokenKind::Name) {
    return kNone;
  }
  first += 2;
  count -= 2;
  return label;
}

// Reads `V NAME <1,2>` or `V: NAME <1,2>` if NAME is a structure; otherwise false.
bool FileReader::instance(uint32_t first, uint32_t count, uint32_t line) {
  const std::span<const Token> tokens = std::span<const Token>(program_.tokens).subspan(first, count);
  const bool named = count > 1 && tokens[0].kind == TokenKind::Name &&
                     (findRow(tokens[0].text) == nullptr || reservedWord(tokens[0].text) != Reserved::Yes) &&
                     structures_.find(tokens[1]) != kNone;
  const uint32_t type = structures_.find(tokens[named ? 1 : 0]);
  if (type == kNone) return false;
  const Token word = tokens[named ? 1 : 0];
  const Statement made{.row = findRow("STRUC"),
                       .pos = word.pos,
                       .length = static_cast<uint32_t>(word.text.size()),
                       .line = line,
                       .firstToken = first + (named ? 2 : 1),
                       .tokenCount = count - (named ? 2 : 1),
                       .unit = structure_.unit(),
                       .file = file_};
  if (named) pendingLabels_.push_back(first);
  const Token name = pendingLabels_.empty() ? Token() : program_.tokens[pendingLabels_.back()];
  const auto index = static_cast<uint32_t>(program_.statements.size());
  declarations_.instance(made, pendingLabels_.empty() ? nullptr : &name, index, type);
  takeDataLabels();
  program_.statements.push_back(made);
  return true;
}

// Reports an instruction of another language and explains its equivalent. False if it is not a known one.
bool FileReader::foreign(std::span<const Token> tokens) {
  const ForeignCommand found = foreignCommand(tokens);
  const bool hasSign = found.tokens == 2 && tokens[1].is('-'); // belongs to the operand
  const std::span<const Token> command = tokens.first(found.tokens - (hasSign ? 1 : 0));
  const std::span<const Token> operands = tokens.subspan(command.size());
  const bool assembler = found.tokens == 1 && isAssembler(tokens[0].text);
  if (found.word == nullptr && !assembler) return false;
  const SourceRange range = rangeOf(program_.sources, command, tokens[0].range());
  DiagBuilder report = c_.report(assembler ? diag::UnsupportedAssembler : diag::UnknownInstruction, range);
  report << spelled(command);
  if (found.word == nullptr) return true;
  const auto takesThem = [&](const Row& row) { return takesAsMany(&row, operands); };
  const bool fits = !assembler && takesAsMany(findRow(found.word->here), operands) && !areNegated(operands) &&
                    !isAmbiguous(found.word->word, allRows() | std::views::filter(takesThem),
                                 [](const Row& row) { return row.info.mnemonic; });
  explainForeign(report, range, *found.word, fits);
  return true;
}

// Reports an unknown instruction with a suggestion; two words may be one name that lost its `_`. Returns the row of the
// suggestion if it opens, closes or declares something and fits here, so that the following statements are understood.
const Row* FileReader::unknown(uint32_t& first, uint32_t& count) {
  const std::span<const Token> tokens = std::span<const Token>(program_.tokens).subspan(first, count);
  const Token& token = tokens[0];
  if (foreign(tokens)) return nullptr;
  std::string word(token.text);
  if (tokens.size() > 1 && tokens[1].kind == TokenKind::Name)
    if (const std::string both = word + (word.ends_with('_') ? "" : "_") + std::string(tokens[1].text); findRow(both))
      word = both;
  const bool parted = word != token.text;
  text::Similar similar(word);
  for (const Row& row : allRows()) similar.offer(row.info.mnemonic);
  macros_.offer(similar);
  DiagBuilder report = c_.report(diag::UnknownInstruction, token.range());
  report << token.text;
  noteLabel(tokens, similar.best(), report);
  if (similar.best().empty() || isModified(word, similar.best())) return nullptr;
  const size_t words = parted ? 2 : 1;
  const Row* row = findRow(similar.best());
  suggest(report, rangeOf(program_.sources, tokens.first(words), token.range()),
          {similar.best(), similar.certain() && takesAsMany(row, tokens.subspan(words))});
  if (row == nullptr || !structure_.fits(*row)) return nullptr;
  if (parted) ++first, --count;
  return row;
}

const Row* FileReader::instruction(uint32_t& first, uint32_t& count) {
  const Token& token = program_.tokens[first];
  if (token.kind != TokenKind::Name) {
    c_.report(diag::SyntaxError, token.range()) << "an instruction" << describe({&token, 1});
    return nullptr;
  }
  const Row* row = findRow(token.text);
  if (row == nullptr) return unknown(first, count);
  if (!text::equalsIgnoringCase(row->info.mnemonic, token.text))
    c_.report(diag::JloAlias, token.range()).fix(token.range(), row->info.mnemonic);
  return row;
}

// Whether the statement ends an open macro definition: a macro cannot extend beyond a module or the start of another
// macro.
bool FileReader::endsMacros(const Token& head) {
  const Row* row = head.kind == TokenKind::Name ? findRow(head.text) : nullptr;
  if (row == nullptr) return false;
  return row->role == Role::Module || row->role == Role::ModuleEnd || row->role == Role::Stop ||
         row->info.mnemonic == "DEF_T_MACRO";
}

void FileReader::logicalLine(uint32_t first, uint32_t count, uint32_t line) {
  if (macros_.defining() && endsMacros(program_.tokens[first])) macros_.abandon();
  if (macros_.defining()) {
    macros_.take(std::vector<Token>(program_.tokens.begin() + first, program_.tokens.begin() + first + count), line);
    return;
  }
  if (structures_.line(std::span(program_.tokens).subspan(first, count))) return;
  const uint32_t begin = first;
  const bool colonFirst = program_.tokens[first].is(':');
  const uint32_t label = readLabel(first, count);
  const bool labelled = first != begin && !colonFirst;
  if (label != kNone) pendingLabels_.push_back(label);
  badLabel_ = labelled && label == kNone;
  if (count == 0) return;
  if (program_.tokens[first].is(':')) {
    c_.report(diag::SyntaxError, program_.tokens[first].range()) << "a name before ':'" << "none";
    return;
  }
  if (macroLine(first, count, line) || instance(first, count, line)) return;
  const Row* row = instruction(first, count);
  statement(row, first, count, line);
}

void FileReader::statement(const Row* row, uint32_t first, uint32_t count, uint32_t line) {
  const Token& mnemonic = program_.tokens[first];
  Statement made{.row = row,
                 .pos = mnemonic.pos,
                 .length = static_cast<uint32_t>(mnemonic.text.size()),
                 .line = line,
                 .firstToken = first + 1,
                 .tokenCount = count - 1,
                 .unit = structure_.unit(),
                 .file = file_};
  const auto index = static_cast<uint32_t>(program_.statements.size());
  const bool isData = row && (row->role == Role::Dfm || row->role == Role::Ds || row->role == Role::Str);
  if (row != nullptr && !allowedInInclude(made)) {
    pendingLabels_.clear();
    return;
  }
  if (isData && row->role == Role::Dfm && !expanding_.empty()) checkEightBits(made);
  if (isData) {
    const Token* name = pendingLabels_.empty() ? nullptr : &program_.tokens[pendingLabels_.back()];
    declarations_.data(made, name, index, badLabel_);
    takeDataLabels();
    program_.statements.push_back(made);
    return;
  }
  const bool keepsLabels = row && (row->role == Role::Equi || row->role == Role::Module || row->role == Role::Local);
  if (!keepsLabels) attachLabels(made, index);
  if (row != nullptr) structural(made, index);
  program_.statements.push_back(made);
}

// Labels on lines of their own also name the next declaration (man. l.27-29); the last one is already its name. Between
// instructions they are labels of code.
void FileReader::takeDataLabels() {
  if (!structure_.inData() && !structure_.localOpen()) {
    if (!pendingLabels_.empty()) pendingLabels_.pop_back();
    return;
  }
  for (size_t i = 0; i + 1 < pendingLabels_.size(); ++i) {
    const Token name = program_.tokens[pendingLabels_[i]];
    declarations_.alsoNamed(name);
  }
  pendingLabels_.clear();
}

// Inside macros a DFM must name all eight bits (man. l.20454).
void FileReader::checkEightBits(const Statement& statement) {
  const auto operands = splitOperands(program_.operandTokens(statement));
  const bool all =
      operands.size() >= 8 && std::none_of(operands.begin(), operands.end(), [](const auto& o) { return o.empty(); });
  if (!all) c_.report(diag::DfmNeedsEight, statement.range());
}

// Declares the pending labels. They are local to the file and belong to the open unit.
void FileReader::attachLabels(Statement& statement, uint32_t index) {
  pendingLabels_.insert(pendingLabels_.begin(), codeLabels_.begin(), codeLabels_.end());
  codeLabels_.clear();
  for (const uint32_t token : pendingLabels_) {
    const Token& name = program_.tokens[token];
    structure_.passLabel(name.text);
    const auto label = static_cast<uint32_t>(program_.labels.size());
    if (statement.label == kNone) statement.label = label;
    program_.labels.push_back({.name = name.text, .unit = structure_.unit(), .statement = index, .passed = passed_});
    Symbol symbol = namedSymbol(name, SymbolKind::Label, file_, true);
    symbol.index = label;
    c_.symbols.declare(symbol);
  }
  pendingLabels_.clear();
  statement.unit = structure_.unit();
}

const Token* FileReader::oneName(const Statement& statement) {
  const std::span<const Token> tokens = program_.operandTokens(statement);
  if (tokens.size() == 1 && tokens[0].kind == TokenKind::Name) return &tokens[0];
  const size_t found = splitOperands(tokens).size();
  if (found == 1 && isOneWord(tokens))
    c_.report(diag::BadIdentifier, rangeOf(program_.sources, tokens, statement.range())) << spelled(tokens);
  else if (countFits(statement.row->info, found, statement.range(), c_.diagnostics))
    c_.report(diag::SyntaxError, tokens[0].range()) << "a name" << describe(tokens);
  return nullptr;
}

void FileReader::declareUnit(const Token& name, SymbolKind kind, uint32_t index) {
  Symbol symbol = namedSymbol(name, kind, file_, false);
  symbol.index = index;
  if (kind == SymbolKind::Mechanism) {
    symbol.space = kMechanismSpace;
    symbol.byte = index * kMechanismBytes;
    symbol.type = ir::Type::Bit;
    c_.declarations.mechanismBytes += kMechanismBytes;
  }
  const size_t errors = c_.diagnostics.errorCount();
  c_.symbols.declare(symbol);
  // The suffix of a longer name would be cut off, so it could not be distinguished from the mechanism.
  if (kind != SymbolKind::Mechanism || name.text.size() >= kSignificant) return;
  if (c_.diagnostics.errorCount() > errors) return;
  // name_LINE, a WORD (man. l.2210)
  program_.madeTexts.push_back(std::string(name.text) + "_LINE");
  symbol.name = program_.madeTexts.back();
  symbol.kind = SymbolKind::Cell;
  symbol.type = ir::Type::I16;
  symbol.byte += 1;
  symbol.size = 2;
  symbol.index = kNone;
  c_.symbols.declare(symbol);
}

// Checks that statements without operands have none; those with a check of their own are excluded.
void FileReader::checkNoOperands(const Statement& statement) {
  const Role role = statement.row->role;
  if (role == Role::Code || role == Role::MacroBegin || role == Role::MacroEnd) return;
  if (!statement.row->info.operands.all().empty() || statement.tokenCount == 0) return;
  const std::span<const Token> tokens = program_.operandTokens(statement);
  countFits(statement.row->info, splitOperands(tokens).size(), rangeOf(program_.sources, tokens, statement.range()),
            c_.diagnostics);
}

// Checks DEBUG [ON|OFF].
void FileReader::checkSwitch(const Statement& statement) {
  if (statement.tokenCount == 0 || statement.row->info.operands.all().empty()) return;
  const std::span<const Token> tokens = program_.operandTokens(statement);
  if (!countFits(statement.row->info, splitOperands(tokens).size(), statement.range(), c_.diagnostics)) return;
  if (tokens.size() > 1 ||
      !(text::equalsIgnoringCase(tokens[0].text, "ON") || text::equalsIgnoringCase(tokens[0].text, "OFF")))
    c_.report(diag::SyntaxError, tokens[0].range()) << "ON or OFF" << describe(tokens);
}

void FileReader::structural(Statement& statement, uint32_t index) {
  checkNoOperands(statement);
  const auto kind = static_cast<ModuleKind>(statement.row->variant);
  switch (statement.row->role) {
  case Role::Module:
    structure_.beginModule(statement, kind, index + 1);
    attachLabels(statement, index);
    return;
  case Role::ModuleEnd: structure_.endModule(statement, kind, index + 1); return;
  case Role::Local:
    if (!structure_.inData()) codeLabels_.swap(pendingLabels_);
    structure_.beginLocal(statement);
    return;
  case Role::LocalEnd: structure_.endLocal(statement); return;
  case Role::Stop: structure_.stop(statement, index); return;
  case Role::Equi: declarations_.constant(statement); return;
  case Role::MemberSize:
    c_.report(diag::DeclarationOutsideData, statement.range()) << statement.row->info.mnemonic;
    return;
  case Role::NoCode: checkSwitch(statement); return;
  case Role::Code:
  case Role::MechBegin:
  case Role::MechEnd:
  case Role::ProcBegin:
  case Role::ProcEnd:
  case Role::Timed: code(statement, index); return;
  default: return; // read elsewhere
  }
}

// Whether the instruction is allowed here: some are restricted to MODULE_INIT and to procedures that it may call (man.
// l.5222).
bool FileReader::mayStandThere(const Statement& statement) const {
  const UnitId owner = program_.owner(statement.unit);
  if ((statement.row->effects & kInitOnly) == 0 || !owner.valid()) return true;
  const Unit& unit = program_.at(owner);
  return unit.kind == UnitKind::Procedure || (unit.kind == UnitKind::Module && unit.module == ModuleKind::Init);
}

void FileReader::code(Statement& statement, uint32_t index) {
  if (!structure_.allowsCode(statement)) {
    statement.row = nullptr;
    return;
  }
  if (statement.row->effects & kDeclares) declarations_.exchanged(statement, index);
  if (!mayStandThere(statement)) {
    c_.report(diag::InitOnlyInstruction, statement.range()) << statement.row->info.mnemonic;
    statement.row = nullptr;
    return;
  }
  const Role role = statement.row->role;
  const uint16_t effects = statement.row->effects;
  if (effects & kEndsInit) program_.files[file_].finishesInit = true;
  if (effects & kEndsDone) program_.files[file_].finishesDone = true;
  if (role == Role::Code) {
    if (effects & kWaits) checkWait(statement);
    if (effects & kJumps) checkLoop(statement);
    if (effects & (kWaits | kJumps)) ++passed_;
    return;
  }
  const Token* name = oneName(statement);
  if (name == nullptr) {
    statement.row = nullptr;
    return;
  }
  bool ok = true;
  if (role == Role::MechBegin) {
    structure_.beginMechanism(statement, *name);
    declareUnit(*name, SymbolKind::Mechanism, static_cast<uint32_t>(program_.mechanisms.size()) - 1);
  } else if (role == Role::MechEnd) {
    ok = structure_.endMechanism(statement, *name);
  } else if (role == Role::ProcBegin) {
    structure_.beginProcedure(statement, *name);
    declareUnit(*name, SymbolKind::Procedure, static_cast<uint32_t>(program_.procedures.size()) - 1);
  } else if (role == Role::ProcEnd) {
    ok = structure_.endProcedure(statement, *name);
  } else {
    structure_.beginTimed(statement, *name);
  }
  if (!ok) statement.row = nullptr;
  // A statement that opens a unit belongs to that unit.
  if (role == Role::MechBegin || role == Role::ProcBegin || role == Role::Timed) statement.unit = structure_.unit();
}

void FileReader::checkWait(const Statement& statement) {
  if (!program_.mayWait(statement.unit))
    c_.report(diag::ExOutsideMechanism, statement.range())
            .note("a mechanism is written between MECH_BEGIN NAME and MECH_END NAME, and runs while the bit NAME is 1")
        << statement.row->info.mnemonic;
  else if (program_.inMechanism(statement.unit) && statement.tokenCount > 0)
    program_.mechanisms[program_.at(program_.owner(statement.unit)).index].hasTimers = true;
}

// Warns of a backward jump past nothing that waits or may leave the loop: it would never end (man. l.2207).
void FileReader::checkLoop(const Statement& statement) {
  if (statement.row->info.mnemonic != "JUM" || !program_.inMechanism(statement.unit) || statement.tokenCount != 1)
    return;
  const uint32_t symbol = c_.symbols.find(program_.tokens[statement.firstToken].text, file_);
  if (symbol == kNone || c_.symbols[symbol].kind != SymbolKind::Label) return;
  const Label& label = program_.labels[c_.symbols[symbol].index];
  if (label.unit == statement.unit && label.passed == passed_)
    c_.report(diag::MechLoopWithoutEx, statement.range()).note(c_.symbols[symbol].declared, "the loop begins here");
}

void readProgram(ReadContext context, std::span<const FileId> files) {
  SourceProgram& program = context.program;
  if (files.size() > kMaxFiles) {
    context.report(diag::TooManyFiles, program.sources.range(files[kMaxFiles], 0, 0)) << kMaxFiles;
    return;
  }
  for (uint32_t i = 0; i < files.size(); ++i) {
    program.files.push_back({.id = files[i], .main = i == 0});
    context.symbols.addFile();
  }
  for (uint32_t i = 0; i < files.size(); ++i)
    if (const auto file = readable(context.sources, files[i], context.diagnostics)) {
      program.files[i].id = *file;
      FileReader(context, i).read();
    }
  placeData(context);
}

} // namespace rung::frontend::technol
