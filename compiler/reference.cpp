// Reference pages.
#include "compiler/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "frontend/table/reference.h"
#include "ir/core/op_info.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/pipeline.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/signals.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::compiler {

using frontend::Access;
using frontend::Dialect;
using frontend::InstructionInfo;
using frontend::OperandInfo;
using frontend::OperandKindInfo;
using frontend::Output;
using frontend::PinInfo;
using frontend::Placement;
using frontend::ReferencePage;

namespace {

std::string_view outputText(Output output) {
  switch (output) {
  case Output::None: return "none";
  case Output::Always: return "always";
  case Output::Optional: return "may be used";
  }
  return "";
}

std::string_view placementText(Placement placement) {
  switch (placement) {
  case Placement::AfterContact: return "after a condition";
  case Placement::AtRail: return "at the left rail";
  case Placement::Anywhere: return "anywhere";
  }
  return "";
}

// The kinds of operands of the rows, each once, in the order of their definitions.
std::vector<const OperandKindInfo*> operandKindsOf(const Dialect& dialect) {
  std::vector<const OperandKindInfo*> kinds;
  for (const InstructionInfo* row : dialect.instructions)
    for (const OperandInfo& operand : row->operands.all())
      if (std::ranges::find(kinds, operand.kind) == kinds.end()) kinds.push_back(operand.kind);
  std::ranges::sort(kinds, {}, [](const OperandKindInfo* kind) {
    return std::pair(std::string_view(kind->defined.file_name()), kind->defined.line());
  });
  return kinds;
}

// How the element connects with others.
std::string shapeText(const InstructionInfo& row) {
  std::string text;
  const auto add = [&](std::string_view sentence) { text += (text.empty() ? "" : " ") + std::string(sentence); };
  if (row.pins.size() > 0)
    add(fmt::format("Output: {}. Place: {}.", outputText(row.output), placementText(row.placement)));
  if (!row.tasks.empty()) add(fmt::format("Only in {}.", row.tasks));
  if (row.terminating) add("Closes the logic equation.");
  if (row.aliases.size() > 0) add(fmt::format("Also written {}.", fmt::join(row.aliases.all(), ", ")));
  return text;
}

// The further pins of a drawn example, a line for each, at the column of the box.
std::string pinLines(const InstructionInfo& row) {
  const size_t box = row.example.find('{');
  if (!row.example.starts_with("|--") || box == std::string_view::npos) return {};
  std::string lines;
  for (size_t i = 1; i < row.pins.size(); ++i) {
    const std::string contact = fmt::format("|--[{}]", static_cast<char>('A' + i - 1));
    lines += fmt::format("\n{:-<{}}{{{}}}", contact, box, row.pins[i].name);
  }
  return lines;
}

void add(ReferencePage& page, const Dialect& dialect, const InstructionInfo& row) {
  const std::string number = row.number < 0 ? "" : fmt::format(" (function {})", row.number);
  page.part(fmt::format("{}{}: {}", row.mnemonic, number, row.title), row.doc);
  if (row.pins.size() > 0) page.section("", "", "condition | meaning");
  for (const PinInfo& pin : row.pins.all())
    page.row(fmt::format("`{}`", pin.name), fmt::format("{}{}", pin.doc, pin.edge ? " (rising edge)" : ""));
  if (row.operands.size() > 0) page.section("", "", "operand | kind | access | range | meaning");
  for (const OperandInfo& o : row.operands.all())
    page.row(fmt::format("{}{}{}", o.name, o.optional ? " (optional)" : "", o.repeated ? " …" : ""), o.kind->name,
             o.access == Access::None ? "-" : nameOf(o.access),
             o.min <= o.max ? fmt::format("{}…{}", o.min, o.max) : "", o.doc);
  if (const std::string shape = shapeText(row); !shape.empty()) page.section("", shape);
  if (!row.example.empty()) page.section("", fmt::format("```\n{}{}\n```", row.example, pinLines(row)));
  page.section("", fmt::format("Manual: {}.{}", row.ref, dialect.isBuilt(row) ? "" : " Not built yet."));
}

std::vector<const DiagInfo*> sortedDiags() {
  std::vector<const DiagInfo*> rows;
  for (const DiagInfo& info : allDiags()) rows.push_back(&info);
  std::sort(rows.begin(), rows.end(), [](const DiagInfo* a, const DiagInfo* b) { return a->code < b->code; });
  return rows;
}

std::vector<std::string_view> groupsOf(const Dialect& dialect) {
  std::vector<std::string_view> groups;
  for (const InstructionInfo* row : dialect.instructions)
    if (std::find(groups.begin(), groups.end(), row->group) == groups.end()) groups.push_back(row->group);
  return groups;
}

std::string_view readerOf(const nc::ConfigKey& row) {
  return row.reader == nc::ConfigReader::Compiler ? "compiler" : "control";
}

std::string_view severityOf(const DiagInfo& info) { return info.severity == Severity::Error ? "error" : "warning"; }

constexpr std::string_view kConfigColumns = "key | takes | without it | read by | meaning";

void addConfigKeys(ReferencePage& page, const Dialect& dialect) {
  for (const nc::ConfigKey& row : dialect.configKeys)
    page.row(fmt::format("`{}`", nc::shownKey(row)), nc::takesOf(row), row.otherwise, readerOf(row), row.doc);
}

// The anchor that GitHub makes for a heading.
std::string anchorOf(std::string_view heading) {
  std::string anchor;
  for (const char c : text::lower(heading)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || (c & 0x80) != 0) anchor += c;
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

std::string linkTo(std::string_view heading, std::string_view shown) {
  return fmt::format("[{}](#{})", shown, anchorOf(heading));
}

// Inserts a table of contents before the first section: the sections, and their subsections with headings `NAME: …`.
std::string withContents(ReferencePage& page) {
  std::string contents = "## Contents\n";
  std::string_view between;
  for (const auto& [level, title] : page.headings()) {
    if (level == 2) {
      contents += "\n- " + linkTo(title, title);
      between = ": ";
    } else if (level == 3 && title.find(": ") != std::string::npos) {
      contents += std::string(between) + linkTo(title, std::string_view(title).substr(0, title.find_first_of(" :")));
      between = ", ";
    }
  }
  std::string text = page.take();
  return text.insert(text.find("\n## ") + 1, contents + "\n\n");
}

} // namespace

std::string dialectReference(const Dialect& dialect) {
  ReferencePage page;
  page.section(fmt::format("{}: reference", dialect.name),
               fmt::format("{}. This page is for everyone who writes or reads programs of this control. It lists the "
                           "instructions with their operands, the configuration, the faults, the memory and the "
                           "signals, and says where the control's manual describes them. Made by `rungc doc {}` from "
                           "the tables of the dialect; do not edit.",
                           dialect.title, dialect.name),
               "", 1);
  for (std::string_view group : groupsOf(dialect)) {
    page.section(group, "");
    for (const InstructionInfo* row : dialect.instructions)
      if (row->group == group) add(page, dialect, *row);
  }
  page.section("Kinds of operands", "", "kind | what may be written");
  for (const OperandKindInfo* kind : operandKindsOf(dialect)) page.row(kind->name, kind->doc);
  page.section("Configuration",
               "`config KEY VALUE` in a scenario, `KEY = VALUE` in the table [config] of rung.toml, `--config "
               "KEY=VALUE` on the command line.",
               kConfigColumns);
  addConfigKeys(page, dialect);
  page.section("Faults", "What stops a program of this dialect, as `rungc run` and `expect_fault` show it.",
               "fault | meaning");
  for (const nc::Fault& fault : nc::faultsOf(dialect.name))
    page.row(fmt::format("`{}`", fault.text), fault.explanation);
  dialect.reference(page);
  return withContents(page);
}

std::string diagnosticReference() {
  ReferencePage page;
  page.section("Diagnostics",
               "This page explains every error and warning of the compiler, by the code that a message shows in "
               "brackets; `rungc explain CODE` prints the same for one. Made by `rungc doc diagnostics`; do not edit.",
               "", 1);
  for (const DiagInfo* info : sortedDiags())
    page.section(info->code, fmt::format("{}: {}\n\n{}", info->severity == Severity::Error ? "Error" : "Warning",
                                         info->message, info->explanation));
  return withContents(page) + '\n';
}

std::string operationReference() {
  ReferencePage page;
  page.section(
      "Operations of the IR",
      "This page is for developers of Rung. It lists the operations of the intermediate representation into which "
      "every program is lowered ([ir.md](../ir.md) introduces it), and the passes that optimise it. Made by "
      "`rungc doc ir` from ir/core/ops.def; do not edit.",
      "operation | types | meaning", 1);
  for (const ir::OpInfo& info : ir::allOps()) {
    std::string types;
    for (int t = 1; t < ir::kTypeCount; ++t)
      if (ir::contains(info.types, static_cast<ir::Type>(t)))
        types += (types.empty() ? "" : " ") + std::string(ir::typeName(static_cast<ir::Type>(t)));
    page.row(fmt::format("`{}`", info.name), types.empty() ? "-" : types, info.doc);
  }
  page.section("Passes",
               fmt::format("`rungc opt` runs passes by name. `rungc build` runs, in this order: {}.",
                           fmt::join(ir::optimisingPasses(), ", ")),
               "pass | what it does");
  for (const ir::Pass& pass : ir::allPasses()) page.row(fmt::format("`{}`", pass.name), pass.doc);
  return page.take();
}

namespace {

// A message without a position: its arguments {0}, {1} … become ellipses.
std::string openMessage(std::string_view message) {
  std::string text;
  for (size_t i = 0; i < message.size(); ++i) {
    const bool argument = message[i] == '{' && i + 2 < message.size() && message[i + 2] == '}';
    text += argument ? "…" : std::string(1, message[i]);
    i += argument ? 2 : 0;
  }
  return text;
}

std::string shownDiagnostic(const DiagInfo& info) {
  return fmt::format("{} ({})\n  {}\n\n{}\n", info.code, severityOf(info), openMessage(info.message), info.explanation);
}

// Whether a fault has this text, or this part before its colon or its module: `halt-status 13`, `watchdog`.
bool isFault(const nc::Fault& fault, const std::string& word) {
  std::string text = text::lower(fault.text);
  text.resize(text.find_last_not_of(' ') + 1); // followed by the module
  return text == word || (text.starts_with(word) && (text[word.size()] == ':' || word.starts_with(text)));
}

// Joins the paragraphs of an entry, with one empty line between two.
class Collected {
public:
  void add(std::string_view unit) {
    if (!unit.empty()) text_ += (text_.empty() ? "" : "\n") + std::string(unit);
  }
  std::string take() { return std::move(text_); }

private:
  std::string text_;
};

// By its name, or as a user writes it: tmr.1 is a tmr.N. Rows that accept any key are not considered.
const nc::ConfigKey* configKey(const Dialect& dialect, std::string_view word) {
  for (const nc::ConfigKey& row : dialect.configKeys)
    if (text::equalsIgnoringCase(nc::shownKey(row), word)) return &row;
  const nc::ConfigKey* row = nc::findConfigKey(dialect.configKeys, word);
  return row == nullptr || row->key.starts_with('<') ? nullptr : row;
}

// Whether the word calls the row by its number: SUB 24, SUB24.
bool isNumberOf(const Dialect& dialect, const InstructionInfo& row, std::string_view word) {
  const std::string_view call = dialect.functionWord;
  if (call.empty() || row.number < 0 || !text::startsWithIgnoringCase(word, call)) return false;
  return text::trimmed(word.substr(call.size())) == std::to_string(row.number);
}

void explainInDialect(const Dialect& dialect, std::string_view word, Collected& out) {
  for (const InstructionInfo* row : dialect.instructions)
    if (text::equalsIgnoringCase(row->mnemonic, word) || isAlias(*row, word, text::equalsIgnoringCase) ||
        isNumberOf(dialect, *row, word)) {
      ReferencePage page;
      add(page, dialect, *row);
      out.add(fmt::format("[{}] {}\n", dialect.name, page.take()));
    }
  for (const OperandKindInfo* kind : operandKindsOf(dialect))
    if (text::equalsIgnoringCase(kind->name, word))
      out.add(fmt::format("[{}] kind of operands {}\n  {}\n", dialect.name, kind->name, kind->doc));
  if (const nc::ConfigKey* row = configKey(dialect, word))
    out.add(fmt::format("[{}] configuration key {}, read by the {}: {}{}\n  {}\n", dialect.name, nc::shownKey(*row),
                        readerOf(*row), nc::takesOf(*row),
                        row->otherwise.empty() ? "" : fmt::format("; without it {}", row->otherwise), row->doc));
  for (const nc::Fault& fault : nc::faultsOf(dialect.name))
    if (isFault(fault, text::lower(word)))
      out.add(fmt::format("[{}] fault {}\n\n{}\n", dialect.name, fault.text, fault.explanation));
  if (dialect.explain != nullptr) out.add(dialect.explain(word));
}

std::string instructionTopic(const Dialect& dialect) {
  ReferencePage page;
  page.section(fmt::format("Instructions of {}", dialect.name), "", "", 1);
  for (std::string_view group : groupsOf(dialect)) {
    page.section(group, "", "|");
    for (const InstructionInfo* row : dialect.instructions)
      if (row->group == group) page.row(row->mnemonic, row->title);
  }
  return page.take() + '\n';
}

std::string diagnosticTopic() {
  ReferencePage page;
  page.section("Diagnostics", "", "|", 1);
  for (const DiagInfo* info : sortedDiags()) page.row(info->code, info->message);
  return page.take();
}

std::string configTopic() {
  ReferencePage page;
  for (const Dialect* dialect : frontend::allDialects()) {
    page.section(fmt::format("Configuration of {}", dialect->name), "", kConfigColumns, 1);
    addConfigKeys(page, *dialect);
  }
  return page.take();
}

std::string faultTopic() {
  ReferencePage page;
  page.section("Faults of a running program", "", "|", 1);
  for (const Dialect* dialect : frontend::allDialects())
    for (const nc::Fault& fault : nc::faultsOf(dialect->name)) page.row(fault.text, dialect->name);
  return page.take();
}

} // namespace

std::optional<std::string> explain(std::string_view word, const Dialect* only) {
  Collected out;
  if (const DiagInfo* info = findDiag(text::lower(word))) out.add(shownDiagnostic(*info));
  for (const Dialect* dialect : frontend::allDialects())
    if (only == nullptr || dialect == only) explainInDialect(*dialect, word, out);
  const std::string text = out.take();
  if (text.empty()) return std::nullopt;
  return withoutManualLines(text);
}

std::optional<std::string> explainTopic(std::string_view word) {
  if (const Dialect* dialect = frontend::findDialect(word)) return instructionTopic(*dialect);
  if (word == "diagnostics") return diagnosticTopic();
  if (word == "config") return withoutManualLines(configTopic());
  if (word == "faults") return faultTopic();
  return std::nullopt;
}

std::string explainTopics() {
  ReferencePage page;
  page.section("",
               "`rungc explain WORD` explains an instruction, a signal, a diagnostic, a fault or a configuration key; "
               "a part of a word lists what contains it.",
               "topic |");
  for (const Dialect* dialect : frontend::allDialects())
    page.row(dialect->name,
             fmt::format("{} instructions: {}", dialect->instructions.size(), fmt::join(groupsOf(*dialect), ", ")));
  page.row("diagnostics", fmt::format("{} codes of errors and warnings", allDiags().size()));
  page.row("faults", "what stops a running program");
  page.row("config", "the configuration keys of the dialects");
  return page.take();
}

namespace {

// A sentence ends at a full stop before a capital letter, outside of brackets and quotations: neither at that of
// `param.N` nor at that of "e.g. 100".
std::string firstSentence(std::string_view text) {
  int depth = 0;
  for (size_t i = 0; i + 2 < text.size(); ++i) {
    if (text[i] == '\n') return std::string(text.substr(0, i));
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    const char next = text[i + 2];
    const bool starts = std::isupper(static_cast<unsigned char>(next)) != 0 || next == '`' || next == '"';
    if (text[i] == '.' && text[i + 1] == ' ' && depth == 0 && starts) return std::string(text.substr(0, i + 1));
  }
  return std::string(text);
}

void addEntriesOf(const Dialect& dialect, std::vector<ReferenceEntry>& entries) {
  const auto add = [&](std::string_view name, std::string_view kind, std::string_view title, std::string_view group) {
    entries.push_back(
        {std::string(name), fmt::format("{} {}", dialect.name, kind), std::string(title), std::string(group)});
  };
  for (const InstructionInfo* row : dialect.instructions) add(row->mnemonic, "instruction", row->title, row->group);
  for (const OperandKindInfo* kind : operandKindsOf(dialect)) add(kind->name, "kind of operands", kind->doc, "");
  for (const nc::ConfigKey& row : dialect.configKeys) add(nc::shownKey(row), "configuration", row.doc, "");
  for (const nc::Fault& fault : nc::faultsOf(dialect.name))
    add(text::trimmed(fault.text), "fault", fault.explanation, "");
  if (const nc::SignalTable* signals = nc::signalsOf(dialect.name))
    for (const nc::Signal& signal : *signals) add(signal.symbol, "signal", signal.meaning, signal.group);
}

} // namespace

std::vector<ReferenceEntry> referenceEntries() {
  std::vector<ReferenceEntry> entries;
  for (const Dialect* dialect : frontend::allDialects()) addEntriesOf(*dialect, entries);
  for (const DiagInfo* info : sortedDiags())
    entries.push_back({std::string(info->code), std::string(severityOf(*info)), openMessage(info->message), ""});
  for (ReferenceEntry& entry : entries) entry.title = firstSentence(withoutManualLines(entry.title));
  return entries;
}

namespace {

constexpr std::string_view kManual = "Manual: ";

bool namesLine(std::string_view clause) {
  for (size_t at = clause.find("l."); at != std::string_view::npos; at = clause.find("l.", at + 1))
    if (at + 2 < clause.size() && text::isDigit(clause[at + 2]) && (at == 0 || !text::isLetter(clause[at - 1])))
      return true;
  return false;
}

bool isNumbers(std::string_view clause) {
  return !clause.empty() && std::ranges::all_of(clause, [](char c) { return text::isDigit(c) || c == '-'; });
}

bool isProposal(std::string_view clause) { return clause.starts_with('P') && isNumbers(clause.substr(1)); }

// Parts between commas and semicolons, without those that refer to a line; 3022 in "l.363, 3022" does so, too.
std::string otherParts(std::string_view parts) {
  std::string kept;
  bool dropped = false;
  while (!parts.empty()) {
    const size_t end = std::min(parts.find_first_of(",;"), parts.size());
    const std::string_view part = text::trimmed(parts.substr(0, end));
    dropped = namesLine(part) || isProposal(part) || (dropped && isNumbers(part));
    if (!dropped) kept += parts.substr(0, end);
    const size_t next = std::min(end + 1, parts.size());
    if (!dropped) kept += parts.substr(end, next - end);
    parts.remove_prefix(next);
  }
  kept.resize(kept.find_last_not_of(" ,;") + 1);
  return kept;
}

// Reduces "Manual: 5.19, l.1921." at the beginning of the text to "Manual: 5.19."
std::string chapterOnly(std::string_view text) {
  const size_t end = std::min(text.find(". "), text.size() - 1);
  const std::string chapter = otherParts(text.substr(kManual.size(), end - kManual.size()));
  const std::string_view rest = text.substr(std::min(end + 2, text.size()));
  return (chapter.empty() ? std::string() : std::string(kManual) + chapter + (rest.empty() ? "." : ". ")) +
         std::string(rest);
}

// Ends the brackets that begin at `open`.
void closeBracket(size_t open, std::string& out) {
  const std::string inner = out.substr(open + 1);
  const std::string kept = otherParts(inner);
  out.resize(open + 1);
  if (kept.empty() && !text::trimmed(inner).empty()) {
    out.pop_back();
    if (out.ends_with(' ')) out.pop_back();
  } else {
    out += (!kept.empty() && kept.size() < inner.size() ? kept : inner) + ")";
  }
}

std::string withoutBracketed(std::string_view line) {
  std::string out;
  std::vector<size_t> open;
  for (const char c : line) {
    if (c == '(') open.push_back(out.size());
    if (c != ')' || open.empty()) {
      out += c;
      continue;
    }
    closeBracket(open.back(), out);
    open.pop_back();
  }
  return out;
}

std::string withoutLines(std::string_view line) {
  const size_t manual = line.find(kManual);
  if (manual == std::string_view::npos) return withoutBracketed(line);
  std::string kept = withoutBracketed(line.substr(0, manual)) + chapterOnly(line.substr(manual));
  kept.resize(kept.find_last_not_of(' ') + 1);
  return kept;
}

} // namespace

std::string withoutManualLines(std::string_view markdown) {
  std::string out;
  bool fenced = false;
  while (!markdown.empty()) {
    const size_t end = std::min(markdown.find('\n'), markdown.size());
    const std::string_view line = markdown.substr(0, end);
    if (line.starts_with("```")) fenced = !fenced;
    const std::string kept = fenced ? std::string(line) : withoutLines(line);
    if (!kept.empty() || line.empty()) out.append(kept).append(markdown.substr(end, 1));
    markdown.remove_prefix(std::min(end + 1, markdown.size()));
  }
  return out;
}

} // namespace rung::compiler
