// See recording_file.h.
#include "rtlib/record/recording_file.h"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace rung::runtime {

namespace {

uint32_t crc(uint32_t seed, const void* bytes, size_t count) noexcept {
  if (count == 0) return seed; // a null pointer has another meaning
  return static_cast<uint32_t>(crc32_z(seed, static_cast<const Bytef*>(bytes), count));
}

constexpr std::string_view kSegment = ".rec", kKept = ".kept.rec", kProgram = ".program";

} // namespace

uint32_t SegmentHead::sum() const noexcept { return crc(0, this, sizeof *this - sizeof checksum); }

uint32_t BlockHead::sum(std::span<const uint8_t> bytes) const noexcept {
  return crc(crc(0, this, sizeof *this - sizeof checksum), bytes.data(), bytes.size());
}

std::string segmentName(uint64_t number, bool kept) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%08llu", static_cast<unsigned long long>(number));
  return std::string(text.data()).append(kept ? kKept : kSegment);
}

std::string programName(uint64_t hash) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return std::string(text.data()).append(kProgram);
}

std::optional<uint64_t> programOfName(std::string_view name) {
  uint64_t hash = 0;
  if (!name.ends_with(kProgram)) return std::nullopt;
  name.remove_suffix(kProgram.size());
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), hash, 16);
  return error == std::errc() && end == name.data() + name.size() ? std::optional(hash) : std::nullopt;
}

std::vector<SegmentFile> segmentsIn(const std::string& folder) {
  std::vector<SegmentFile> segments;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    SegmentFile file{.name = entry.path().filename().string()};
    file.kept = file.name.ends_with(kKept);
    std::string_view digits = file.name;
    if (!digits.ends_with(kSegment)) continue;
    digits.remove_suffix(file.kept ? kKept.size() : kSegment.size());
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), file.number);
    if (error != std::errc() || end != digits.data() + digits.size()) continue;
    file.bytes = entry.file_size(none);
    if (none) continue; // it has just been deleted
    segments.push_back(file);
  }
  std::ranges::sort(segments, {}, &SegmentFile::number);
  return segments;
}

std::optional<SegmentHead> readSegmentHead(const std::string& path, std::string& problem) {
  SegmentHead head;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    problem = path + " cannot be read: " + std::strerror(errno);
    return std::nullopt;
  }
  file.read(reinterpret_cast<char*>(&head), sizeof head);
  if (static_cast<size_t>(file.gcount()) == sizeof head && head.magic == SegmentHead::kMagic &&
      head.version > SegmentHead::kVersion)
    problem = path + " has version " + std::to_string(head.version) + " of recordings, this one reads version " +
              std::to_string(SegmentHead::kVersion);
  else if (static_cast<size_t>(file.gcount()) != sizeof head || !head.isGood())
    problem = path + " is not a segment of a recording, or its beginning is damaged";
  else
    return head;
  return std::nullopt;
}

} // namespace rung::runtime
