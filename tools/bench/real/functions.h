// Functions of the PMC as straight.py writes them into straight-line C++. Written from the specification alone.
#pragma once
#include <cstdint>
#include <cstring>
#include <initializer_list>

constexpr uint32_t kSlotMs = 8;

template <int n>
struct Of;
template <>
struct Of<1> {
  using S = int8_t;
  using U = uint8_t;
};
template <>
struct Of<2> {
  using S = int16_t;
  using U = uint16_t;
};
template <>
struct Of<4> {
  using S = int32_t;
  using U = uint32_t;
};
template <int n>
static inline int64_t load(const uint8_t* p) {
  typename Of<n>::S v;
  std::memcpy(&v, p, n);
  return v;
}
template <int n>
static inline uint32_t loadU(const uint8_t* p) {
  typename Of<n>::U v;
  std::memcpy(&v, p, n);
  return v;
}
template <int n>
static inline void store(uint8_t* p, int64_t x) {
  const auto v = static_cast<typename Of<n>::U>(x);
  std::memcpy(p, &v, n);
}
static inline bool at(const uint8_t& byte, int bit) { return byte >> bit & 1; }
static inline void to(uint8_t& byte, int bit, bool v) { byte = static_cast<uint8_t>((byte & ~(1 << bit)) | v << bit); }
template <int n>
static inline void flags(uint8_t& r, int64_t exact) {
  const int64_t kept = static_cast<typename Of<n>::S>(exact);
  r = static_cast<uint8_t>((r & ~0x23) | (kept == 0) | (kept < 0) << 1 | (kept != exact) << 5);
}
struct Counter {
  bool before, w;
};
static inline bool count(Counter& c, bool cn0, bool down, bool reset, bool act, unsigned preset, uint8_t* value) {
  const unsigned first = cn0, v = loadU<2>(value);
  if (reset) {
    store<2>(value, down ? preset : first);
    c.w = false;
  } else if (act && !c.before) {
    unsigned next;
    if (down)
      next = v <= first ? preset : v - 1;
    else
      next = v >= preset ? first : v + 1;
    store<2>(value, next);
    c.w = next == (down ? first : preset);
  }
  c.before = act;
  return c.w;
}
struct Timer {
  bool on;
  uint32_t ms;
};
static inline bool onDelay(Timer& t, bool act, uint32_t presetMs) {
  t.ms = act && t.on ? t.ms + kSlotMs : 0;
  t.on = act;
  return act && t.ms >= presetMs;
}
static inline bool offDelay(Timer& t, bool act, uint32_t presetMs) {
  if (act)
    t = {true, 0u - kSlotMs}; // the first scan with ACT=0 is 0 ms after its beginning
  else if (t.on)
    t.ms += kSlotMs, t.on = t.ms < presetMs;
  return t.on;
}
static inline bool toDecimal(uint8_t* to, int bytes, int64_t value, uint8_t& r) {
  uint64_t rest = value < 0 ? static_cast<uint64_t>(-value) : static_cast<uint64_t>(value), digits = 0;
  for (int i = 0; i < 2 * bytes; ++i, rest /= 10) digits |= rest % 10 << 4 * i;
  r = static_cast<uint8_t>((r & ~0x22) | (value < 0) << 1 | (rest != 0) << 5);
  if (rest == 0) std::memcpy(to, &digits, static_cast<size_t>(bytes));
  return rest != 0;
}
static inline bool fromDecimal(uint8_t* to, int bytes, uint32_t digits, bool negative) {
  int64_t value = 0;
  for (int i = 2 * bytes - 1; i >= 0; --i) {
    if ((digits >> 4 * i & 15) > 9) return true;
    value = value * 10 + (digits >> 4 * i & 15);
  }
  if (value > (int64_t{1} << (8 * bytes - 1)) - 1) return true;
  value = negative ? -value : value;
  std::memcpy(to, &value, static_cast<size_t>(bytes));
  return false;
}

// Requests to the CNC stay unanswered: a low-speed function waits, any other ends as if the CNC did not have it.

enum : unsigned { kNoFunction = 1, kBadData = 2, kMostData = 64 };
enum class Request : uint8_t { None, Waits, Done, Abandoned };
static bool requestWaits; // of all low-speed functions one waits
static inline bool isIn(unsigned code, const std::initializer_list<unsigned>& codes) {
  for (const unsigned each : codes)
    if (each == code) return true;
  return false;
}
static bool window(Request& state, bool act, uint8_t* block, bool writes, uint8_t& r) {
  if (state == Request::Done) {
    if (!act) state = Request::None, requestWaits = false;
    return act;
  }
  if (state == Request::Waits && !act) state = Request::Abandoned;
  if (state != Request::None || !act) return false;
  const unsigned code = loadU<2>(block) % 1000, length = loadU<2>(block + 4);
  const bool isLow = writes || isIn(code, {13, 15, 17, 19, 21, 33, 45, 59, 151});
  const bool isKnown = writes ? isIn(code, {14, 16, 18, 20, 22, 60, 150, 152, 367})
                              : isLow || isIn(code, {0, 23, 24, 25, 26, 27, 28, 29, 32, 34, 50, 74, 75, 153, 154, 207});
  if (isLow && requestWaits) return false;
  requestWaits |= isLow;
  const bool isGood = isKnown && (!writes || (length >= 1 && length <= kMostData));
  state = !isLow ? Request::None : isGood ? Request::Waits : Request::Done;
  if (isLow && isGood) return false;
  store<2>(block + 2, isKnown ? kBadData : kNoFunction);
  r |= 1;
  return true;
}
enum class Axis : uint8_t { Idle, Sent, Done };
// `g` and `f` are the group's first bytes.
static bool axis(Axis& state, bool reset, bool act, const uint8_t* data, uint8_t* g, const uint8_t* f, uint8_t& r) {
  to(*g, 6, reset);
  const bool isReady = at(*g, 7) == at(*f, 7);
  if (reset) return state = Axis::Idle, false;
  if (state == Axis::Idle) {
    if (!act) return false;
    if (!isIn(data[1] & 0x7Fu, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 16, 18, 20, 21, 32})) {
      r |= 1;
      return state = Axis::Done, true;
    }
    if (!isReady) return false;
    std::memcpy(g + 1, data + 1, 7);
    *g ^= 0x80;
    r &= 0xFE;
    return state = Axis::Sent, false;
  }
  const bool out = state == Axis::Sent ? isReady : act;
  if (out)
    state = Axis::Done;
  else if (state == Axis::Done)
    state = Axis::Idle;
  return out;
}
static inline uint32_t unitMs(uint32_t code, uint32_t usual) {
  constexpr uint32_t kMs[] = {0, 1, 10, 100, 1000, 60000};
  return code >= 1 && code <= 5 ? kMs[code] : usual;
}
