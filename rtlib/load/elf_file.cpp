// Program headers, dynamic section and symbols, as the dynamic linker follows them (see elf_file.h).
#include "rtlib/load/elf_file.h"

#include <cstdint>
#include <cstring>
#include <elf.h>
#include <optional>

namespace rung::runtime {
namespace {

constexpr size_t kMostEntries = 1 << 20; // of any table

struct Elf32 {
  using Header = Elf32_Ehdr;
  using Segment = Elf32_Phdr;
  using Section = Elf32_Shdr;
  using Dynamic = Elf32_Dyn;
  using Symbol = Elf32_Sym;
};
struct Elf64 {
  using Header = Elf64_Ehdr;
  using Segment = Elf64_Phdr;
  using Section = Elf64_Shdr;
  using Dynamic = Elf64_Dyn;
  using Symbol = Elf64_Sym;
};

std::string machineName(unsigned machine) {
  switch (machine) {
  case EM_X86_64: return "x86_64";
  case EM_AARCH64: return "aarch64";
  case EM_ARM: return "armv7";
  case EM_RISCV: return "riscv64";
  default: return "of ELF number " + std::to_string(machine);
  }
}

template <class Elf>
class Reader {
public:
  explicit Reader(std::string_view file) : file_(file) {}

  ElfObject read() {
    const auto header = at<typename Elf::Header>(0);
    if (!header) return wrong("it is cut short");
    if (header->e_type != ET_DYN) return wrong("it is an ELF file, but not a shared object");
    if (header->e_phentsize != sizeof(typename Elf::Segment)) return wrong("its program headers are damaged");
    for (size_t i = 0; i < header->e_phnum; ++i) {
      const auto segment = at<typename Elf::Segment>(header->e_phoff + i * sizeof(typename Elf::Segment));
      if (!segment) return wrong("its program headers are cut short");
      segments_.push_back(*segment);
    }
    if (!readDynamic()) return wrong("its dynamic section is damaged");
    readSymbols(*header);
    found_.machine = machineName(header->e_machine);
    return std::move(found_);
  }

private:
  static ElfObject wrong(std::string why) {
    return {.problem = std::move(why), .machine = {}, .needed = {}, .searched = {}, .exported = {}};
  }

  template <class T>
  std::optional<T> at(uint64_t offset) const {
    if (offset > file_.size() || file_.size() - offset < sizeof(T)) return std::nullopt;
    T value{};
    std::memcpy(&value, file_.data() + offset, sizeof(T));
    return value;
  }

  std::optional<std::string> textAt(uint64_t offset) const {
    if (offset >= file_.size()) return std::nullopt;
    const size_t end = file_.find('\0', offset);
    if (end == std::string_view::npos) return std::nullopt;
    return std::string(file_.substr(offset, end - offset));
  }

  // The offset in the file of the bytes at an address in memory.
  std::optional<uint64_t> offsetOf(uint64_t address) const {
    for (const auto& segment : segments_)
      if (segment.p_type == PT_LOAD && address >= segment.p_vaddr && address - segment.p_vaddr < segment.p_filesz)
        return segment.p_offset + (address - segment.p_vaddr);
    return std::nullopt;
  }

  bool readDynamic() {
    for (const auto& segment : segments_)
      if (segment.p_type == PT_DYNAMIC) {
        const auto offset = offsetOf(segment.p_vaddr);
        if (!offset || !readEntries(*offset)) return false;
      }
    return true;
  }

  bool readEntries(uint64_t offset) {
    std::vector<typename Elf::Dynamic> entries;
    for (;;) {
      const auto entry = at<typename Elf::Dynamic>(offset + entries.size() * sizeof(typename Elf::Dynamic));
      if (!entry || entries.size() > kMostEntries) return false;
      if (entry->d_tag == DT_NULL) break;
      entries.push_back(*entry);
    }
    std::optional<uint64_t> texts;
    for (const auto& entry : entries)
      if (entry.d_tag == DT_STRTAB) texts = offsetOf(entry.d_un.d_ptr);
    for (const auto& entry : entries) {
      std::vector<std::string>* list = listOf(static_cast<int64_t>(entry.d_tag));
      if (list == nullptr) continue;
      const auto text = texts ? textAt(*texts + entry.d_un.d_val) : std::nullopt;
      if (!text) return false;
      list->push_back(*text);
    }
    return true;
  }

  // The list for texts of entries with this tag; null: such an entry loads nothing.
  std::vector<std::string>* listOf(int64_t tag) {
    switch (tag) {
    case DT_NEEDED: return &found_.needed;
    case DT_RPATH:
    case DT_RUNPATH:
    case DT_AUXILIARY:
    case DT_FILTER:
    case DT_CONFIG:
    case DT_AUDIT:
    case DT_DEPAUDIT: return &found_.searched;
    default: return nullptr;
    }
  }

  void readSymbols(const typename Elf::Header& header) {
    for (size_t i = 0; i < header.e_shnum; ++i) {
      const auto section = at<typename Elf::Section>(header.e_shoff + i * sizeof(typename Elf::Section));
      if (!section) return;
      if (section->sh_type != SHT_DYNSYM || section->sh_link >= header.e_shnum) continue;
      const auto texts = at<typename Elf::Section>(header.e_shoff + section->sh_link * sizeof(typename Elf::Section));
      if (texts) readTable(*section, *texts);
    }
  }

  void readTable(const typename Elf::Section& table, const typename Elf::Section& texts) {
    const size_t count = table.sh_size / sizeof(typename Elf::Symbol);
    for (size_t i = 0; i < count && i < kMostEntries; ++i) {
      const auto symbol = at<typename Elf::Symbol>(table.sh_offset + i * sizeof(typename Elf::Symbol));
      if (!symbol) return;
      if (symbol->st_shndx == SHN_UNDEF || symbol->st_info >> 4 == STB_LOCAL) continue;
      if (const auto name = textAt(texts.sh_offset + symbol->st_name)) found_.exported.push_back(*name);
    }
  }

  std::string_view file_;
  std::vector<typename Elf::Segment> segments_;
  ElfObject found_;
};

} // namespace

std::string_view machineHere() {
#if defined(__x86_64__)
  return "x86_64";
#elif defined(__aarch64__)
  return "aarch64";
#elif defined(__arm__)
  return "armv7";
#elif defined(__riscv)
  return "riscv64";
#else
#error "the name of this processor is missing"
#endif
}

bool isElf(std::string_view file) { return file.size() >= EI_NIDENT && file.starts_with(ELFMAG); }

ElfObject readElf(std::string_view file) {
  if (!isElf(file))
    return {.problem = "it is not an ELF file", .machine = {}, .needed = {}, .searched = {}, .exported = {}};
  if (file[EI_DATA] != ELFDATA2LSB)
    return {.problem = "it is for a processor with the high byte first",
            .machine = {},
            .needed = {},
            .searched = {},
            .exported = {}};
  return file[EI_CLASS] == ELFCLASS32 ? Reader<Elf32>(file).read() : Reader<Elf64>(file).read();
}

} // namespace rung::runtime
