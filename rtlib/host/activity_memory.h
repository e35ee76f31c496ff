// What rt::Activity needs for one instance of a program, made of the program's tables. Allocates when it is made.
#pragma once
#include <cstdint>
#include <memory>

#include "rtlib/core/activity.h"
#include "rung/program.h"

namespace rung::host {

class ActivityMemory {
public:
  // Of a program without such tables there is nothing in it.
  explicit ActivityMemory(const rung_program& program);

  rt::Activity make() noexcept;

private:
  template <class T>
  struct Array {
    void make(uint32_t count) {
      items = std::make_unique<T[]>(count);
      size = count;
    }
    T& operator[](uint32_t i) const { return items[i]; }
    std::span<T> all() const { return {items.get(), size}; }

    std::unique_ptr<T[]> items;
    uint32_t size = 0;
  };
  using Numbers = Array<uint32_t>;

  void findLines(const rung_program& program);
  void findWatchers(const rung_program& program);
  void findWritten(const rung_program& program);
  void findTimers(const rung_program& program);
  void findProperties(const rung_program& program);
  void findRelayed(const rung_program& program);
  bool isRelayed(uint32_t byte) const { return relayedAt_[byte] != RUNG_NONE; }

  uint32_t task_ = RUNG_NONE;
  Numbers lineNumbers_; // by line of the block; RUNG_NONE: no chunk touches it
  uint32_t lineCount_ = 0;
  Array<rt::ActivityStretch> stretches_;
  Numbers firstWatcher_;
  Array<rt::ChunkBits> watchers_;
  Numbers firstWritten_;
  Numbers writtenLines_;
  Array<uint8_t> properties_;
  Array<rt::Rest> rests_;
  Array<uint64_t> passed_;
  Array<uint64_t> turned_;
  uint64_t weights_ = 0; // of all chunks
  uint32_t firstOfEntry_ = 0;
  uint32_t endOfEntry_ = 0;
  Array<uint8_t> copy_;
  Numbers relayedAt_; // by byte of the block: in `relayedBytes_`; RUNG_NONE: none of them
  Array<rt::RelayedByte> relayedBytes_;
  Array<rt::RelayMember> members_;
  Numbers firstOfChunk_;
  Numbers ofChunk_;
  rt::TimerTables timers_;
  Array<rt::MovingNumber> numbers_;
  Array<rt::ChunkTimers> chunkTimers_;
  Array<uint64_t> onlyMoved_;
  Array<uint64_t> moving_;
  Array<uint64_t> starting_;
};

} // namespace rung::host
