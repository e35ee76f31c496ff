// Reads the files that define the keys of a keyboard (KbdConfig, man. ch. 11, l.16745-16905).
//
//   <KeyboardConfig>
//     <KeyConfig ScanCode="0x03" Type="Normal" PlcCommand="CMD_LUBR1" RtmCommand="RTMID_MMM_SEL00"></KeyConfig>
//     <KeyConfig ScanCode="0x6A"><Function No="1" PlcCommand="CMD_PERF"></Function></KeyConfig>
//   </KeyboardConfig>
//
// Elements that concern only screens (VirtualKey, Command, Dialog, ...) are ignored.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/xml_reader.h"

namespace rung::host {

// One function of a key.
struct KeyDefinition {
  static constexpr uint8_t kAnyFunction = 0xFF; // a key without <Function>

  uint8_t scan = 0;                // 0 to 255
  uint8_t function = kAnyFunction; // 0 to 3
  std::string plcCommand;          // identifier of a PLC constant; "": none
  std::string rtmCommand;          // "RTMID_MMM_MOVEX"; "": none
  FilePlace place;
};

// Adds the file's keys. Returns "", or the errors, one line "FILE:LINE:COLUMN: ..." each; `keys` is then unchanged.
std::string readKeyboardFile(const std::string& path, std::vector<KeyDefinition>& keys);
// The same for a text; `name` is the name of the file in messages.
std::string parseKeyboardFile(std::string_view name, std::string_view text, std::vector<KeyDefinition>& keys);

} // namespace rung::host
