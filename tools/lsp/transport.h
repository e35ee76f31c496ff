// Messages of JSON-RPC between an editor and the server, each after a header with its length, on two file descriptors.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace rung::lsp {

class Transport {
public:
  // The descriptors stay open, and stay the caller's.
  Transport(int in, int out) : in_(in), out_(out) {}

  // The next message; waits for it. Nothing at the end of the input, or after a header that says no length, or one
  // beyond kMostBytes: what follows could not be found.
  std::optional<std::string> read();
  // Whether read() would not wait, as far as is known.
  bool hasInput() const;
  // False if the other end is closed.
  bool write(std::string_view message) const;

  static constexpr size_t kMostBytes = size_t{64} << 20;

private:
  bool fill();
  std::optional<size_t> header();

  int in_;
  int out_;
  std::string buffer_;
};

} // namespace rung::lsp
