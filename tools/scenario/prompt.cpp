// The prompt's loop.
#include "tools/scenario/prompt.h"

#include <fmt/format.h>
#include <histedit.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <clocale>
#include <cstdio>
#include <cwchar>
#include <iostream>
#include <optional>
#include <utility>

#include "rtlib/text/utf8.h"
#include "tools/scenario/console.h"

namespace rung::scenario {

namespace {

bool ends(Signal& signal) { return signal != 0 && signal != SIGINT; }

void runTerminal(Interpreter& console, Signal& signal, const std::function<void()>& begins) {
  LineEditor editor([&](std::string_view line) { return console.completions(line); }, signal);
  std::cout << console.greeting() << std::endl;
  while (!ends(signal)) {
    const std::optional<std::string> line = editor.read(console.prompt());
    if (!line) std::cout << std::endl; // puts the shell's prompt on a new line
    if (!line || ends(signal)) return;
    begins();
    if (console.execute(*line) == Outcome::Quit) return;
    if (signal != SIGINT) continue;
    signal = 0;
    std::cout << "interrupted" << std::endl;
  }
}

} // namespace

bool runPrompt(Interpreter& console, Signal& signal, const std::function<void()>& begins) {
  if (isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0) {
    runTerminal(console, signal, begins);
    return true;
  }
  bool passed = true;
  for (std::string line; signal == 0 && std::getline(std::cin, line);) {
    begins();
    const Outcome outcome = console.execute(line);
    if (outcome == Outcome::Quit) break;
    passed = passed && outcome != Outcome::Failed;
  }
  return passed;
}

// A line on the terminal about long work.

namespace {

constexpr double kQuietSeconds = 2;
constexpr double kPauseSeconds = 0.1; // faster updates cannot be read
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
  // Shortened to the terminal's width, it stays one line and can be erased.
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

// Work with a progress line.

Working::Working(std::string what) : what_(std::move(what)) {
  if (isatty(STDERR_FILENO) != 0) thread_ = std::thread([this] { show(); });
}

Working::~Working() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ends_.notify_one();
  thread_.join();
}

void Working::say(std::string what) {
  const std::lock_guard lock(mutex_);
  what_ = std::move(what);
}

void Working::show() {
  constexpr auto kPause = std::chrono::milliseconds(500);
  Progress progress(stderr);
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, kPause, [this] { return ended_; }))
    progress.show(fmt::format("{}, {:.0f} s", what_, progress.seconds()));
}

// Line editing with libedit.

namespace {

constexpr int kHistory = 1000;      // number of lines
constexpr size_t kMostListed = 200; // most completions
constexpr wchar_t kControlC = 3;
constexpr size_t kGap = 2; // between two columns

size_t characters(std::string_view utf8) {
  return static_cast<size_t>(std::ranges::count_if(utf8, [](char c) { return !text::isUtf8Continuation(c); }));
}

// In columns, as a shell lists files.
std::string inColumns(const std::vector<std::string>& words) {
  size_t widest = 0;
  const size_t shown = std::min(words.size(), kMostListed);
  for (size_t i = 0; i < shown; ++i) widest = std::max(widest, characters(words[i]));
  const size_t columns = std::max<size_t>(1, kUsualWidth / (widest + kGap));
  const size_t lines = (shown + columns - 1) / columns;
  std::string text;
  for (size_t line = 0; line < lines; ++line) {
    for (size_t i = line; i < shown; i += lines) {
      text += words[i];
      if (i + lines < shown) text.append(widest + kGap - characters(words[i]), ' ');
    }
    text += '\n';
  }
  if (shown < words.size()) text += "and " + std::to_string(words.size() - shown) + " more\n";
  return text;
}

} // namespace

struct LineEditor::State {
  State(Complete completion, Signal& stop) : complete(std::move(completion)), signal(stop) {}

  Complete complete;
  Signal& signal;
  EditLine* edit = nullptr;
  History* history = nullptr;
  std::string prompt;
  bool givenUp = false;

  static State& of(EditLine* edit) {
    void* state = nullptr;
    el_get(edit, EL_CLIENTDATA, &state);
    return *static_cast<State*>(state);
  }
  static char* showPrompt(EditLine* edit) { return of(edit).prompt.data(); }

  // Waits for input or a signal; a signal that arrives before the wait is not missed.
  static void waitForInput(const Signal& signal) {
    sigset_t both;
    sigset_t before;
    sigemptyset(&both);
    sigaddset(&both, SIGINT);
    sigaddset(&both, SIGTERM);
    sigprocmask(SIG_BLOCK, &both, &before);
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (signal == 0) ppoll(&input, 1, nullptr, &before);
    sigprocmask(SIG_SETMASK, &before, nullptr);
  }

