// The binding file: which members of a host's struct are which names of the PLC program. It is TOML; docs/bind.md
// describes its tables. This is the file alone; binding.h looks members and names up.
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
  bool input = true; // of [in]
  std::string member;
  std::string name; // of the program
  double scale = 0; // 0: none is given
  bool cut = false; // upper bits that do not fit are left out
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

// Every mistake is an entry of `errors`; of a text that is not TOML the first one.
File parse(std::string_view text, std::vector<Error>& errors);

} // namespace rung::bind
