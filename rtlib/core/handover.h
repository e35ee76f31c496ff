// All ways in which one thread passes data to another, of which at least one is the scan thread. Neither side locks,
// allocates (except in a constructor) or makes a system call, and the scan thread never waits. The choice:
//
//   Ring, FixedRing  every element, in order                              one writer, one reader
//   SlotRing         the same, for records that are used in place        one writer, one reader
//   ByteRing         the same, for records of any length                 one writer, one reader
//   Newest           the newest value, whole, and whether it is new       one writer, one reader
//   Published        the newest value, whole                              one writer, any readers
//   PublishedText    the same of a text                                   one writer, any readers
//   Slot             one command to the scan thread, and its result       one poster at a time, the scan thread
//   ScanUse          the end of an object that the scan thread may use    one that ends it, the scan thread
//   GuardedMemory    memory of a host, whose writer counts its changes    the host, the scan thread
//
// Bounds: each call takes as long as copying its value. Published::read tries three times, GuardedMemory::copy as often
// as its caller specifies. Slot::withdraw and ScanUse::wait, which the scan thread must not call, wait for the one
// command that the scan thread executes, and for one use by it; only they call `yield`.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace rung::core {

// ---- every element -----------------------------------------------------------------------------------------------

// A bounded queue. An element that does not fit is refused and counted. Indices are free-running and wrap; the capacity
// is a power of two.
//
// Either side may drop the elements of the ring. The consumer pops them. The producer cannot, because the consumer may
// be reading an element at that moment: it marks all elements so far as dropped, and the consumer skips them at its
// next access. Until then they occupy their slots.
template <class T>
class Ring {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  // `storage` holds `capacity` elements, a power of two, and outlives the ring.
  Ring(T* storage, uint32_t capacity) noexcept : storage_(storage), mask_(capacity - 1) {
    assert(capacity != 0 && (capacity & mask_) == 0);
  }
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  uint32_t capacity() const noexcept { return mask_ + 1; }

  // Producer. False: the ring is full; the element is lost and counted.
  bool push(const T& item) noexcept {
    const uint32_t tail = tail_.load(std::memory_order_relaxed);
    const uint32_t head = head_.load(std::memory_order_acquire);
    if (!isAfter(dropped_.load(std::memory_order_relaxed), head)) dropped_.store(head, std::memory_order_relaxed);
    if (tail - head > mask_) {
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    storage_[tail & mask_] = item;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }
  // Producer: drops all elements so far, and resets the count of refused elements. The consumer may still receive the
  // element that it is reading at this moment.
  void drop() noexcept {
    dropped_.store(tail_.load(std::memory_order_relaxed), std::memory_order_release);
    lost_.store(0, std::memory_order_relaxed);
  }

  // Consumer. The oldest element is number 0; null if there are not that many.
  const T* peek(uint32_t number = 0) const noexcept {
    const uint32_t first = oldest();
    return tail_.load(std::memory_order_acquire) - first <= number ? nullptr : &storage_[(first + number) & mask_];
  }
  bool pop(T& item) noexcept {
    uint32_t first = oldest();
    const bool there = first != tail_.load(std::memory_order_acquire);
    if (there) item = storage_[first++ & mask_];
    if (first != head_.load(std::memory_order_relaxed)) head_.store(first, std::memory_order_release);
    return there;
  }

  // Either thread; exact only for the consumer, and then a lower bound.
  uint32_t size() const noexcept {
    const uint32_t first = oldest();
    return tail_.load(std::memory_order_acquire) - first;
  }
  // Elements refused since the last drop.
  uint32_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
  // Whether index `a` is after `b`, though indices wrap: they differ by the capacity at most, because the producer
  // keeps `dropped_` near `head_`.
  static bool isAfter(uint32_t a, uint32_t b) noexcept { return static_cast<int32_t>(a - b) > 0; }
  uint32_t oldest() const noexcept {
    const uint32_t dropped = dropped_.load(std::memory_order_acquire);
    const uint32_t head = head_.load(std::memory_order_acquire);
    return isAfter(dropped, head) ? dropped : head;
  }

  T* storage_;
  uint32_t mask_;
  alignas(64) std::atomic<uint32_t> head_{0}; // written by the consumer
  alignas(64) std::atomic<uint32_t> tail_{0}; // written by the producer
  std::atomic<uint32_t> dropped_{0};          // elements before it are dropped; written by the producer
  std::atomic<uint32_t> lost_{0};             // written by the producer
};

template <class T, uint32_t N>
struct RingStorage {
  T items[N];
};

// A ring with its own storage.
template <class T, uint32_t N>
class FixedRing : private RingStorage<T, N>, public Ring<T> {
  static_assert(N > 0 && (N & (N - 1)) == 0, "the capacity must be a power of two");

public:
  FixedRing() noexcept : RingStorage<T, N>{}, Ring<T>(RingStorage<T, N>::items, N) {}
};

// The indices of slots, which are filled and read in turn. The slots themselves belong to the user of the class.
class SlotRing {
public:
  explicit SlotRing(size_t slots) noexcept : slots_(slots) {}

