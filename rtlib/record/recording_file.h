// The files of a recording (docs/recording.md): a folder with segments NUMBER.rec, of which those that are kept are
// NUMBER.kept.rec, and with the programs that they name, HASH.program.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rung::runtime {

enum class RecordingMode : uint32_t {
  Control = 1, // what the host did; the control of the dialect runs again (api::HostPlayer)
  Bytes = 2,   // what hooks wrote, too (BytesPlayer)
};

// At the beginning of a segment; all numbers are little-endian.
struct SegmentHead {
  static constexpr std::array<char, 8> kMagic = {'R', 'U', 'N', 'G', 'R', 'E', 'C', '\n'};
  static constexpr uint32_t kVersion = 1;
  std::array<char, 8> magic = kMagic;
  uint32_t version = kVersion;
  RecordingMode mode = RecordingMode::Control;
  uint64_t program = 0; // rung_program::code_hash
  uint64_t number = 0;  // of the segment in its folder
  uint64_t run = 0;     // segments with the same number follow each other without a gap
  int64_t wallUs = 0;   // since 1970, UTC: when the segment began
  uint32_t reserved = 0;
  uint32_t checksum = 0; // CRC-32 of all before

  uint32_t sum() const noexcept;
  bool isGood() const noexcept { return magic == kMagic && checksum == sum(); }
};
static_assert(sizeof(SegmentHead) == 56);

enum class BlockKind : uint32_t {
  State = 1,  // a deflate stream begins; its contents begin with a whole state
  Events = 2, // it continues
  End = 3,    // the recording has ended here regularly
};

// Before each block; `size` bytes of the stream follow, up to a byte boundary.
struct BlockHead {
  static constexpr uint32_t kMagic = 0x4B4C4252;         // "RBLK"
  static constexpr uint32_t kMost = uint32_t{256} << 20; // bytes of a block, packed or not
  uint32_t magic = kMagic;
  BlockKind kind = BlockKind::Events;
  uint32_t size = 0;
  uint32_t raw = 0;   // bytes of events
  int64_t wallUs = 0; // when it was written
  uint32_t reserved = 0;
  uint32_t checksum = 0; // CRC-32 of all before and of the bytes that follow

  uint32_t sum(std::span<const uint8_t> bytes) const noexcept;
  bool isPossible() const noexcept {
    const auto number = static_cast<uint32_t>(kind);
    return magic == kMagic && number >= 1 && number <= 3 && size <= kMost && raw <= kMost;
  }
};
static_assert(sizeof(BlockHead) == 32);

std::string segmentName(uint64_t number, bool kept);
std::string programName(uint64_t hash);

struct SegmentFile {
  std::string name; // in its folder
  uint64_t number = 0;
  bool kept = false;
  uint64_t bytes = 0;
};
// The segments of a folder, by number. Empty if it is not a folder.
std::vector<SegmentFile> segmentsIn(const std::string& folder);
// The hash of a program's file name; nothing if it is not one.
std::optional<uint64_t> programOfName(std::string_view name);
// Of a file. Nothing: `problem` says why.
std::optional<SegmentHead> readSegmentHead(const std::string& path, std::string& problem);

} // namespace rung::runtime
