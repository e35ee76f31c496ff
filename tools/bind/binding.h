// Members of a host's struct matched with names of a program: the rows of a rung_layout.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "codegen/clang/layout.h"
#include "rung/runtime.h"
#include "tools/bind/file.h"
#include "tools/bind/member.h"

namespace rung::bind {

// The fields of rung_member.
struct Row {
  std::string name;
  std::string member;
  uint32_t offset = 0;
  uint32_t bytes = 0;
  uint32_t type = 0; // enum rung_host_type; 0: a block of bytes
  uint32_t direction = RUNG_TO_PROGRAM;
  uint32_t bit = 0;
  uint32_t bits = 0;
  double scale = 0;
  Member at;
};

struct CounterRow {
  std::string member;
  uint32_t offset = 0;
};

struct Binding {
  std::vector<Row> rows;
  CounterRow head, tail;
  uint32_t counterBytes = 0; // 0: no counters
};

// Every row that does not fit adds an entry to `errors`. `program`: the tables of the instance's image; the instance is
// not used afterwards.
Binding bind(const File& file, const codegen::HostLayout& layout, rung_instance* instance, const rung_program& program,
             std::vector<Error>& errors);

// The bindings as text, one row per line: rung_layout::text.
std::string describe(const Binding& binding, const codegen::HostLayout& layout);

// "i32", "bool", "3 bits", "16 bytes"
std::string typeText(const Row& row);

} // namespace rung::bind
