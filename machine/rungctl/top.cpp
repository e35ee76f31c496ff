// See top.h.
#include "machine/rungctl/top.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <string>

#include "machine/rungctl/look.h"
#include "machine/rungctl/page.h"
#include "machine/rungctl/screen.h"

namespace rung::rungctl {

namespace {

using Clock = std::chrono::steady_clock;

class Top {
public:
  Top(const Words& words, const volatile int& stop) : host_(words.common.host), stop_(stop) {
    connect(); // an error at the beginning ends the command
    update();
  }

  int run() {
    Screen screen;
    auto next = Clock::now() + kPeriod;
    while (stop_ == 0 && !ends_) {
      screen.draw(pageOf(look_, view_, problem_, screen.width(), screen.height()));
      const auto wait = std::chrono::duration_cast<std::chrono::milliseconds>(next - Clock::now());
      if (wait.count() > 0) press(screen.key(std::min(wait, kTurn)), screen.height());
      if (Clock::now() < next) continue;
      next = Clock::now() + kPeriod;
      refresh();
    }
    return cli::kOk;
  }

private:
  static constexpr std::chrono::seconds kPeriod{1};
  static constexpr std::chrono::milliseconds kTurn{200}; // so that a signal ends it soon

  void connect() {
    client_ = std::make_unique<Client>(host_, Observer::kPatience);
    host_ = client_->greeting().value("host", host_); // the same one when it is back
  }
  void update() {
    observer_.look(*client_, {.rungsBy = view_.byLongest ? "longest" : "time", .log = view_.section == Section::Log},
                   look_);
  }

  void refresh() try {
    if (client_ == nullptr) connect();
    update();
    problem_.clear();
  } catch (const std::exception& error) {
    client_.reset();
    problem_ = std::string("NO CONNECTION, values are old: ") + error.what();
  }

  void show(Section section) {
    view_ = {.section = section};
    if (client_ != nullptr) refresh();
  }

  void press(const Screen::Pressed& pressed, size_t height) {
    using Key = Screen::Key;
    const size_t page = height / 2;
    switch (pressed.key) {
    case Key::Up: view_.scrolled -= std::min<size_t>(view_.scrolled, 1); break;
    case Key::Down: scrollDown(1); break;
    case Key::PageUp: view_.scrolled -= std::min(view_.scrolled, page); break;
    case Key::PageDown: scrollDown(page); break;
    case Key::Next: show(static_cast<Section>((static_cast<size_t>(view_.section) + 1) % kSections)); break;
    case Key::Letter: pressLetter(pressed.letter); break;
    case Key::Gone: ends_ = true; break;
    case Key::None:
    case Key::Resized: break;
    }
  }
  void scrollDown(size_t lines) { view_.scrolled = std::min(view_.scrolled + lines, most()); }
  // More than any section has lines that are not shown.
  size_t most() const {
    return std::max({look_.pins.size(), look_.timers.size(), look_.log ? look_.log->size() : 0, look_.messages.size(),
                     size_t{Observer::kMostRungs}});
  }

  void pressLetter(char letter) {
    switch (letter) {
    case 'o': show(Section::Overview); break;
    case 'r': show(Section::Rungs); break;
    case 'p': show(Section::Pins); break;
    case 'm': show(Section::Messages); break;
    case 't': show(Section::Timers); break;
    case 'w': show(Section::Waiting); break;
    case 'l': show(Section::Log); break;
    case 's':
      view_.byLongest = !view_.byLongest;
      refresh();
      break;
    case 'q': ends_ = true; break;
    default: break;
    }
  }

  std::string host_;
  const volatile int& stop_;
  std::unique_ptr<Client> client_; // null: the host cannot be reached
  Observer observer_;
  View view_;
  Look look_;
  std::string problem_;
  bool ends_ = false;
};

} // namespace

int top(const Words& words, const volatile int& stop) try {
  if (!words.once && !words.common.asJson) return Top(words, stop).run();
  Client client(words.common.host);
  Look look;
  Observer().look(client, {}, look);
  nlohmann::json answer = {{"ok", true},
                           {"status", look.status},
                           {"messages", look.messages},
                           {"log", *look.log},
                           {"profile", look.profile},
                           {"timers", look.timers},
                           {"pins", nlohmann::json::array()}};
  for (const Look::Pin& pin : look.pins)
    answer["pins"].push_back({{"name", pin.name}, {"value", pin.value}, {"uses", pin.uses}});
  print(words, answer, wholeText(look));
  return cli::kOk;
} catch (const std::exception& problem) {
  return fail(problem.what());
}

} // namespace rung::rungctl
