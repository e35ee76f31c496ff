// What the operator sees of the program's messages: transient ones one after the other, each until it is confirmed, and
// beside them the persistent ones that the program shows and removes (man. l.5013-5046). Kind, validity and text come
// from the control's file; a message that is not in it is persistent where the program says when it ends.
#pragma once
#include <deque>
#include <span>
#include <unordered_map>
#include <vector>

#include "tools/sim/message_board.h"
#include "tools/sim/technol/control_files.h"

namespace rung::nc::technol {

class Messages {
public:
  void define(std::span<const MessageDefinition> definitions);
  // At power-on: nothing is shown.
  void clear();

  // Empties the program's queue; every message that comes up is logged.
  void take(host::Instance& instance, MessageBoard& board);
  // The operator's: the transient message on the screen goes, the next one comes.
  void confirm();
  std::vector<ShownMessage> shown() const;

private:
  void show(ShownMessage message, Validity validity);
  void remove(uint32_t number, int32_t subId);
  const MessageDefinition* definitionOf(uint32_t number) const;

  std::unordered_map<uint32_t, MessageDefinition> definitions_;
  std::deque<ShownMessage> transient_;   // the first one is on the screen
  std::vector<ShownMessage> persistent_; // in the order in which they came
};

} // namespace rung::nc::technol
