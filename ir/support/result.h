// Result<T>: a value, or an error of the environment (files, libraries, limits) as a text. Mistakes in a user's program
// are not a Result; they go to Diagnostics.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "ir/support/check.h"

namespace rung {

/// The error side of every Result; converts to Result<T> for any T.
struct Failure {
  std::string message;
};

inline Failure failure(std::string message) { return Failure{std::move(message)}; }

template <typename T>
class [[nodiscard]] Result {
public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}       // NOLINT(google-explicit-constructor)
  Result(Failure error) : state_(std::in_place_index<1>, std::move(error)) {} // NOLINT(google-explicit-constructor)

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & {
    RUNG_CHECK(ok(), "value() of a failed Result");
    return std::get<0>(state_);
  }
  const T& value() const& {
    RUNG_CHECK(ok(), "value() of a failed Result");
    return std::get<0>(state_);
  }
  T&& value() && {
    RUNG_CHECK(ok(), "value() of a failed Result");
    return std::get<0>(std::move(state_));
  }
  const std::string& error() const {
    RUNG_CHECK(!ok(), "error() of a good Result");
    return std::get<1>(state_).message;
  }
  /// The error, for return as another Result: `if (!r) return r.failure();`
  Failure failure() const { return Failure{error()}; }

private:
  std::variant<T, Failure> state_;
};

/// Success without a value: `return {};`, or a failure.
template <>
class [[nodiscard]] Result<void> {
public:
  Result() = default;
  Result(Failure error) : state_(std::in_place_index<1>, std::move(error)) {} // NOLINT(google-explicit-constructor)

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  const std::string& error() const {
    RUNG_CHECK(!ok(), "error() of a good Result");
    return std::get<1>(state_).message;
  }
  Failure failure() const { return Failure{error()}; }

private:
  std::variant<std::monostate, Failure> state_;
};

// Turns failed checks in the compiler into a Result.

/// The Result of `body`; if a RUNG_CHECK fails in it, a failure with its text instead of the end of the process.
template <class Body>
auto contained(Body body) -> decltype(body()) {
  try {
    const ThrowingChecks throwing;
    return body();
  } catch (const std::logic_error& error) {
    return failure(error.what());
  }
}

} // namespace rung
