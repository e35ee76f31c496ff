// The newest record of one thread, for any number of readers. The writer never waits. A reader that interrupts the
// writer, even for good, gets the record before, consistent; a reader that is itself interrupted while it reads tries
// again, a few times at most.
#pragma once
#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

namespace rung::runtime {

enum class Looked : uint8_t { Found, Empty, Interrupted };

class Latest {
public:
  // A record of so many words. Only the constructor allocates.
  explicit Latest(size_t words) : words_(words) {
    for (Slot& slot : slots_) slot.words = std::vector<std::atomic<uint64_t>>(words);
  }

  // The writing thread.
  void publish(std::span<const uint64_t> words) noexcept {
    assert(words.size() == words_);
    const uint64_t number = newest_.load(std::memory_order_relaxed) + 1;
    Slot& slot = slots_[number % kSlots];
    slot.holds.store(kNone, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    for (size_t i = 0; i < words_; ++i) slot.words[i].store(words[i], std::memory_order_relaxed);
    slot.holds.store(number, std::memory_order_release);
    newest_.store(number, std::memory_order_release);
  }

  bool empty() const noexcept { return newest_.load(std::memory_order_acquire) == kNone; }

  // Any thread, several at a time. `take` gets the number of each word and the word; what it has got means something
  // where the result is Found.
  template <class Take>
  Looked read(Take take) const noexcept {
    for (int tries = 0; tries < kTries; ++tries) {
      const uint64_t number = newest_.load(std::memory_order_acquire);
      if (number == kNone) return Looked::Empty;
      const Slot& slot = slots_[number % kSlots];
      if (slot.holds.load(std::memory_order_acquire) != number) continue;
      for (size_t i = 0; i < words_; ++i) take(i, slot.words[i].load(std::memory_order_relaxed));
      std::atomic_thread_fence(std::memory_order_acquire);
      if (slot.holds.load(std::memory_order_relaxed) == number) return Looked::Found;
    }
    return Looked::Interrupted;
  }

private:
  static constexpr uint64_t kNone = 0; // numbers are from 1
  static constexpr uint32_t kSlots = 4;
  static constexpr int kTries = 3;
  struct Slot {
    std::atomic<uint64_t> holds{kNone}; // the number of what is in it; none while it is written
    std::vector<std::atomic<uint64_t>> words;
  };
  size_t words_;
  std::array<Slot, kSlots> slots_;
  std::atomic<uint64_t> newest_{kNone};
};

} // namespace rung::runtime
