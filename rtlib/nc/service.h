// The services that programs of a dialect request from their NC and their control, as tables with a row for each
// service. The compiler puts the text of a row into a program's table; the loader finds the row by that text, and from
// then on the service is identified by the number of its row. If arguments or results change, it is a different
// service.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>

#include "rung/program.h"

namespace rung::nc {

// Each value is passed as 64 bits. Text, Bytes: an argument refers to bytes of the program's memory, a result is the
// number of bytes in the answer.
enum class ServiceForm : uint8_t { Integer, Real, Text, Bytes };

struct ServiceValue {
  std::string_view name;
  ServiceForm form = ServiceForm::Integer;
};

// The arguments or the results of a service, in order, from words separated by blanks: a name with the suffix ":f" is a
// real, with ":s" a text, with ":b" bytes.
class ServiceValues {
public:
  constexpr explicit ServiceValues(std::string_view words) : words_(words) {
    for (size_t at = 0; at < words.size() && count_ < places_.size();) {
      const size_t end = words.find(' ', at) == std::string_view::npos ? words.size() : words.find(' ', at);
      if (end != at) places_[count_++] = placeOf(at, words.substr(at, end - at));
      at = end + 1;
    }
  }

  constexpr uint32_t count() const { return count_; }
  constexpr ServiceValue operator[](uint32_t number) const {
    const Place& place = places_[number];
    return {words_.substr(place.first, place.size), place.form};
  }
  // The index of a name, as written in the table.
  constexpr std::optional<uint32_t> find(std::string_view name) const {
    for (uint32_t i = 0; i < count_; ++i)
      if ((*this)[i].name == name) return i;
    return std::nullopt;
  }

private:
  struct Place {
    uint16_t first = 0, size = 0;
    ServiceForm form = ServiceForm::Integer;
  };
  static constexpr Place placeOf(size_t first, std::string_view word) {
    const ServiceForm form = word.ends_with(":f")   ? ServiceForm::Real
                             : word.ends_with(":s") ? ServiceForm::Text
                             : word.ends_with(":b") ? ServiceForm::Bytes
                                                    : ServiceForm::Integer;
    const size_t size = form == ServiceForm::Integer ? word.size() : word.size() - 2;
    return {static_cast<uint16_t>(first), static_cast<uint16_t>(size), form};
  }

  std::string_view words_;
  std::array<Place, RUNG_MAX_SERVICE_ARGS> places_{};
  uint32_t count_ = 0;
};

struct ServiceRow {
  // `signature` is "NAME arguments -> results", as in rung_program::services; without "->" the program takes no answer.
  // `of` is an enumerator of the dialect's ServiceKind, from 1.
  template <class Kind>
  constexpr ServiceRow(Kind of, const char* signature)
      : kind(static_cast<uint32_t>(of)), text(signature), name(before(text, " ")),
        takesAnswer(text.find(kArrow) != std::string_view::npos), arguments(after(before(text, kArrow), " ")),
        results(after(text, kArrow)) {}

  uint32_t kind;
  std::string_view text; // null-terminated
  std::string_view name;
  bool takesAnswer;
  ServiceValues arguments, results;

private:
  static constexpr std::string_view kArrow = "->";
  static constexpr std::string_view before(std::string_view text, std::string_view mark) {
    return text.substr(0, text.find(mark));
  }
  static constexpr std::string_view after(std::string_view text, std::string_view mark) {
    const size_t at = text.find(mark);
    return at == std::string_view::npos ? std::string_view() : text.substr(at + mark.size());
  }
};

inline constexpr uint32_t kUnknownService = 0; // as a kind

// Whether the rows are in the order of their kinds, and their texts are distinct. `rowOf` returns the row of an item of
// the table.
template <class Items, class RowOf = std::identity>
constexpr bool isServiceTable(const Items& items, RowOf rowOf = {}) {
  for (size_t i = 0; i < std::size(items); ++i) {
    if (std::invoke(rowOf, items[i]).kind != i + 1) return false;
    for (size_t k = 0; k < i; ++k)
      if (std::invoke(rowOf, items[k]).text == std::invoke(rowOf, items[i]).text) return false;
  }
  return true;
}

// By rung_program::dialect; null if it has no such kind.
const ServiceRow* serviceOf(std::string_view dialect, uint32_t kind);
// Whether any service of the dialect uses a device of the control.
bool hasDevices(std::string_view dialect);
// The kind of a service by its text in a program's table; kUnknownService if no row has this text.
uint32_t serviceKind(std::string_view dialect, std::string_view text);

} // namespace rung::nc
