// A line on the terminal about work that takes long (see progress.h).
#include "tools/scenario/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace rung::scenario {
namespace {

constexpr double kQuietSeconds = 2;
constexpr double kPauseSeconds = 0.1; // more often nobody can read
constexpr size_t kUsualWidth = 80;

size_t widthOf(int terminal) {
  winsize size{};
  return ioctl(terminal, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsualWidth;
}

} // namespace

Progress::Progress(FILE* out)
    : out_(out), terminal_(isatty(fileno(out)) != 0), start_(std::chrono::steady_clock::now()) {}

void Progress::begin() {
  clear();
  start_ = std::chrono::steady_clock::now();
  last_ = 0;
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::show(std::string_view text) {
  if (!terminal_) return;
  const double now = seconds();
  if (now < kQuietSeconds || now < last_ + kPauseSeconds) return;
  last_ = now;
  // One that is cut to the terminal's width stays one line and can be erased.
  fmt::print(out_, "\r\033[K{}", text.substr(0, widthOf(fileno(out_)) - 1));
  std::fflush(out_);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  fmt::print(out_, "\r\033[K");
  std::fflush(out_);
  shown_ = false;
}

} // namespace rung::scenario
