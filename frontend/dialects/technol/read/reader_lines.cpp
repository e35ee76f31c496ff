// Reads the lines of a file, its includes, and its macros (see file_reader.h).
#include <algorithm>
#include <array>

#include "frontend/dialects/technol/read/file_reader.h"
#include "frontend/dialects/technol/read/lexer.h"
#include "frontend/sema/operand_count.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

constexpr size_t kMaxStatement = 4096;      // tokens of a statement continued by commas
constexpr uint32_t kMaxIncludes = 32;       // nesting depth
constexpr uint32_t kMaxExpansion = 32;      // nesting depth of macros
constexpr uint32_t kMostIncludes = 5'000;   // per program
constexpr uint32_t kMostExpanded = 200'000; // lines from macros, per program

std::string folderOf(std::string_view path) {
  const size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash + 1));
}

// Row of the pseudo statements around a macro that has its own effect on the stack.
const Row* markRow(Role role, MacroStack stack) {
  constexpr size_t kStacks = 5;
  static constexpr auto kMarks = [] {
    std::array<Row, 2 * kStacks> rows{};
    for (size_t i = 0; i < rows.size(); ++i)
      rows[i] = {.info = {.mnemonic = "macro"},
                 .role = i < kStacks ? Role::MacroBegin : Role::MacroEnd,
                 .variant = static_cast<int>(i % kStacks)};
    return rows;
  }();
  return &kMarks[static_cast<size_t>(stack) + (role == Role::MacroBegin ? 0 : kStacks)];
}

} // namespace

void FileReader::read() {
  readLines(program_.files[file_].id, 0);
  const SourceFile& file = program_.files[file_];
  macros_.abandon();
  if (structures_.isOpen()) structures_.abandon(file.lastLine, "the end of the file");
  if (!pendingLabels_.empty()) {
    Statement end{.line = file.lineCount, .unit = structure_.unit(), .file = file_};
    end.pos = program_.tokens[pendingLabels_[0]].pos;
    attachLabels(end, static_cast<uint32_t>(program_.statements.size()));
    program_.statements.push_back(end);
  }
  structure_.finish(static_cast<uint32_t>(program_.statements.size()));
}

// Reads the lines of the file itself (`depth` 0) or of an included file.
void FileReader::readLines(FileId id, uint32_t depth) {
  LineReader lines(c_.sources, id);
  SourceLine line;
  uint32_t first = 0, lineNumber = 0;
  if (depth == 0) program_.files[file_].lastLine = program_.sources.range(id, 0, 0); // for an empty file
  bool open = false, clean = true; // open: a comma continues the statement; clean: no errors in it
  while (lines.next(line)) {
    includeDepth_ = depth;
    if (depth == 0) {
      program_.files[file_].lineCount = line.number;
      program_.files[file_].lastLine = line.range();
    }
    if (structure_.stopped()) {
      const size_t text = line.text.find_first_not_of(" \t");
      if (text < commentOf(line.text) && text != std::string_view::npos && !textAfterStop_)
        c_.report(diag::TextAfterStop, line.range());
      textAfterStop_ = textAfterStop_ || (text < commentOf(line.text) && text != std::string_view::npos);
      continue;
    }
    if (open && isInclude(line.text)) {
      logicalLine(first, static_cast<uint32_t>(program_.tokens.size()) - first, lineNumber);
      open = false;
    }
    if (!open && includes(line, depth)) continue;
    if (!open) {
      first = static_cast<uint32_t>(program_.tokens.size());
      lineNumber = line.number;
      clean = true;
    }
    const auto before = static_cast<uint32_t>(program_.tokens.size());
    clean = tokenize(line, program_.tokens, c_.diagnostics) && clean;
    if (open && clean && program_.tokens.size() == before) continue; // a blank line or comment inside the statement
    if (open && clean && beginsStatement(before)) {                  // the comma was superfluous
      logicalLine(first, before - first, lineNumber);
      first = before;
      lineNumber = line.number;
    }
    open = clean && program_.tokens.size() > before && program_.tokens.back().is(',');
    if (open && program_.tokens.size() - first < kMaxStatement) continue;
    open = false;
    if (clean && program_.tokens.size() > first)
      logicalLine(first, static_cast<uint32_t>(program_.tokens.size()) - first, lineNumber);
  }
  if (open) logicalLine(first, static_cast<uint32_t>(program_.tokens.size()) - first, lineNumber);
}

// Whether the tokens from `first` cannot be operands of the statement above: a label, a structure, a use of a macro, or
// a reserved word.
bool FileReader::beginsStatement(uint32_t first) const {
  const std::span<const Token> tokens = std::span(program_.tokens).subspan(first);
  if (tokens[0].kind != TokenKind::Name) return false;
  if (tokens.size() > 1 && tokens[1].is(':')) return true;
  const Row* second = tokens.size() > 1 && tokens[1].kind == TokenKind::Name ? findRow(tokens[1].text) : nullptr;
  if (second && second->role == Role::MemberSize && second->info.mnemonic != "DUP")
    return true; // NAME struc, NAME DB 5
  if (structures_.find(tokens[0]) != kNone || (tokens.size() > 1 && structures_.find(tokens[1]) != kNone)) return true;
  if (findRow(tokens[0].text) != nullptr) return reservedWord(tokens[0].text) == Reserved::Yes;
  return macros_.find(tokens[0].text) != nullptr;
}

