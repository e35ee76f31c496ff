// See screen.h.
#include "machine/rungctl/screen.h"

#include <ncurses.h>
#include <poll.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace rung::rungctl {

namespace {

constexpr short kRed = 1;

attr_t attributesOf(Style style, bool hasColours) {
  switch (style) {
  case Style::Plain: return A_NORMAL;
  case Style::Heading: return A_BOLD;
  case Style::Alarm: return hasColours ? A_BOLD | COLOR_PAIR(kRed) : A_REVERSE;
  case Style::Faint: return A_DIM;
  }
  return A_NORMAL;
}

} // namespace

Screen::Screen() {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0)
    throw std::runtime_error("standard input and output are not a terminal; --once prints a page as text");
  std::setlocale(LC_CTYPE, "");
  terminal_ = newterm(nullptr, stdout, stdin);
  if (terminal_ == nullptr) {
    const char* name = std::getenv("TERM");
    throw std::runtime_error(std::string("the terminal \"") + (name == nullptr ? "" : name) +
                             "\" (variable TERM) cannot show a page; --once prints it as text");
  }
  cbreak();
  noecho();
  keypad(stdscr, TRUE);
  curs_set(0);
  hasColours_ =
      has_colors() && start_color() != ERR && use_default_colors() != ERR && init_pair(kRed, COLOR_RED, -1) != ERR;
}

Screen::~Screen() {
  endwin();
  delscreen(static_cast<SCREEN*>(terminal_));
}

size_t Screen::width() const { return static_cast<size_t>(COLS); }
size_t Screen::height() const { return static_cast<size_t>(LINES); }

void Screen::draw(const std::vector<Line>& lines) {
  erase();
  for (size_t i = 0; i < lines.size() && i < height(); ++i) {
    attrset(static_cast<int>(attributesOf(lines[i].style, hasColours_)));
    mvaddstr(static_cast<int>(i), 0, lines[i].text.c_str());
  }
  attrset(A_NORMAL);
  refresh();
}

Screen::Pressed Screen::key(std::chrono::milliseconds wait) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  poll(&input, 1, static_cast<int>(wait.count()));
  if ((input.revents & ~POLLIN) != 0) return {.key = Key::Gone};
  timeout(0);
  const int key = getch();
  switch (key) {
  case ERR: return {};
  case KEY_UP: return {.key = Key::Up};
  case KEY_DOWN: return {.key = Key::Down};
  case KEY_PPAGE: return {.key = Key::PageUp};
  case KEY_NPAGE: return {.key = Key::PageDown};
  case KEY_RESIZE: return {.key = Key::Resized};
  case '\t': return {.key = Key::Next};
  default: break;
  }
  constexpr int kFirst = 0x20, kLast = 0x7E;
  return key >= kFirst && key <= kLast ? Pressed{.key = Key::Letter, .letter = static_cast<char>(key)} : Pressed{};
}

} // namespace rung::rungctl