  // Reads a character of UTF-8. libedit's own function would not return at a signal. Until the terminal is in libedit's
  // mode, Ctrl-C is a signal, too.
  static int readCharacter(EditLine* edit, wchar_t* character) {
    Signal& signal = of(edit).signal;
    std::mbstate_t state{};
    for (;;) {
      waitForInput(signal);
      if (signal == SIGINT) {
        signal = 0;
        *character = kControlC;
        return 1;
      }
      if (signal != 0) return 0;
      char byte = 0;
      const ssize_t count = ::read(STDIN_FILENO, &byte, 1);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return 0;
      size_t used = std::mbrtowc(character, &byte, 1, &state);
      if (used == static_cast<size_t>(-1)) { // invalid UTF-8 so far, dropped; this byte may begin a character
        state = {};
        used = std::mbrtowc(character, &byte, 1, &state);
      }
      if (used <= 1) return 1;
      if (used == static_cast<size_t>(-1)) state = {};
    }
  }

  static unsigned char giveUp(EditLine* edit, int) {
    of(edit).givenUp = true;
    return ::write(STDOUT_FILENO, "^C\n", 3) < 0 ? CC_ERROR : CC_NEWLINE;
  }

  static unsigned char completeWord(EditLine* edit, int) {
    const LineInfo* info = el_line(edit);
    const std::string_view line(info->buffer, static_cast<size_t>(info->cursor - info->buffer));
    const std::string_view word = line.substr(line.find_last_of(" \t") + 1);
    const std::vector<std::string> found = of(edit).complete(line);
    if (found.empty()) return CC_REFRESH_BEEP;
    std::string becomes = commonStart(found);
    if (found.size() == 1 && !becomes.ends_with('/')) becomes += ' ';
    if (becomes.size() > word.size() || (found.size() == 1 && becomes != word)) {
      el_deletestr(edit, static_cast<int>(characters(word)));
      el_insertstr(edit, becomes.c_str());
      return CC_REFRESH;
    }
    const std::string list = "\n" + inColumns(found);
    if (::write(STDOUT_FILENO, list.data(), list.size()) < 0) return CC_ERROR;
    return CC_REDISPLAY;
  }
};

LineEditor::LineEditor(Complete complete, Signal& signal)
    : state_(std::make_unique<State>(std::move(complete), signal)) {
  std::setlocale(LC_CTYPE, "C.UTF-8"); // sources and names are UTF-8 whatever the user's locale
  state_->edit = el_init("rungc", stdin, stdout, stderr);
  state_->history = history_init();
  EditLine* edit = state_->edit;
  HistEvent event;
  history(state_->history, &event, H_SETSIZE, kHistory);
  history(state_->history, &event, H_SETUNIQUE, 1);
  el_set(edit, EL_CLIENTDATA, state_.get());
  el_set(edit, EL_EDITOR, "emacs");
  el_set(edit, EL_HIST, history, state_->history);
  el_set(edit, EL_PROMPT, &State::showPrompt);
  el_set(edit, EL_GETCFN, &State::readCharacter);
  el_set(edit, EL_ADDFN, "complete-word", "completes a name", &State::completeWord);
  el_set(edit, EL_BIND, "\t", "complete-word", nullptr);
  el_set(edit, EL_ADDFN, "give-up", "gives the line up", &State::giveUp);
  el_set(edit, EL_BIND, "^C", "give-up", nullptr);
  el_set(edit, EL_SETTY, "-d", "-isig", nullptr); // Ctrl-C is a key while a line is edited
}

LineEditor::~LineEditor() {
  history_end(state_->history);
  el_end(state_->edit);
}

std::optional<std::string> LineEditor::read(const std::string& prompt) {
  state_->prompt = prompt;
  state_->givenUp = false;
  int count = 0;
  el_set(state_->edit, EL_PREP_TERM, 1); // before the prompt is visible: whatever is typed then is a key
  const char* line = el_gets(state_->edit, &count);
  if (state_->givenUp) return std::string();
  if (line == nullptr || count <= 0) return std::nullopt;
  std::string text(line, static_cast<size_t>(count));
  HistEvent event;
  if (text.find_first_not_of(" \t\n") != std::string::npos) history(state_->history, &event, H_ENTER, text.c_str());
  while (text.ends_with('\n') || text.ends_with('\r')) text.pop_back();
  return text;
}

} // namespace rung::scenario
