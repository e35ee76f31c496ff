// A bounded queue within one thread.
#pragma once
#include <array>
#include <cstdint>

namespace rung::io {

template <class Item, uint32_t N>
class BoundedQueue {
public:
  bool isFull() const { return count_ == N; }
  uint32_t size() const { return count_; }
  void clear() { count_ = 0; }

  // False: full, the item is not taken.
  bool push(const Item& item) {
    if (isFull()) return false;
    items_[(first_ + count_++) % N] = item;
    return true;
  }
  // The oldest one makes room for it.
  void pushAnyway(const Item& item) {
    Item oldest;
    if (isFull()) pop(oldest);
    push(item);
  }
  bool peek(Item& item) const {
    if (count_ > 0) item = items_[first_];
    return count_ > 0;
  }
  bool pop(Item& item) {
    if (!peek(item)) return false;
    first_ = (first_ + 1) % N;
    --count_;
    return true;
  }

private:
  std::array<Item, N> items_{};
  uint32_t first_ = 0, count_ = 0;
};

} // namespace rung::io
