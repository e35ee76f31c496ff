// The messages that a program has shown on the screen of its control, as its past is played.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rtlib/nc/control/control.h"
#include "tools/replay/past.h"

namespace rung::replay {

struct PastMessage {
  bool gone = false; // otherwise it appears
  nc::ShownMessage message;
  std::string text; // as the operator reads it
};

class PastMessages {
public:
  // The past outlives it. Where the control does not run again, messages of NCT and TECHNOL are known if they have
  // appeared since then, and one that the operator cancels is not seen to go.
  explicit PastMessages(Past& past) : past_(past) {}

  // One of these two is to be called after each part in order: the control that shows the messages; or what has changed
  // since the last call.
  const nc::Control& control();
  std::vector<PastMessage> changes();
  const std::vector<nc::ShownMessage>& shown() const { return shown_; }

private:
  Past& past_;
  std::unique_ptr<nc::Control> own_; // sees what the program sends; null: not made yet
  uint32_t program_ = kNone;         // to which it is attached
  std::vector<nc::ShownMessage> shown_;
};

// Plays the whole recording: calls see(change) at each, with the past after the part. "" or why it ended early; the
// position is then anywhere.
std::string forEachMessage(Past& past, const std::function<void(const PastMessage& change)>& see);

} // namespace rung::replay
