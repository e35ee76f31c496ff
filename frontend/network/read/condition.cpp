// Reads comments as commands, and checks whether they form a condition.
#include "frontend/network/read/condition.h"

#include <algorithm>

#include "frontend/network/read/canonical.h"
#include "frontend/network/read/list_reader.h"
#include "frontend/network/read/network_builder.h"

namespace rung::frontend::network {
namespace {

// The command in a comment line; nullopt for any other comment.
std::optional<Written> commandOf(const Language& language, const ladder::Comment& comment) {
  if (!comment.text.starts_with(kConditionComment)) return std::nullopt;
  const auto words = wordsIn(comment.text.substr(kConditionComment.size()));
  const auto command = words.empty() ? std::nullopt : findCommand(language, words[0]);
  if (!command || !isLogic(*command) || words.size() != (isBlock(*command) ? 1 : 2)) return std::nullopt;
  return Written{.command = *command,
                 .operand = words.size() == 2 ? words[1] : std::string_view(),
                 .range = comment.range,
                 .line = comment.line};
}

// Whether the commands leave exactly one value on the stack and every contact is a bit.
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
  Diagnostics discarded;
  Context own{
      .language = context.language, .sources = context.sources, .diagnostics = discarded, .names = context.names};
  return std::all_of(commands.begin(), commands.end(), [&](const Written& written) {
    return isBlock(written.command) || bitOperand(own, Word{written.operand, written.range, false});
  });
}

} // namespace

std::vector<Written> conditionIn(const Context& context, std::span<const ladder::Comment> comments) {
  std::vector<Written> result;
  for (const ladder::Comment& comment : comments) {
    const auto command = commandOf(context.language, comment);
    if (!command) break;
    result.push_back(*command);
  }
  if (!isCondition(context, result)) result.clear();
  return result;
}

} // namespace rung::frontend::network
