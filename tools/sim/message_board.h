// What a simulated NC shows to its operator: the messages on the screen and the log. It takes what programs put into
// their message queue.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/host/instance.h"

namespace rung::nc {

struct ShownMessage {
  uint32_t number = 0;
  int32_t channel = 0;
  int32_t index = 0;
  int64_t value = 0; // the bits of a double when `real`; TECHNOL: par1
  bool real = false;
  std::string text;
  uint32_t par2 = 0, par3 = 0; // TECHNOL
  bool operator==(const ShownMessage&) const = default;
};

// The line of a log: the message's number (NCT: its code of 8 digits) and its text, with its number where the dialect
// prints one; TECHNOL: PLC and five digits, subid and three values, its text is not the program's. Gives the characters
// written; what does not fit is cut off. Allocates nothing.
inline constexpr size_t kMessageLine = 400; // is enough
size_t describeMessage(const rung_program& program, const rung_message& message, std::span<char> out);

class MessageBoard {
public:
  // Empties the instance's queue.
  void take(host::Instance& instance);
  void show(ShownMessage message);
  // All messages of this number, or the one that has been shown longest.
  void remove(uint32_t number);
  void confirmOldest();
  void log(std::string line) { log_.push_back(std::move(line)); }
  void clear();

  const std::vector<ShownMessage>& shown() const { return shown_; }
  // Entries written since the last call.
  std::vector<std::string> takeLog();
  // Messages that the program's queue had no room for.
  uint32_t lost() const { return lost_; }

private:
  std::vector<ShownMessage> shown_; // oldest first
  std::vector<std::string> log_;
  uint32_t lost_ = 0;
};

} // namespace rung::nc
