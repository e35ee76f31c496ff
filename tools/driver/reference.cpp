// Reference pages (see reference.h).
#include "tools/driver/reference.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <vector>

#include "ir/core/op_info.h"

namespace rung::driver {

using frontend::Access;
using frontend::Dialect;
using frontend::InstructionInfo;
using frontend::OperandInfo;
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
  case Placement::BehindContact: return "behind a condition";
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

void appendInstruction(const Dialect& dialect, const InstructionInfo& row, std::string& out) {
  auto put = std::back_inserter(out);
  fmt::format_to(put, "### {}", row.mnemonic);
  if (row.number >= 0) fmt::format_to(put, " (function {})", row.number);
  fmt::format_to(put, ": {}\n\n{}\n\n", row.title, row.doc);
  if (row.pins.size() > 0) {
    out += "| condition | meaning |\n| --- | --- |\n";
    for (const PinInfo& pin : row.pins.all())
      fmt::format_to(put, "| `{}` | {}{} |\n", pin.name, cell(pin.doc), pin.edge ? " (rising edge)" : "");
    out += '\n';
  }
  if (row.operands.size() > 0) {
    out += "| operand | kind | access | range | meaning |\n| --- | --- | --- | --- | --- |\n";
    for (const OperandInfo& o : row.operands.all())
      fmt::format_to(put, "| {}{}{} | {} | {} | {} | {} |\n", o.name, o.optional ? " (optional)" : "",
                     o.repeated ? " …" : "", o.kind, accessText(o.access),
                     o.min <= o.max ? fmt::format("{}…{}", o.min, o.max) : "", cell(o.doc));
    out += '\n';
  }
  fmt::format_to(put, "Output: {}. Stands {}{}{}.{}\n\n", outputText(row.output), placementText(row.placement),
                 row.tasks.empty() ? "" : ", in ", row.tasks, row.terminating ? " Closes the logic equation." : "");
  if (!row.example.empty()) fmt::format_to(put, "```\n{}\n```\n\n", row.example);
  fmt::format_to(put, "Manual: {}.{}\n\n", row.ref, dialect.isBuilt(row) ? "" : " Not built yet.");
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

} // namespace

std::string dialectReference(const Dialect& dialect) {
  std::string out;
  auto put = std::back_inserter(out);
  fmt::format_to(put, "# {}: reference\n\n{}. Made by `rungc doc {}` from the tables of the dialect; do not edit.\n\n",
                 dialect.name, dialect.title, dialect.name);
  std::vector<std::string_view> groups;
  for (const InstructionInfo* row : dialect.instructions)
    if (std::find(groups.begin(), groups.end(), row->group) == groups.end()) groups.push_back(row->group);
  for (std::string_view group : groups) {
    fmt::format_to(put, "## {}\n\n", group);
    for (const InstructionInfo* row : dialect.instructions)
      if (row->group == group) appendInstruction(dialect, *row, out);
  }
  out += "## Kinds of operands\n\n| kind | what may be written |\n| --- | --- |\n";
  for (const auto& kind : dialect.operandKinds) fmt::format_to(put, "| {} | {} |\n", kind.kind, cell(kind.doc));
  out += "\n## Configuration keys of the compiler\n\n";
  for (std::string_view key : dialect.configKeys) fmt::format_to(put, "- `{}`\n", key);
  if (dialect.reference != nullptr) out += dialect.reference();
  return out;
}

std::string diagnosticReference() {
  std::vector<const DiagInfo*> rows;
  for (const DiagInfo& info : allDiags()) rows.push_back(&info);
  std::sort(rows.begin(), rows.end(), [](const DiagInfo* a, const DiagInfo* b) { return a->code < b->code; });
  std::string out =
      "# Diagnostics\n\nEvery code that the compiler reports. Made by `rungc doc diagnostics`; do not edit.\n\n";
  for (const DiagInfo* info : rows)
    fmt::format_to(std::back_inserter(out), "## {}\n\n{}: {}\n\n{}\n\n", info->code,
                   info->severity == Severity::Error ? "Error" : "Warning", info->message, info->explanation);
  return out;
}

std::string operationReference() {
  std::string out = "# Operations of the IR\n\nMade by `rungc doc ir` from ir/core/op_info.cpp; do not edit.\n\n| "
                    "operation | types | meaning |\n| --- | --- | --- |\n";
  for (const ir::OpInfo& info : ir::allOps()) {
    std::string types;
    for (int t = 1; t < ir::kTypeCount; ++t)
      if (ir::contains(info.types, static_cast<ir::Type>(t)))
        types += (types.empty() ? "" : " ") + std::string(ir::typeName(static_cast<ir::Type>(t)));
    fmt::format_to(std::back_inserter(out), "| `{}` | {} | {} |\n", info.name, types.empty() ? "-" : types,
                   cell(info.doc));
  }
  return out;
}

std::optional<std::string> explain(std::string_view word) {
  std::string out;
  if (const DiagInfo* info = findDiag(lower(word)))
    fmt::format_to(std::back_inserter(out), "{} ({})\n  {}\n\n{}\n", info->code,
                   info->severity == Severity::Error ? "error" : "warning", info->message, info->explanation);
  for (const Dialect* dialect : frontend::allDialects())
    for (const InstructionInfo* row : dialect->instructions)
      if (lower(row->mnemonic) == lower(word)) {
        fmt::format_to(std::back_inserter(out), "{}[{}] ", out.empty() ? "" : "\n", dialect->name);
        appendInstruction(*dialect, *row, out);
      }
  for (const Dialect* dialect : frontend::allDialects())
    if (const std::string text = dialect->explain == nullptr ? "" : dialect->explain(word); !text.empty())
      out += (out.empty() ? "" : "\n") + text;
  if (out.empty()) return std::nullopt;
  return out;
}

} // namespace rung::driver
