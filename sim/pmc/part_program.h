// Part programs of the simulated CNC: parses the text of `event program` and `event mdi` into blocks.
//
//   block := ["/"] { word | "(" comment ")" | "#" number "=" value }
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/part_program.h"
#include "sim/pmc/cnc.h"

namespace rung::sim::pmc {

struct Word {
  char letter = 0; // '#': assignment to `variable`
  uint32_t variable = 0;
  ProgramValue value;

  template <class Archive>
  void state(Archive& archive) {
    archive(letter, variable, value);
  }
};

struct Block {
  bool skipped = false;  // "/"
  uint32_t sequence = 0; // N; 0: none
  std::vector<Word> words;

  bool empty() const { return sequence == 0 && words.empty(); }

  template <class Archive>
  void state(Archive& archive) {
    archive(skipped, sequence, words);
  }
};

struct PartProgram {
  uint32_t number = 0; // O
  std::vector<Block> blocks;

  template <class Archive>
  void state(Archive& archive) {
    archive(number, blocks);
  }
};

// Returns "" and the program, or the error in the text. `axes`: the letters of the axes.
std::string readPartProgram(std::string_view text, std::string_view axes, const Cnc& cnc, bool manyM,
                            PartProgram& program);

} // namespace rung::sim::pmc
