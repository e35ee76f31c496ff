// libFuzzer target: any bytes as each of the TECHNOL control's XML files.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ir/support/check.h"
#include "machine/host/control_files.h"

using namespace rung::host;

namespace {

// A mistake is told with its place, and nothing of its file is taken.
void checkMistakes(std::string_view mistakes, const ControlFiles& files) {
  RUNG_CHECK(files.messages.empty() && files.parameters.empty() && files.constants.empty() &&
                 files.connections.empty() && files.terminals.empty(),
             "a bad file gives nothing");
  RUNG_CHECK(mistakes.starts_with("f:"), "a mistake has a place");
}

void checkFiles(const ControlFiles& files) {
  for (const PlacedMessage& message : files.messages) {
    RUNG_CHECK(message.number <= 65535, "the number of a message is a WORD");
    RUNG_CHECK(message.text.find('\n') == std::string::npos, "a text has one line");
  }
  for (const TerminalDefinition& terminal : files.terminals)
    RUNG_CHECK(!terminal.id.empty() && terminal.port <= 128 && terminal.bit <= 7 && terminal.physical <= 99,
               "an input or output is within its bounds");
  for (const ConstantDefinition& constant : files.constants)
    RUNG_CHECK(!constant.id.empty() && !constant.value.empty(), "a constant has a name and a value");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const auto kind : {ControlFileKind::Messages, ControlFileKind::Constants, ControlFileKind::Channel}) {
    ControlFiles files;
    const std::string mistakes = parseControlFile(kind, "f", text, files);
    if (mistakes.empty())
      checkFiles(files);
    else
      checkMistakes(mistakes, files);
  }
  return 0;
}