  // Producer: the index of the slot to fill; nothing if all are full. It is the same until `push`.
  std::optional<size_t> back() const noexcept {
    const uint64_t pushed = pushed_.load(std::memory_order_relaxed);
    if (pushed - popped_.load(std::memory_order_acquire) == slots_) return std::nullopt;
    return pushed % slots_;
  }
  void push() noexcept { pushed_.store(pushed_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  // Consumer: the index of the oldest full slot; nothing if all are empty. It is the same until `pop`.
  std::optional<size_t> front() const noexcept {
    const uint64_t popped = popped_.load(std::memory_order_relaxed);
    if (pushed_.load(std::memory_order_acquire) == popped) return std::nullopt;
    return popped % slots_;
  }
  void pop() noexcept { popped_.store(popped_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  // Any thread; exact for the producer and the consumer.
  bool empty() const noexcept { return popped_.load() == pushed_.load(); }

private:
  size_t slots_;
  std::atomic<uint64_t> pushed_{0}, popped_{0};
};

// Records of bytes, each in one piece: one that does not fit before the end of the storage is at its beginning. One
// that does not fit at all is refused and counted.
class ByteRing {
public:
  // `bytes`: a power of two, at least 64.
  explicit ByteRing(size_t bytes) : storage_(bytes) { assert(bytes >= 64 && (bytes & (bytes - 1)) == 0); }

  // Producer: room for a record of `size` bytes; empty if there is none. `commit` makes the record readable, with as
  // many bytes as are used.
  std::span<uint8_t> reserve(size_t size) noexcept {
    const size_t needed = rounded(size);
    const uint64_t tail = tail_.load(std::memory_order_relaxed);
    const size_t at = tail & (storage_.size() - 1);
    const size_t skipped = needed <= storage_.size() - at ? 0 : storage_.size() - at;
    if (skipped + needed > storage_.size() - (tail - head_.load(std::memory_order_acquire))) {
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return {};
    }
    if (skipped != 0) setLength(at, kSkips);
    begin_ = tail + skipped;
    return {storage_.data() + (begin_ & (storage_.size() - 1)) + kHead, size};
  }
  void commit(size_t used) noexcept {
    setLength(begin_ & (storage_.size() - 1), static_cast<uint32_t>(used));
    tail_.store(begin_ + rounded(used), std::memory_order_release);
  }
  bool push(std::span<const uint8_t> record) noexcept {
    const std::span<uint8_t> room = reserve(record.size());
    if (room.empty()) return false;
    std::memcpy(room.data(), record.data(), record.size());
    commit(record.size());
    return true;
  }
  uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); } // any thread

  // Consumer: the oldest record, until `pop`; empty if there is none.
  std::span<const uint8_t> front() noexcept {
    uint64_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return {};
    size_t at = head & (storage_.size() - 1);
    if (lengthAt(at) == kSkips) head_.store(head += storage_.size() - at, std::memory_order_release), at = 0;
    return {storage_.data() + at + kHead, lengthAt(at)};
  }
  void pop() noexcept {
    const uint64_t head = head_.load(std::memory_order_relaxed);
    head_.store(head + rounded(lengthAt(head & (storage_.size() - 1))), std::memory_order_release);
  }

private:
  static constexpr size_t kHead = sizeof(uint32_t); // the length of a record, before it
  static constexpr uint32_t kSkips = UINT32_MAX;    // the next record is at the beginning of the storage
  // Records begin at multiples of the head, so that one fits wherever the storage does not end.
  static size_t rounded(size_t size) noexcept { return kHead + (size + kHead - 1) / kHead * kHead; }
  void setLength(size_t at, uint32_t length) noexcept { std::memcpy(storage_.data() + at, &length, sizeof length); }
  uint32_t lengthAt(size_t at) const noexcept {
    uint32_t length = 0;
    std::memcpy(&length, storage_.data() + at, sizeof length);
    return length;
  }

  std::vector<uint8_t> storage_;
  uint64_t begin_ = 0; // of the reserved record; producer
  alignas(64) std::atomic<uint64_t> head_{0};
  alignas(64) std::atomic<uint64_t> tail_{0};
  std::atomic<uint64_t> lost_{0};
};

// ---- the newest value --------------------------------------------------------------------------------------------

// Gives the reader the newest complete value; a value that it does not fetch is replaced by the next one. There are
// three buffers: one belongs to the writer, one to the reader, and they exchange the third.
template <class T>
class Newest {
public:
  explicit Newest(const T& initial) : values_{initial, initial, initial} {}

  // Writer: fills all of `back`, which holds an older value, and publishes it.
  T& back() noexcept { return values_[back_]; }
  void publish() noexcept { back_ = middle_.exchange(back_ | kNew, std::memory_order_acq_rel) & kIndex; }

  // Reader: true if `front` is now a newer value.
  bool take() noexcept {
    if (taken()) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  const T& front() const noexcept { return values_[front_]; }

  // Any thread: whether the reader has taken the last published value.
  bool taken() const noexcept { return (middle_.load(std::memory_order_acquire) & kNew) == 0; }

  // All three buffers: before the threads start or after they have ended.
  std::array<T, 3>& values() noexcept { return values_; }

private:
  static constexpr uint8_t kIndex = 3, kNew = 4;

  std::array<T, 3> values_;
  std::atomic<uint8_t> middle_{2}; // the index of the third buffer, and kNew if its value has not been taken
  uint8_t back_ = 0;               // the writer's index
  uint8_t front_ = 1;              // the reader's index
};

enum class Looked : uint8_t { Found, Empty, Interrupted };

// The newest value, as words, for any number of readers. A reader that interrupts the writer, for however long, finds
// the complete previous value; a reader that is itself interrupted while it reads tries again, kTries times at most.
class Published {
public:
  explicit Published(size_t words) : words_(words) {
    for (Copy& copy : copies_) copy.words = std::vector<std::atomic<uint64_t>>(words);
  }

  // Writer.
  void publish(std::span<const uint64_t> words) noexcept {
    assert(words.size() == words_);
    const uint64_t number = newest_.load(std::memory_order_relaxed) + 1;
    Copy& copy = copies_[number % kCopies];
    copy.holds.store(kNone, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    for (size_t i = 0; i < words_; ++i) copy.words[i].store(words[i], std::memory_order_relaxed);
    copy.holds.store(number, std::memory_order_release);
    newest_.store(number, std::memory_order_release);
  }

  bool empty() const noexcept { return newest_.load(std::memory_order_acquire) == kNone; }

  // Readers. Calls take(index, word) for each word; the words are valid only if the result is Found.
  template <class Take>
  Looked read(Take take) const noexcept {
    for (int tries = 0; tries < kTries; ++tries) {
      const uint64_t number = newest_.load(std::memory_order_acquire);
      if (number == kNone) return Looked::Empty;
      const Copy& copy = copies_[number % kCopies];
      if (copy.holds.load(std::memory_order_acquire) != number) continue;
      for (size_t i = 0; i < words_; ++i) take(i, copy.words[i].load(std::memory_order_relaxed));
      std::atomic_thread_fence(std::memory_order_acquire);
      if (copy.holds.load(std::memory_order_relaxed) == number) return Looked::Found;
    }
    return Looked::Interrupted;
  }

private:
  static constexpr uint64_t kNone = 0; // values are numbered from 1
  static constexpr uint32_t kCopies = 4;
  static constexpr int kTries = 3;
  struct Copy {
    std::atomic<uint64_t> holds{kNone}; // the number of the value in it; kNone while it is being written
    std::vector<std::atomic<uint64_t>> words;
  };
  size_t words_;
  std::array<Copy, kCopies> copies_;
  std::atomic<uint64_t> newest_{kNone};
};

class PublishedText {
public:
  static constexpr size_t kMost = 512;

  // Writer. Characters beyond kMost are cut off.
  void set(std::string_view text) noexcept {
    std::array<uint64_t, kWords> words{};
    words[0] = std::min(text.size(), kMost);
    std::memcpy(&words[1], text.data(), words[0]);
    published_.publish(words);
  }

  // Readers. Returns the number of characters written to `to`; 0 if no text was set, or it was set again during every
  // attempt.
  size_t read(std::span<char> to) const noexcept {
    std::array<uint64_t, kWords> words{};
    if (published_.read([&](size_t i, uint64_t word) { words[i] = word; }) != Looked::Found) return 0;
    const size_t size = std::min<size_t>(words[0], to.size());
    std::memcpy(to.data(), &words[1], size);
    return size;
  }

private:
  static constexpr size_t kWords = 1 + kMost / sizeof(uint64_t);
  Published published_{kWords};
};

// ---- commands and ends -------------------------------------------------------------------------------------------

// A command to the scan thread, with room for its result. One thread at a time posts a command, polls until it is done
// or withdraws it, uses the result, and releases the slot.
template <class Command>
class Slot {
public:
  // Posting thread. The slot must be free.
  void post(const Command& command) {
    assert(state_.load(std::memory_order_relaxed) == kFree);
    command_ = command;
    state_.store(kPosted, std::memory_order_release);
  }
  bool isDone() const noexcept { return state_.load(std::memory_order_acquire) == kDone; }
  // Posting thread. True: the command was not executed, and will not be. False: it was executed.
  bool withdraw() noexcept {
    for (int expected = kPosted; !state_.compare_exchange_weak(expected, kFree, std::memory_order_acquire);
         expected = kPosted) {
      if (expected == kDone) return false;
      std::this_thread::yield(); // the scan thread is executing it, which takes a bounded time
    }
    return true;
  }
  // Posting thread, once the command is done or withdrawn: the command with its result, or with that of the last
  // attempt.
  const Command& command() const noexcept { return command_; }
  void release() noexcept { state_.store(kFree, std::memory_order_release); }

  // Scan thread. Calls execute(command) if a command is posted; if that returns false, the next `take` tries again.
  template <class Execute>
  void take(Execute execute) noexcept {
    int expected = kPosted;
    if (!state_.compare_exchange_strong(expected, kTaken, std::memory_order_acquire)) return;
    state_.store(execute(command_) ? kDone : kPosted, std::memory_order_release);
  }

private:
  static constexpr int kFree = 0, kPosted = 1, kTaken = 2, kDone = 3;
  std::atomic<int> state_{kFree};
  Command command_{};
};

// Keeps an object alive while the scan thread uses it and another thread wants to end it. The other thread first
// removes the pointer by which the scan thread finds the object, and then waits until the scan thread has left. The
// scan thread enters before it loads the pointer. Both are sequentially consistent, so at least one of the two threads
// sees the other.
class ScanUse {
public:
  // Scan thread. An exchange, and a fence in wait, where a store and a load would do: processor emulators reorder a
  // load before an earlier store, which the processors themselves do not.
  void enter() noexcept { inside_.exchange(true); }
  void leave() noexcept { inside_.store(false); }
  // The other thread: waits until the scan thread is outside.
  void wait() const noexcept {
    std::atomic_thread_fence(std::memory_order_seq_cst);
    while (inside_.load()) std::this_thread::yield();
  }

private:
  std::atomic<bool> inside_{false};
};

// ---- memory of a host --------------------------------------------------------------------------------------------

// Memory whose writer increments the counter `head` before each change and the counter `tail` after it. Both counters
// are aligned and have 1, 2, 4 or 8 bytes.
class GuardedMemory {
public:
  using Range = std::pair<uint32_t, uint32_t>; // offset, bytes

  GuardedMemory(const uint8_t* address, uint32_t head, uint32_t tail, uint32_t counterBytes) noexcept
      : address_(address), head_(address + head), tail_(address + tail), counterBytes_(counterBytes) {}

  // Reader: copies the ranges to the same offsets of `to`. False: they changed during every attempt, and `to` is
  // invalid.
  bool copy(std::span<const Range> ranges, uint8_t* to, int tries) const noexcept {
    while (tries-- > 0)
      if (copyOnce(ranges, to)) return true;
    return false;
  }

private:
  // The writer increments `head` first and `tail` last, so the reader loads `tail` first and `head` last.
  bool copyOnce(std::span<const Range> ranges, uint8_t* to) const noexcept {
    const uint64_t tail = counter(tail_);
    for (const auto& [offset, bytes] : ranges) copyShared(address_ + offset, to + offset, bytes);
    __atomic_thread_fence(__ATOMIC_ACQUIRE);
    return counter(head_) == tail;
  }
  uint64_t counter(const uint8_t* at) const noexcept {
    switch (counterBytes_) {
    case 1: return __atomic_load_n(at, __ATOMIC_ACQUIRE);
    case 2: return __atomic_load_n(reinterpret_cast<const uint16_t*>(at), __ATOMIC_ACQUIRE);
    case 4: return __atomic_load_n(reinterpret_cast<const uint32_t*>(at), __ATOMIC_ACQUIRE);
    default: return __atomic_load_n(reinterpret_cast<const uint64_t*>(at), __ATOMIC_ACQUIRE);
    }
  }
  // Loads each word once, atomically.
  static void copyShared(const uint8_t* from, uint8_t* to, uint32_t bytes) noexcept {
    while (bytes != 0) {
      if (bytes >= 8 && reinterpret_cast<uintptr_t>(from) % 8 == 0) {
        const uint64_t word = __atomic_load_n(reinterpret_cast<const uint64_t*>(from), __ATOMIC_RELAXED);
        std::memcpy(to, &word, sizeof word);
        from += 8, to += 8, bytes -= 8;
      } else {
        *to++ = __atomic_load_n(from++, __ATOMIC_RELAXED);
        --bytes;
      }
    }
  }

  const uint8_t *address_, *head_, *tail_;
  uint32_t counterBytes_;
};

} // namespace rung::core
