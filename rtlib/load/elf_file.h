// The exports of an ELF shared object, and the libraries that it would make the dynamic linker load, read from its
// bytes without trusting any of them. 32 and 64 bits, little-endian.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rung::runtime {

struct ElfObject {
  std::string problem;               // why it cannot be read as a shared object; then the rest is empty
  std::string machine;               // its processor, as in the names of targets
  std::vector<std::string> needed;   // libraries by name
  std::vector<std::string> searched; // folders to search (RPATH, RUNPATH) and further libraries (filters, audit)
  std::vector<std::string> exported; // names of its exported symbols
};

// The processor of this process, as in ElfObject::machine.
std::string_view machineHere();
bool isElf(std::string_view file); // an ELF file of any kind
ElfObject readElf(std::string_view file);

} // namespace rung::runtime
