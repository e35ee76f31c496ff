// The program's messages as the operator sees them: transient messages one after the other, each until it is confirmed,
// and beside them the persistent messages that the program shows and removes (man. l.5013-5046). Kind, validity and
// text come from the control's files; a message that they do not define is persistent if the program removes it.
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
  std::string text; // one line; %d, %x and %X are placeholders for the values of the message, three at most
};

class Messages {
public:
  Messages();

  // Before the first power-on; a later definition of the same number replaces the earlier one.
  void define(MessageDefinition definition);
  // At power-on: nothing is shown.
  void clear();

  template <class Archive>
  void state(Archive& archive) {
    archive(transient_, persistent_);
  }

  // A message that the program has sent. Allocates nothing.
  void accept(const rung_message& message);
  // Whether the message begins to be shown, or is only logged; if not, it ends.
  bool begins(const rung_message& message) const;
  // The message as a host reads it: the number without marks, and the op that applies. Allocates nothing.
  rung_message outward(const rung_message& message) const noexcept;
  // Writes number, subid and values, then the text with its values if there is one. Returns the number of characters
  // written; longer texts are cut off. Allocates nothing.
  size_t describe(const rung_message& message, std::span<char> out) const noexcept;

  // The operator confirms the transient message on the screen; the next one appears.
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
  std::vector<MessageValues> persistent_; // in order of arrival
};

} // namespace rung::nc::technol
