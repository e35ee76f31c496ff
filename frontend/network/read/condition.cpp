// Comments to commands, and whether they are a condition.
#include "frontend/network/read/condition.h"

#include <algorithm>

#include "frontend/network/read/canonical.h"
#include "frontend/network/read/list_reader.h"
#include "frontend/network/read/network_builder.h"
#include "rtlib/text/blanks.h"

namespace rung::network {
namespace {

// The command of a comment line; nullopt for any other line.
std::optional<Written> commandOf(const Context& context, FileId file, uint32_t line) {
  const SourceManager& sources = context.sources;
  const std::string_view text = text::trimmed(sources.lineText(file, line));
  if (!text.starts_with(';')) return std::nullopt;
  const std::string_view comment = text::trimmed(text.substr(1));
  if (!comment.starts_with(kConditionComment)) return std::nullopt;
  const auto words = wordsIn(comment.substr(kConditionComment.size()));
  const auto command = words.empty() ? std::nullopt : findCommand(context.language, words[0]);
  if (!command || !isLogic(*command) || words.size() != (isBlock(*command) ? 1 : 2)) return std::nullopt;
  const auto begin = static_cast<size_t>(text.data() - sources.text(file).data());
  return Written{.command = *command,
                 .operand = words.size() == 2 ? words[1] : std::string_view(),
                 .range = sources.range(file, begin, begin + text.size()),
                 .line = line};
}

// Whether they leave one value on the stack, and every contact has a bit.
bool isCondition(const Context& context, const std::vector<Written>& commands) {
  if (!context.language.rowOf(Control::Sp).ignoresCondition) return false;
  std::vector<Logic> logic;
  uint32_t depth = 0;
  for (const Written& written : commands) {
    logic.push_back(logicOf(written.command));
    if (logic.back() == Logic::Load && ++depth > context.language.stackDepth) return false;
    if (isBlock(written.command) && depth > 0) --depth;
  }
  const auto trees = treesOf(logic);
  if (!trees || trees->size() != 1) return false;
  Diagnostics unheard;
  Context own{.language = context.language, .sources = context.sources, .diagnostics = unheard, .names = context.names};
  return std::all_of(commands.begin(), commands.end(), [&](const Written& written) {
    return isBlock(written.command) || bitOperand(own, Word{written.operand, written.range, false});
  });
}

} // namespace

Condition conditionAfter(const Context& context, FileId file, uint32_t moduleLine) {
  Condition result{.commands = {}, .lastLine = moduleLine};
  for (uint32_t line = moduleLine + 1; line <= context.sources.lineCount(file); ++line) {
    const auto command = commandOf(context, file, line);
    if (!command) break;
    result.commands.push_back(*command);
    result.lastLine = line;
  }
  if (!result.commands.empty() && !isCondition(context, result.commands)) return {{}, moduleLine};
  return result;
}

} // namespace rung::network
