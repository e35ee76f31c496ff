// Small functions of the model.
#include "frontend/dialects/gsk/convert/source_model.h"

#include "frontend/dialects/gsk/title.h"

namespace rung::gsk::convert {

Logic logicOf(Command command) {
  switch (command) {
  case Command::Ld:
  case Command::Ldi: return Logic::Load;
  case Command::And:
  case Command::Ani: return Logic::And;
  case Command::Or:
  case Command::Ori: return Logic::Or;
  case Command::Orb: return Logic::OrBlock;
  case Command::Anb: return Logic::AndBlock;
  case Command::Out:
  case Command::Outi:
  case Command::Set:
  case Command::Rst:
  case Command::Func:
  case Command::Prm:
  case Command::Table:
  case Command::Dialect:
  case Command::Symbol:
  case Command::Const: break;
  }
  return Logic::Load;
}

std::vector<Logic> logicOf(const std::vector<SourceCommand>& commands) {
  std::vector<Logic> result;
  for (const SourceCommand& command : commands)
    if (isLogic(command.command)) result.push_back(logicOf(command.command));
  return result;
}

std::string clean(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return std::string(trimmed(result));
}

} // namespace rung::gsk::convert