namespace {

constexpr std::string_view kInclude = "T_INCLUDE";

// Whether `text` begins with this word.
bool startsWith(std::string_view text, std::string_view word) {
  if (text.size() <= word.size() || !text::startsWithIgnoringCase(text, word)) return false;
  return text[word.size()] == ' ' || text[word.size()] == '\t';
}

// The file named by `path`, ignoring the case of its last part, `name`; "" if there is none.
std::string inAnyCase(const SourceManager& sources, const std::string& path, std::string_view name) {
  std::string found = path.substr(0, path.size() - name.size());
  while (!name.empty()) {
    const std::string_view part = name.substr(0, name.find('/'));
    name.remove_prefix(std::min(part.size() + 1, name.size()));
    std::string entryName;
    for (const std::string& candidate : sources.namesIn(found))
      if (text::equalsIgnoringCase(part, candidate) && (entryName.empty() || candidate < entryName))
        entryName = candidate;
    if (entryName.empty()) return "";
    found += entryName + (name.empty() ? "" : "/");
  }
  return found;
}

} // namespace

bool FileReader::isInclude(std::string_view text) {
  const size_t start = text.find_first_not_of(" \t");
  return start != std::string_view::npos && startsWith(text.substr(start), kInclude);
}

// Reads T_INCLUDE path | 'name'. A path is not a sequence of tokens, so the line is parsed as text (man. l.20313).
bool FileReader::includes(const SourceLine& line, uint32_t depth) {
  if (!isInclude(line.text)) return false;
  std::string_view name = text::trimmed(line.text.substr(line.text.find_first_not_of(" \t") + kInclude.size()));
  name = text::trimmed(name.substr(0, commentOf(name)));
  const auto column = static_cast<size_t>(name.data() - line.text.data());
  const SourceRange at = name.empty() ? line.range() : line.range(column, column + name.size());
  if (depth >= kMaxIncludes) {
    c_.report(diag::TooDeep, at) << "files" << kMaxIncludes;
    return true;
  }
  const bool quoted = name.size() > 1 && name.front() == '\'' && name.back() == '\'';
  if (quoted) name = name.substr(1, name.size() - 2);
  if (name.empty()) {
    return !countFits(findRow(kInclude)->info, 0, at, c_.diagnostics);
  }
  const IncludedFile file = findIncluded(name, quoted, line.begin);
  if (std::find(including_.begin(), including_.end(), file.path) != including_.end()) {
    c_.report(diag::IncludeCycle, at) << file.path;
    return true;
  }
  if (!file.id && !file.again) {
    auto report = c_.report(diag::IncludeNotFound, at);
    report << name;
    for (const std::string& problem : file.problems) report.note(problem);
    return true;
  }
  if (++c_.included > kMostIncludes) {
    if (c_.included == kMostIncludes + 1) c_.report(diag::TooLarge, at) << "T_INCLUDE" << kMostIncludes;
    return true;
  }
  readIncluded(file, at, depth);
  return true;
}

// Reads an included file. Errors in it are reported at its first inclusion, names that a further inclusion declares
// again at that inclusion.
void FileReader::readIncluded(const IncludedFile& file, SourceRange at, uint32_t depth) {
  if (!file.again) c_.includes.emplace(file.path, readable(c_.sources, *file.id, c_.diagnostics));
  const auto text = c_.includes.at(file.path);
  if (!text) return;
  including_.push_back(file.path);
  includeReported_ = false;
  const SourceRange outer = c_.symbols.readsAgain(file.again ? at : SourceRange{});
  readLines(*text, depth + 1);
  c_.symbols.readsAgain(outer);
  including_.pop_back();
}

// Finds an included file. A name without a drive or root is searched in the folder of the program, then in that of the
// including file, then in those of the project; a bare name in apostrophes in the SYSTEM folder (man. l.20319-20326).
// The control ignores the case of file names.
FileReader::IncludedFile FileReader::findIncluded(std::string_view name, bool quoted, SourcePos at) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  const bool system = quoted && path.find('/') == std::string::npos && !c_.options.systemFolder.empty();
  std::vector<std::string> paths;
  if (system) {
    paths = {c_.options.systemFolder + "/" + path};
  } else if (path[0] == '/') {
    paths = {path};
  } else {
    paths = {folderOf(program_.sources.name(program_.files[file_].id)) + path};
    const std::string beside = folderOf(program_.sources.name(program_.sources.fileOf(at))) + path;
    if (beside != paths[0]) paths.push_back(beside);
    for (const std::string& folder : c_.options.includePaths) paths.push_back(folder + "/" + path);
  }
  IncludedFile none{.path = paths[0]};
  for (const bool anyCase : {false, true})
    for (const std::string& candidate : paths) {
      const std::string real = anyCase ? inAnyCase(program_.sources, candidate, path) : candidate;
      if (std::find(including_.begin(), including_.end(), real) != including_.end()) return {.path = real};
      if (real.empty()) continue;
      if (c_.includes.contains(real)) return {.path = real, .again = true};
      const Result<FileId> file = c_.sources.addFile(real);
      if (file) return {.path = real, .id = file.value()};
      if (!anyCase) none.problems.push_back(real + ": " + file.error());
    }
  return none;
}

