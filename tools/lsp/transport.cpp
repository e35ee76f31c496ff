// See transport.h.
#include "tools/lsp/transport.h"

#include <algorithm>
#include <cerrno>
#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::lsp {
namespace {

constexpr size_t kMostHeader = 4096;
constexpr std::string_view kEndOfHeader = "\r\n\r\n";

// From the lines of a header; other fields are ignored.
std::optional<size_t> lengthIn(std::string_view header) {
  std::optional<size_t> length;
  while (!header.empty()) {
    const size_t end = std::min(header.find("\r\n"), header.size());
    const std::string_view line = header.substr(0, end);
    header.remove_prefix(std::min(end + 2, header.size()));
    const size_t colon = line.find(':');
    if (colon == std::string_view::npos || !text::equalsIgnoringCase(line.substr(0, colon), "Content-Length")) continue;
    length = text::numberIn<size_t>(text::trimmed(line.substr(colon + 1)));
    if (!length || *length > Transport::kMostBytes) return std::nullopt;
  }
  return length;
}

} // namespace

bool Transport::fill() {
  char bytes[65536];
  ssize_t got = 0;
  do got = ::read(in_, bytes, sizeof bytes);
  while (got < 0 && errno == EINTR);
  if (got <= 0) return false;
  buffer_.append(bytes, static_cast<size_t>(got));
  return true;
}

std::optional<size_t> Transport::header() {
  size_t end = std::string::npos;
  while ((end = buffer_.find(kEndOfHeader)) == std::string::npos)
    if (buffer_.size() > kMostHeader || !fill()) return std::nullopt;
  const std::optional<size_t> length = lengthIn(std::string_view(buffer_).substr(0, end));
  buffer_.erase(0, end + kEndOfHeader.size());
  return length;
}

std::optional<std::string> Transport::read() {
  const std::optional<size_t> length = header();
  if (!length) return std::nullopt;
  while (buffer_.size() < *length)
    if (!fill()) return std::nullopt;
  std::string message = buffer_.substr(0, *length);
  buffer_.erase(0, *length);
  return message;
}

bool Transport::hasInput() const {
  pollfd waits{.fd = in_, .events = POLLIN, .revents = 0};
  return !buffer_.empty() || ::poll(&waits, 1, 0) > 0;
}

bool Transport::write(std::string_view message) const {
  std::string framed = fmt::format("Content-Length: {}\r\n\r\n{}", message.size(), message);
  for (std::string_view rest = framed; !rest.empty();) {
    const ssize_t wrote = ::write(out_, rest.data(), rest.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    rest.remove_prefix(static_cast<size_t>(wrote));
  }
  return true;
}

} // namespace rung::lsp
