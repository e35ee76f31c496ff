// Part programs of the simulated NCT control: the text of `event program` and `event mdi`, read into blocks.
//
//   block := ["/" [1-8]] { word | assignment | jump | "(" comment ")" }
//   word  := letter value | "S" digits "=" value
//   assignment := "#" number "=" value
//   jump  := [["IF"] "#" number ("EQ"|"NE"|"GT"|"LT"|"GE"|"LE") value] "GOTO" number
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/part_program.h"

namespace rung::sim::nct {

inline constexpr uint32_t kCodesOfABlock = 8; // M codes, l.9470

struct ProgramWord {
  char letter = 0;
  uint32_t spindle = 0; // of S3=1000; else 0
  ProgramValue value;
};

struct ProgramAssignment {
  uint32_t variable = 0;
  ProgramValue value;
};

struct ProgramJump {
  enum class Test : uint8_t { Always, Eq, Ne, Gt, Lt, Ge, Le };
  Test test = Test::Always;
  uint32_t variable = 0;
  ProgramValue value;
  uint32_t target = 0; // N
};

struct ProgramBlock {
  uint32_t condition = 0; // "/n": skipped while CP_CNDBK_n=1; 0: always executed
  uint32_t sequence = 0;  // N; 0: none
  std::vector<ProgramWord> words;
  std::vector<ProgramAssignment> assignments;
  std::optional<ProgramJump> jump;

  bool empty() const { return sequence == 0 && words.empty() && assignments.empty() && !jump; }
};

struct ChannelProgram {
  int32_t number = 0; // O
  std::vector<ProgramBlock> blocks;
};

// "" and the program, or what is wrong with the text.
std::string readChannelProgram(std::string_view text, ChannelProgram& program);

} // namespace rung::sim::nct