// Whether the statement is allowed in an included file: constants, data and macros; code only inside macros (man.
// l.20320).
bool FileReader::allowedInInclude(const Statement& statement) {
  if (includeDepth_ == 0 || !expanding_.empty()) return true;
  switch (statement.row->role) {
  case Role::Equi:
  case Role::Dfm:
  case Role::Ds:
  case Role::Str:
  case Role::Local:
  case Role::LocalEnd:
  case Role::MemberSize:
  case Role::NoCode: return true;
  default: break;
  }
  if (!includeReported_) c_.report(diag::CodeInInclude, statement.range()) << statement.row->info.mnemonic;
  includeReported_ = true;
  return false;
}

// Handles definitions and uses of macros; false if the line is neither.
bool FileReader::macroLine(uint32_t first, uint32_t count, uint32_t line) {
  const Token head = program_.tokens[first];
  if (head.kind != TokenKind::Name) return false;
  const Row* row = findRow(head.text);
  const std::span<const Token> operands = std::span<const Token>(program_.tokens).subspan(first + 1, count - 1);
  if (row != nullptr && row->role == Role::Macro) {
    const std::string_view name = row->info.mnemonic;
    if (name == "DEF_T_MACRO")
      macros_.begin(operands, head.range());
    else if (name == "APPEND_T_MACRO")
      macros_.append(operands, head.range());
    else if (name == "CONTROL_T_MACRO")
      macros_.control(operands, head.range());
    else if (name == kInclude)
      countFits(row->info, 0, head.range(), c_.diagnostics);
    else
      c_.report(diag::SyntaxError, head.range()) << "DEF_T_MACRO" << name;
    return true;
  }
  const Macro* macro = row == nullptr || macros_.first() ? macros_.find(head.text) : nullptr;
  if (macro == nullptr) return false;
  useMacro(*macro, first, count, line);
  return true;
}

void FileReader::useMacro(const Macro& macro, uint32_t first, uint32_t count, uint32_t line) {
  const Token head = program_.tokens[first];
  const std::string key = symbolKey(macro.name.text);
  if (std::find(expanding_.begin(), expanding_.end(), key) != expanding_.end()) {
    const std::string by = expanding_.back() == key ? "" : ", by way of " + expanding_.back();
    c_.report(diag::MacroRecursion, head.range()) << macro.name.text << by;
    return;
  }
  if (expanding_.size() >= kMaxExpansion) {
    c_.report(diag::TooDeep, head.range()) << "macros" << kMaxExpansion;
    return;
  }
  const std::vector<Token> operands(program_.tokens.begin() + first + 1, program_.tokens.begin() + first + count);
  std::vector<Macro::Line> lines;
  if (!macros_.expand(macro, operands, head.range(), lines)) return;
  const bool wasFull = c_.expanded > kMostExpanded;
  c_.expanded += static_cast<uint32_t>(lines.size());
  if (c_.expanded > kMostExpanded) {
    if (!wasFull) c_.report(diag::TooLarge, head.range()) << "lines of macros" << kMostExpanded;
    c_.expanded = kMostExpanded + 1;
    return;
  }
  if (std::ranges::any_of(lines, [](const Macro::Line& made) { return made.tokens.size() > kMaxStatement; })) {
    c_.report(diag::TooLarge, head.range()) << "words in a line of a macro" << kMaxStatement;
    return;
  }
  const MacroStack stack = macro.stack;
  if (stack != MacroStack::Normal) mark(Role::MacroBegin, stack, head, line);
  expanding_.push_back(key);
  for (const Macro::Line& made : lines) {
    const auto at = static_cast<uint32_t>(program_.tokens.size());
    program_.tokens.insert(program_.tokens.end(), made.tokens.begin(), made.tokens.end());
    // Statements of a macro have the line of its use: mechanisms show it, and a debugger steps through it.
    logicalLine(at, static_cast<uint32_t>(made.tokens.size()), line);
  }
  expanding_.pop_back();
  if (stack != MacroStack::Normal) mark(Role::MacroEnd, stack, head, line);
}

void FileReader::mark(Role role, MacroStack stack, const Token& at, uint32_t line) {
  Statement made{.row = markRow(role, stack),
                 .pos = at.pos,
                 .length = static_cast<uint32_t>(at.text.size()),
                 .line = line,
                 .unit = structure_.unit(),
                 .file = file_};
  attachLabels(made, static_cast<uint32_t>(program_.statements.size()));
  program_.statements.push_back(made);
}

} // namespace rung::frontend::technol
