// Segments of a loaded library (see mapped_file.h).
#include "rtlib/load/mapped_file.h"

#include <cstring>
#include <dlfcn.h>
#include <link.h>

namespace rung::runtime {

MappedFile::MappedFile(void* library) {
  link_map* map = nullptr;
  if (dlinfo(library, RTLD_DI_LINKMAP, &map) != 0) return;
  struct Search {
    MappedFile& file;
    ElfW(Addr) base;
    const ElfW(Dyn) * dynamic;
  } search{*this, map->l_addr, map->l_ld};
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void* data) {
        auto& wanted = *static_cast<Search*>(data);
        bool isIt = false;
        for (size_t i = 0; i < info->dlpi_phnum; ++i)
          isIt = isIt || (info->dlpi_phdr[i].p_type == PT_DYNAMIC &&
                          info->dlpi_addr + info->dlpi_phdr[i].p_vaddr == reinterpret_cast<uintptr_t>(wanted.dynamic));
        for (size_t i = 0; isIt && i < info->dlpi_phnum; ++i) {
          const auto& segment = info->dlpi_phdr[i];
          if (segment.p_type != PT_LOAD || (segment.p_flags & PF_R) == 0) continue;
          const uintptr_t begin = info->dlpi_addr + segment.p_vaddr;
          wanted.file.segments_.push_back({begin, begin + segment.p_memsz, (segment.p_flags & PF_X) != 0});
        }
        return isIt ? 1 : 0;
      },
      &search);
}

MappedFile::MappedFile(const void* begin, uint64_t bytes, bool isCode)
    : segments_{{reinterpret_cast<uintptr_t>(begin), reinterpret_cast<uintptr_t>(begin) + bytes, isCode}} {}

const MappedFile::Segment* MappedFile::segmentOf(const void* address, uint64_t bytes) const noexcept {
  const auto at = reinterpret_cast<uintptr_t>(address);
  for (const Segment& segment : segments_)
    if (at >= segment.begin && at <= segment.end && bytes <= segment.end - at) return &segment;
  return nullptr;
}

bool MappedFile::holdsCode(const void* address) const noexcept {
  const Segment* segment = segmentOf(address, 1);
  return segment != nullptr && segment->isCode;
}

bool MappedFile::holdsText(const char* text) const noexcept {
  const Segment* segment = segmentOf(text, 1);
  return segment != nullptr && std::memchr(text, 0, segment->end - reinterpret_cast<uintptr_t>(text)) != nullptr;
}

} // namespace rung::runtime
