// What a program consists of, as a list: files, modules and sections with the rungs in them.
#pragma once
#include <string>
#include <vector>

#include "tools/view/program.h"

namespace rung::view {

struct ContentsEntry {
  enum class Kind : uint8_t { File, Module, Section };
  Kind kind = Kind::Section;
  uint32_t block = 0;     // index into Program::blocks: where it leads
  uint32_t level = 0;     // from 0: how deep it is
  std::string text;       // "spindles.lad", "Subprogram P5"
  std::string title;      // "overrides"; of a file the module that it begins with
  uint32_t firstRung = 0; // 0: there is none
  uint32_t lastRung = 0;
};

std::vector<ContentsEntry> contentsOf(const Program& program);

} // namespace rung::view
