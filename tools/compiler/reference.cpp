// Reference pages (see reference.h).
#include "tools/compiler/reference.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <vector>

#include "ir/core/op_info.h"
#include "ir/support/put.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/signals.h"
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

namespace {

std::string_view accessText(Access access) {
  switch (access) {
  case Access::Read: return "read";
  case Access::Write: return "written";
  case Access::ReadWrite: return "read and written";
  case Access::None: return "-";
  }
  return "";
}

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
  case Placement::BehindContact: return "after a condition";
  case Placement::AtRail: return "at the left rail";
  case Placement::Anywhere: return "anywhere";
  }
  return "";
}

std::string cell(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

// The kinds of the rows' operands, each once, in the order of their definitions.
std::vector<const OperandKindInfo*> operandKindsOf(const Dialect& dialect) {
  std::vector<const OperandKindInfo*> kinds;
  for (const InstructionInfo* row : dialect.instructions)
    for (const OperandInfo& operand : row->operands.all())
      if (std::ranges::find(kinds, operand.kind) == kinds.end()) kinds.push_back(operand.kind);
  std::ranges::sort(kinds, {}, &OperandKindInfo::line);
  return kinds;
}

// How it joins with others.
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

void appendInstruction(const Dialect& dialect, const InstructionInfo& row, std::string& out) {
  put(out, "### {}", row.mnemonic);
  if (row.number >= 0) put(out, " (function {})", row.number);
  put(out, ": {}\n\n{}\n\n", row.title, row.doc);
  if (row.pins.size() > 0) {
    out += "| condition | meaning |\n| --- | --- |\n";
    for (const PinInfo& pin : row.pins.all())
      put(out, "| `{}` | {}{} |\n", pin.name, cell(pin.doc), pin.edge ? " (rising edge)" : "");
    out += '\n';
  }
  if (row.operands.size() > 0) {
    out += "| operand | kind | access | range | meaning |\n| --- | --- | --- | --- | --- |\n";
    for (const OperandInfo& o : row.operands.all())
      put(out, "| {}{}{} | {} | {} | {} | {} |\n", o.name, o.optional ? " (optional)" : "", o.repeated ? " …" : "",
          o.kind->name, accessText(o.access), o.min <= o.max ? fmt::format("{}…{}", o.min, o.max) : "", cell(o.doc));
    out += '\n';
  }
  if (const std::string shape = shapeText(row); !shape.empty()) put(out, "{}\n\n", shape);
  if (!row.example.empty()) put(out, "```\n{}\n```\n\n", row.example);
  put(out, "Manual: {}.{}\n\n", row.ref, dialect.isBuilt(row) ? "" : " Not built yet.");
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

void appendConfigKey(const nc::ConfigKey& row, std::string& out) {
  put(out, "| `{}` | {} | {} | {} | {} |\n", nc::shownKey(row), cell(nc::takesOf(row)), cell(row.otherwise),
      row.reader == nc::ConfigReader::Compiler ? "compiler" : "control", cell(row.doc));
}

constexpr std::string_view kConfigHead =
    "| key | takes | without it | read by | meaning |\n| --- | --- | --- | --- | --- |\n";

void appendFaults(const Dialect& dialect, std::string& out) {
  out += "\n## Faults\n\nWhat stops a program of this dialect, as `rungc run` and `expect_fault` show it.\n\n"
         "| fault | meaning |\n| --- | --- |\n";
  for (const nc::Fault& fault : nc::faultsOf(dialect.name))
    put(out, "| `{}` | {} |\n", fault.text, cell(fault.explanation));
}

// As GitHub makes it of a heading.
std::string anchorOf(std::string_view heading) {
  std::string anchor;
  for (const char c : text::lower(heading)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || (c & 0x80) != 0) anchor += c;
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

struct Section {
  std::string_view title;
  std::vector<std::string_view> entries; // titles of its `### NAME: …`
};

std::vector<Section> sectionsOf(std::string_view page) {
  std::vector<Section> sections;
  while (!page.empty()) {
    const size_t end = std::min(page.find('\n'), page.size());
    const std::string_view line = page.substr(0, end);
    page.remove_prefix(std::min(end + 1, page.size()));
    if (line.starts_with("## ")) sections.push_back({line.substr(3), {}});
    if (line.starts_with("### ") && !sections.empty() && line.find(": ") != std::string_view::npos)
      sections.back().entries.push_back(line.substr(4));
  }
  return sections;
}

std::string linkTo(std::string_view heading, std::string_view shown) {
  return fmt::format("[{}](#{})", shown, anchorOf(heading));
}

// Puts a table of contents before the first section.
std::string withContents(const std::string& page) {
  std::string contents = "## Contents\n\n";
  for (const Section& section : sectionsOf(page)) {
    contents += "- " + linkTo(section.title, section.title);
    std::string_view between = ": ";
    for (const std::string_view entry : section.entries) {
      contents += std::string(between) + linkTo(entry, entry.substr(0, entry.find_first_of(" :")));
      between = ", ";
    }
    contents += '\n';
  }
  const size_t first = page.find("\n## ") + 1;
  return page.substr(0, first) + contents + '\n' + page.substr(first);
}

} // namespace

std::string dialectReference(const Dialect& dialect) {
  std::string out;
  put(out, "# {}: reference\n\n{}. Made by `rungc doc {}` from the tables of the dialect; do not edit.\n\n",
      dialect.name, dialect.title, dialect.name);
  for (std::string_view group : groupsOf(dialect)) {
    put(out, "## {}\n\n", group);
    for (const InstructionInfo* row : dialect.instructions)
      if (row->group == group) appendInstruction(dialect, *row, out);
  }
  out += "## Kinds of operands\n\n| kind | what may be written |\n| --- | --- |\n";
  for (const OperandKindInfo* kind : operandKindsOf(dialect)) put(out, "| {} | {} |\n", kind->name, cell(kind->doc));
  out += "\n## Configuration\n\n`config KEY VALUE` in a scenario, `KEY = VALUE` in the table [config] of rung.toml, "
         "`--config KEY=VALUE` on the command line.\n\n";
  out += kConfigHead;
  for (const nc::ConfigKey& row : dialect.configKeys) appendConfigKey(row, out);
  appendFaults(dialect, out);
  if (dialect.reference != nullptr) out += dialect.reference();
  return withContents(out);
}

std::string diagnosticReference() {
  std::string out =
      "# Diagnostics\n\nEvery code that the compiler reports. Made by `rungc doc diagnostics`; do not edit.\n\n";
  for (const DiagInfo* info : sortedDiags())
    put(out, "## {}\n\n{}: {}\n\n{}\n\n", info->code, info->severity == Severity::Error ? "Error" : "Warning",
        info->message, info->explanation);
  return withContents(out);
}

std::string operationReference() {
  std::string out = "# Operations of the IR\n\nMade by `rungc doc ir` from ir/core/op_info.cpp; do not edit.\n\n| "
                    "operation | types | meaning |\n| --- | --- | --- |\n";
  for (const ir::OpInfo& info : ir::allOps()) {
    std::string types;
    for (int t = 1; t < ir::kTypeCount; ++t)
      if (ir::contains(info.types, static_cast<ir::Type>(t)))
        types += (types.empty() ? "" : " ") + std::string(ir::typeName(static_cast<ir::Type>(t)));
    put(out, "| `{}` | {} | {} |\n", info.name, types.empty() ? "-" : types, cell(info.doc));
  }
  return out;
}

namespace {

// A message as it is for no place: its arguments {0}, {1} … are left open.
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
  return fmt::format("{} ({})\n  {}\n\n{}\n", info.code, info.severity == Severity::Error ? "error" : "warning",
                     openMessage(info.message), info.explanation);
}

// A fault by its text, or by the part before its colon or its module: `halt-status 13`, `watchdog`.
bool isFault(const nc::Fault& fault, const std::string& word) {
  std::string text = text::lower(fault.text);
  text.resize(text.find_last_not_of(' ') + 1); // the module follows
  return text == word || (text.starts_with(word) && (text[word.size()] == ':' || word.starts_with(text)));
}

// What an entry's pieces add up to, one empty line between two.
class Collected {
public:
  void add(std::string_view piece) {
    if (!piece.empty()) text_ += (text_.empty() ? "" : "\n") + std::string(piece);
  }
  std::string take() { return std::move(text_); }

private:
  std::string text_;
};

// By its name, or as a user writes it: tmr.1 is a tmr.N. The rows that take any key explain nothing.
const nc::ConfigKey* configKey(const Dialect& dialect, std::string_view word) {
  for (const nc::ConfigKey& row : dialect.configKeys)
    if (text::equalsIgnoringCase(nc::shownKey(row), word)) return &row;
  const nc::ConfigKey* row = nc::findConfigKey(dialect.configKeys, word);
  return row == nullptr || row->key.starts_with('<') ? nullptr : row;
}

void explainInDialect(const Dialect& dialect, std::string_view word, Collected& out) {
  for (const InstructionInfo* row : dialect.instructions)
    if (text::equalsIgnoringCase(row->mnemonic, word) || isAlias(*row, word, text::equalsIgnoringCase)) {
      std::string text = fmt::format("[{}] ", dialect.name);
      appendInstruction(dialect, *row, text);
      out.add(text);
    }
  if (const nc::ConfigKey* row = configKey(dialect, word))
    out.add(fmt::format("[{}] configuration key {}, read by the {}: {}{}\n  {}\n", dialect.name, nc::shownKey(*row),
                        row->reader == nc::ConfigReader::Compiler ? "compiler" : "control", nc::takesOf(*row),
                        row->otherwise.empty() ? "" : fmt::format("; without it {}", row->otherwise), row->doc));
  for (const nc::Fault& fault : nc::faultsOf(dialect.name))
    if (isFault(fault, text::lower(word)))
      out.add(fmt::format("[{}] fault {}\n\n{}\n", dialect.name, fault.text, fault.explanation));
  if (dialect.explain != nullptr) out.add(dialect.explain(word));
}

std::string instructionTopic(const Dialect& dialect) {
  std::string out = fmt::format("# Instructions of {}\n\n", dialect.name);
  for (std::string_view group : groupsOf(dialect)) {
    put(out, "## {}\n\n| | |\n| --- | --- |\n", group);
    for (const InstructionInfo* row : dialect.instructions)
      if (row->group == group) put(out, "| {} | {} |\n", row->mnemonic, cell(row->title));
    out += '\n';
  }
  return out;
}

std::string diagnosticTopic() {
  std::string out = "# Diagnostics\n\n| | |\n| --- | --- |\n";
  for (const DiagInfo* info : sortedDiags()) put(out, "| {} | {} |\n", info->code, cell(info->message));
  return out;
}

std::string configTopic() {
  std::string out;
  for (const Dialect* dialect : frontend::allDialects()) {
    put(out, "{}# Configuration of {}\n\n{}", out.empty() ? "" : "\n", dialect->name, kConfigHead);
    for (const nc::ConfigKey& row : dialect->configKeys) appendConfigKey(row, out);
  }
  return out;
}

std::string faultTopic() {
  std::string out = "# Faults of a running program\n\n| | |\n| --- | --- |\n";
  for (const Dialect* dialect : frontend::allDialects())
    for (const nc::Fault& fault : nc::faultsOf(dialect->name)) put(out, "| {} | {} |\n", fault.text, dialect->name);
  return out;
}

} // namespace

std::optional<std::string> explain(std::string_view word) {
  Collected out;
  if (const DiagInfo* info = findDiag(text::lower(word))) out.add(shownDiagnostic(*info));
  for (const Dialect* dialect : frontend::allDialects()) explainInDialect(*dialect, word, out);
  std::string text = out.take();
  if (text.empty()) return std::nullopt;
  return text;
}

std::optional<std::string> explainTopic(std::string_view word) {
  if (const Dialect* dialect = frontend::findDialect(word)) return instructionTopic(*dialect);
  if (word == "diagnostics") return diagnosticTopic();
  if (word == "config") return configTopic();
  if (word == "faults") return faultTopic();
  return std::nullopt;
}

std::string explainTopics() {
  std::string out =
      "`rungc explain WORD` explains an instruction, a signal, a diagnostic, a fault or a configuration key; "
      "a part of a word lists what contains it.\n\n| topic | |\n| --- | --- |\n";
  for (const Dialect* dialect : frontend::allDialects()) {
    std::string groups;
    for (std::string_view group : groupsOf(*dialect)) groups += (groups.empty() ? "" : ", ") + std::string(group);
    put(out, "| {} | {} instructions: {} |\n", dialect->name, dialect->instructions.size(), groups);
  }
  put(out, "| diagnostics | {} codes of errors and warnings |\n", allDiags().size());
  out += "| faults | what stops a running program |\n| config | the configuration keys of the dialects |\n";
  return out;
}

std::vector<ReferenceEntry> referenceEntries() {
  std::vector<ReferenceEntry> entries;
  for (const Dialect* dialect : frontend::allDialects()) {
    for (const InstructionInfo* row : dialect->instructions)
      entries.push_back({std::string(row->mnemonic), fmt::format("{} instruction", dialect->name),
                         std::string(row->title), std::string(row->group)});
    for (const nc::ConfigKey& row : dialect->configKeys)
      entries.push_back({nc::shownKey(row), fmt::format("{} configuration", dialect->name), std::string(row.doc), ""});
    for (const nc::Fault& fault : nc::faultsOf(dialect->name))
      entries.push_back(
          {std::string(fault.text), fmt::format("{} fault", dialect->name), std::string(fault.explanation), ""});
    if (const nc::SignalTable* signals = nc::signalsOf(dialect->name))
      for (const nc::Signal& signal : *signals)
        entries.push_back({signal.symbol, fmt::format("{} signal", dialect->name), signal.meaning, signal.group});
  }
  for (const DiagInfo* info : sortedDiags())
    entries.push_back({std::string(info->code), info->severity == Severity::Error ? "error" : "warning",
                       std::string(info->message), ""});
  return entries;
}

} // namespace rung::compiler
