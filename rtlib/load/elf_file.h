// What an ELF shared object exports and what it would make the dynamic linker load, read from its bytes without
// trusting any of them. 32 and 64 bits, low byte first.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rung::runtime {

struct ElfObject {
  std::string problem;               // why it cannot be read as a shared object; then the rest is empty
  std::string machine;               // the processor that it is for, as in the names of targets
  std::vector<std::string> needed;   // libraries by name
  std::vector<std::string> searched; // folders to search (RPATH, RUNPATH) and further libraries (filters, audit)
  std::vector<std::string> exported; // names of its symbols for others
};

// This process's own, as ElfObject::machine.
std::string_view machineHere();
bool isElf(std::string_view file); // of any kind
ElfObject readElf(std::string_view file);

} // namespace rung::runtime
