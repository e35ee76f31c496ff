// What the operator sees of the program's messages: transient ones one after the other, each until it is confirmed, and
// beside them the persistent ones that the program shows and removes (man. l.5013-5046). Kind, validity and text come
// from the control's files; a message that is not in them is persistent where the program says when it ends.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "rtlib/nc/control/control.h"
#include "rtlib/nc/technol/services.h"

namespace rung::nc::technol {

enum class MessageKind : uint8_t { ErrCritical, Err, Wrn1, Wrn2, Wrn3, Info, Event };
enum class Validity : uint8_t { Transient, Persistent };

struct MessageDefinition {
  uint32_t number = 0; // 0 to 65535
  MessageKind kind = MessageKind::Err;
  Validity validity = Validity::Transient;
  std::string text; // in one line; %d, %x or %X are places for the values of the message, three at most
};

class Messages {
public:
  Messages();

  // Before the first power-on; a later definition of the same number replaces the earlier one.
  void define(MessageDefinition definition);
  // At power-on: nothing is shown.
  void clear();

  // What the program sent. Allocates nothing.
  void accept(const rung_message& message);
  // Whether it begins to be shown, or is only registered; else it ends.
  bool begins(const rung_message& message) const;
  // As a host reads it: without marks, its op is what becomes of it. Allocates nothing.
  rung_message outward(const rung_message& message) const noexcept;
  // Number, subid and values, then the text with its values where there is one. Gives the characters written; what does
  // not fit is cut off. Allocates nothing.
  size_t describe(const rung_message& message, std::span<char> out) const noexcept;

  // The operator's: the transient message on the screen goes, the next one comes.
  void confirm();
  std::vector<ShownMessage> shown() const;
  bool shows(std::span<const ShownMessage> these) const noexcept;

private:
  void show(const MessageValues& values, Validity validity);
  Validity validityOf(const rung_message& message) const;
  bool isOnlyLogged(uint32_t number) const;
  const MessageDefinition* definitionOf(uint32_t number) const;
  ShownMessage shownOf(const MessageValues& values) const;

  std::unordered_map<uint32_t, MessageDefinition> definitions_;
  std::vector<MessageValues> transient_;  // the first one is on the screen
  std::vector<MessageValues> persistent_; // in the order in which they came
};

} // namespace rung::nc::technol
