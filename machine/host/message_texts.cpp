// See message_texts.h.
#include "machine/host/message_texts.h"

#include <algorithm>
#include <exception>

#include "machine/host/control_files.h"
#include "machine/host/mapping_file.h"

namespace rung::host {
namespace {

using nc::technol::MessageKind;
using nc::technol::Validity;

int32_t define(rung_instance* instance, const PlacedMessage& message) {
  const uint32_t lasts = message.validity == Validity::Persistent ? uint32_t{RUNG_MESSAGE_LASTS} : 0;
  const uint32_t loggedOnly = message.kind == MessageKind::Event ? uint32_t{RUNG_MESSAGE_LOGGED_ONLY} : 0;
  return rung_instance_define_message(instance, message.number, lasts | loggedOnly, message.text.c_str());
}

void addLines(const std::string& text, std::vector<std::string>& errors) {
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    errors.push_back(text.substr(at, end - at));
    at = end + 1;
  }
}

} // namespace

void defineMessages(const File& map, rung_instance* instance, std::vector<std::string>& errors, const ReadFile& read) {
  const auto fail = [&](const MessageFile& file, const Mistake& mistake) {
    errors.push_back(map.message(file.at, "PlcErrors: " + mistake.text()));
  };
  ControlFiles found;
  for (const MessageFile& file : map.messageFiles) try {
      addLines(parseControlFile(ControlFileKind::Messages, file.path, read(file.path), found), errors);
    } catch (const std::exception& error) {
      fail(file,
           {file.path, std::string("a file (") + error.what() + ")", "write its path, from the folder of this file"});
    }
  for (const PlacedMessage& message : found.messages) {
    if (define(instance, message) == RUNG_OK) continue;
    return fail(map.messageFiles.front(), {"a file of messages", "none for this program", rung_error_text()});
  }
}

} // namespace rung::host
