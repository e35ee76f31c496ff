// The binding file, in TOML (docs/bind.md): which members of a host's struct are bound to which names of the PLC
// program. This header reads the file only; binding.h looks members and names up.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/text/position.h"

namespace rung::bind {

struct Error {
  text::Position at;
  std::string text;
};

struct Entry {
  bool input = true; // table [in]
  std::string member;
  std::string name; // name in the program
  double scale = 0; // 0: not given
  bool cut = false; // upper bits that do not fit are dropped
  text::Position at;
};

struct Counter {
  std::string member;
  text::Position at;
};

struct File {
  std::vector<Entry> entries; // in the order of the file
  std::optional<Counter> head, tail;
};

// Every mistake adds an entry to `errors`; of a text that is not TOML, the first one only.
File parse(std::string_view text, std::vector<Error>& errors);

} // namespace rung::bind
