// The state of objects as bytes. A class names the fields of its state once, and both directions follow from that:
//
//   template <class Archive> void state(Archive& archive) { archive(count_, motion_, waiting_); }
//
// Fields are numbers, enumerations, classes with a `state`, and arrays, vectors, maps, texts, pairs and optionals of
// these. A number that selects an element is named with its highest value: archive.atMost(next_, kLast), which also is
// how a size_t is saved. Bytes mean the same on every little-endian machine. Saving allocates nothing; loading may.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rung::core {

static_assert(std::endian::native == std::endian::little, "archives are little-endian");

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// Writes to memory of the caller. Bytes that do not fit are counted, but not written.
class Saver {
public:
  static constexpr bool kLoads = false;
  explicit Saver(std::span<uint8_t> to) noexcept : to_(to) {}

  size_t size() const noexcept { return size_; } // of everything saved so far
  bool fits() const noexcept { return size_ <= to_.size(); }

  template <class... Fields>
  void operator()(const Fields&... fields) noexcept {
    (save(fields), ...);
  }
  template <Number T>
  void atMost(const T& value, uint64_t most) noexcept {
    (void)most;
    save(static_cast<uint64_t>(value));
  }
  void require(bool holds) noexcept { (void)holds; }
  // A list whose length follows from the configuration.
  template <class List>
  void each(const List& all) noexcept {
    save(uint64_t{all.size()});
    for (const auto& one : all) save(one);
  }
  void bytes(std::span<const uint8_t> from) noexcept {
    if (!from.empty() && size_ <= to_.size() && from.size() <= to_.size() - size_)
      std::memcpy(to_.data() + size_, from.data(), from.size());
    size_ += from.size();
  }

private:
  template <Number T>
  void save(const T& value) noexcept {
    if (size_ + sizeof value <= to_.size()) std::memcpy(to_.data() + size_, &value, sizeof value);
    size_ += sizeof value;
  }
  template <class T>
  void save(const T& object) noexcept
    requires requires(T& of, Saver& saver) { of.state(saver); }
  {
    const_cast<T&>(object).state(*this); // which only reads it
  }
  template <class T, size_t N>
  void save(const std::array<T, N>& all) noexcept {
    for (const T& each : all) save(each);
  }
  template <class T, size_t N>
  void save(const T (&all)[N]) noexcept {
    for (const T& each : all) save(each);
  }
  template <class T>
  void save(const std::vector<T>& all) noexcept {
    save(uint64_t{all.size()});
    for (const T& each : all) save(each);
  }
  template <class Key, class T, class... Rest>
  void save(const std::map<Key, T, Rest...>& all) noexcept {
    save(uint64_t{all.size()});
    for (const auto& each : all) save(each);
  }
  void save(const std::string& text) noexcept {
    save(uint64_t{text.size()});
    bytes({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  }
  template <class A, class B>
  void save(const std::pair<A, B>& both) noexcept {
    save(both.first), save(both.second);
  }
  template <class T>
  void save(const std::optional<T>& value) noexcept {
    save(value.has_value());
    if (value) save(*value);
  }

  std::span<uint8_t> to_;
  size_t size_ = 0;
};

// Reads what a Saver has written. After the first value that is cut off or impossible all further ones keep what they
// are, and `good` is false.
class Loader {
public:
  static constexpr bool kLoads = true;
  explicit Loader(std::span<const uint8_t> from) noexcept : from_(from) {}

  bool good() const noexcept { return good_; }
  void fail() noexcept { good_ = false; }
  size_t left() const noexcept { return from_.size(); }

  template <class... Fields>
  void operator()(Fields&... fields) {
    (load(fields), ...);
  }
  template <Number T>
  void atMost(T& value, uint64_t most) noexcept {
    uint64_t loaded = 0;
    load(loaded);
    if (loaded > most) good_ = false;
    if (good_) value = static_cast<T>(loaded);
  }
  // What must hold for the fields that have just been loaded.
  void require(bool holds) noexcept { good_ = good_ && holds; }
  template <class List>
  void each(List& all) {
    uint64_t count = 0;
    load(count);
    require(count == all.size());
    for (auto& one : all) load(one);
  }
  void bytes(std::span<uint8_t> to) noexcept {
    if (to.size() > from_.size()) good_ = false;
    if (!good_ || to.empty()) return;
    std::memcpy(to.data(), from_.data(), to.size());
    from_ = from_.subspan(to.size());
  }

private:
  template <Number T>
  void load(T& value) noexcept {
    bytes({reinterpret_cast<uint8_t*>(&value), sizeof value});
  }
  void load(bool& value) noexcept {
    uint8_t byte = value ? 1 : 0;
    load(byte);
    if (byte > 1) good_ = false;
    if (good_) value = byte != 0;
  }
  template <class T>
  void load(T& object)
    requires requires(T& of, Loader& loader) { of.state(loader); }
  {
    object.state(*this);
  }
  template <class T, size_t N>
  void load(std::array<T, N>& all) {
    for (T& each : all) load(each);
  }
  template <class T, size_t N>
  void load(T (&all)[N]) {
    for (T& each : all) load(each);
  }
  template <class T>
  void load(std::vector<T>& all) {
    if (const std::optional<size_t> count = loadCount()) all.assign(*count, T{});
    for (size_t i = 0; good_ && i < all.size(); ++i) load(all[i]);
  }
  template <class Key, class T, class... Rest>
  void load(std::map<Key, T, Rest...>& all) {
    const size_t count = loadCount().value_or(0);
    if (good_) all.clear();
    for (size_t i = 0; good_ && i < count; ++i) {
      std::pair<Key, T> each;
      load(each);
      all.insert(std::move(each));
    }
  }
  void load(std::string& text) {
    if (const std::optional<size_t> count = loadCount()) text.resize(*count);
    bytes({reinterpret_cast<uint8_t*>(text.data()), good_ ? text.size() : 0});
  }
  template <class A, class B>
  void load(std::pair<A, B>& both) {
    load(both.first), load(both.second);
  }
  template <class T>
  void load(std::optional<T>& value) {
    bool has = false;
    load(has);
    if (!good_) return;
    value = has ? std::optional<T>(T{}) : std::nullopt;
    if (has) load(*value);
  }
  // Nothing if there cannot be so many elements, each of which has at least a byte.
  std::optional<size_t> loadCount() noexcept {
    uint64_t count = 0;
    load(count);
    if (count > from_.size()) good_ = false;
    return good_ ? std::optional<size_t>(count) : std::nullopt;
  }

  std::span<const uint8_t> from_;
  bool good_ = true;
};

} // namespace rung::core
