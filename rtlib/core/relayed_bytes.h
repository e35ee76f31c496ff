// Bytes that several chunks write in one run, as the flags of arithmetic (see activity.h). They change within each run,
// though each chunk finds and leaves the same there from run to run; so a chunk need not run for such a byte as
// long as it would find what it found in its last run, and it then leaves what it left.
//
// All chunks that touch the byte are its members, in the order in which each run comes to them, exactly once. What
// rests is not written one by one: memory has what the last one left before a member runs, and where the run ends.
#pragma once
#include <cstdint>
#include <span>

#include "rtlib/core/chunk_bits.h"

namespace rung::rt {

// A chunk that touches one of the bytes.
struct RelayMember {
  uint32_t chunk = 0;
  uint32_t byte = 0;  // in RelayTables::bytes
  uint8_t before = 0; // what its last run found
  uint8_t after = 0;  // and left
};

struct RelayedByte {
  uint32_t offset = 0;      // in the memory block
  uint32_t firstMember = 0; // in RelayTables::members
  uint32_t endMember = 0;
  uint32_t next = 0; // member after the last one that has run in this run
};

// Of one program; host::ActivityMemory makes it.
struct RelayTables {
  std::span<RelayedByte> bytes;
  std::span<RelayMember> members;         // of each byte, in the order of a run
  std::span<const uint32_t> firstOfChunk; // by chunk, and one more: in `ofChunk`
  std::span<const uint32_t> ofChunk;      // members
};

// `wake` is called with the ChunkBits of a chunk that has to run.
class RelayedBytes {
public:
  RelayedBytes() = default;
  explicit RelayedBytes(const RelayTables& tables) noexcept : tables_(tables) {}

  template <class Wake>
  void begin(const uint8_t* memory, const Wake& wake) noexcept {
    for (RelayedByte& byte : tables_.bytes) {
      byte.next = byte.firstMember;
      expect(byte.firstMember, memory[byte.offset], wake);
    }
  }
  // Before a chunk runs: it finds what those before it have left.
  void reach(uint8_t* memory, uint32_t chunk) noexcept {
    for (const uint32_t m : membersOf(chunk)) {
      RelayMember& member = tables_.members[m];
      RelayedByte& byte = tables_.bytes[member.byte];
      if (byte.next != m) memory[byte.offset] = tables_.members[m - 1].after;
      byte.next = m + 1;
      member.before = memory[byte.offset];
    }
  }
  // After it.
  template <class Wake>
  void ran(const uint8_t* memory, uint8_t* copy, uint32_t chunk, const Wake& wake) noexcept {
    for (const uint32_t m : membersOf(chunk)) {
      RelayMember& member = tables_.members[m];
      const RelayedByte& byte = tables_.bytes[member.byte];
      member.after = copy[byte.offset] = memory[byte.offset];
      if (m + 1 < byte.endMember) expect(m + 1, member.after, wake);
    }
  }
  // The run is over, or is not followed any more: memory has what the last ones below `endChunk` left.
  void end(uint8_t* memory, uint8_t* copy, uint32_t endChunk) noexcept {
    for (RelayedByte& byte : tables_.bytes) {
      uint32_t last = byte.endMember;
      while (last > byte.next && tables_.members[last - 1].chunk >= endChunk) --last;
      if (last <= byte.next) continue;
      memory[byte.offset] = copy[byte.offset] = tables_.members[last - 1].after;
      byte.next = last;
    }
  }

private:
  std::span<const uint32_t> membersOf(uint32_t chunk) const noexcept {
    const uint32_t first = tables_.firstOfChunk[chunk];
    return tables_.ofChunk.subspan(first, tables_.firstOfChunk[chunk + 1] - first);
  }
  template <class Wake>
  void expect(uint32_t m, uint8_t value, const Wake& wake) const noexcept {
    const RelayMember& member = tables_.members[m];
    if (member.before != value) wake(bitOf(member.chunk));
  }

  RelayTables tables_;
};

} // namespace rung::rt
