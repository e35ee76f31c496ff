// play_recording FOLDER PROGRAM.so...: plays the recording of a host with the runtime alone, on the machine type that
// this process is for, and prints what comes of it: messages, faults, differences, and a sum over the memory block
// after every part. The outputs on two machine types can be compared line by line.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <zlib.h>

#include "rtlib/load/so_engine.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/record/recording_reader.h"
#include "tools/replay/player.h"

namespace rung {
namespace {

using runtime::Played;

constexpr uint64_t kPartsOfSum = 1000; // between two lines that show the sum

unsigned long long wide(uint64_t value) { return value; }

// A program of the recording. No compiler is here: what its forces need of one cannot be played.
struct Program {
  explicit Program(const std::string& path) {
    std::string problem;
    engine = runtime::SoEngine::open(path, problem);
    if (!engine) throw std::runtime_error(path + ": " + problem);
  }
  void begin(runtime::RecordingMode mode) {
    if (!player) player = replay::makePlayer(mode, *engine, owner);
  }
  std::unique_ptr<runtime::SoEngine> engine;
  runtime::PlayerOwner owner;
  std::unique_ptr<runtime::Player> player;
};
using Programs = std::map<uint64_t, std::unique_ptr<Program>>;

class Playing {
public:
  // Plays events that follow each other and begin with a state.
  void play(runtime::Player& player, const std::vector<uint8_t>& events) {
    player.setEvents(events);
    for (;;) {
      const Played played = player.play();
      if (player.difference()) say("difference"), ++differences_;
      switch (played) {
      case Played::Part: part(player); break;
      case Played::State: say("state"); break;
      case Played::Lost: break;
      case Played::End: return;
      case Played::Other: return say("another program");
      case Played::NoForces: return say("forces that need a compiler, up to the next segment");
      case Played::Damaged: say("damaged"), ++differences_; return;
      }
    }
  }
  void say(const std::string& what) const { std::printf("part %llu: %s\n", wide(parts_), what.c_str()); }
  // Whether all was as recorded.
  bool summary() const {
    std::printf("%llu parts, %u messages, %u differences, sum %08lx\n", wide(parts_), messages_, differences_, sum_);
    return parts_ != 0 && differences_ == 0;
  }

private:
  void part(runtime::Player& player) {
    ++parts_;
    runtime::Instance& instance = player.instance();
    sum_ = crc32(sum_, instance.block().data(), static_cast<uInt>(instance.block().size()));
    if (parts_ % kPartsOfSum == 0) std::printf("part %llu: sum %08lx\n", wide(parts_), sum_);
    messages(player);
    if (instance.faulted() && !faulted_) say(instance.faultText());
    faulted_ = instance.faulted();
  }
  // Where the control runs again, what it shows; otherwise what the program has sent.
  void messages(runtime::Player& player) {
    rung_message message;
    while (player.instance().messages().pop(message)) {
      ++messages_;
      std::printf("part %llu: message %u.%u of channel %d, index %d, value %lld\n", wide(parts_), message.op,
                  message.number, message.channel, message.index, static_cast<long long>(message.value));
    }
    const nc::Control* control = replay::controlOf(player);
    if (control == nullptr || control->shows(player.instance(), shown_)) return;
    shown_ = control->messages(player.instance());
    ++messages_;
    for (const nc::ShownMessage& one : shown_)
      say("shown: " + std::to_string(one.number) + " " + std::to_string(one.value) + " " + control->text(one));
    if (shown_.empty()) say("no message is shown");
  }

  uint64_t parts_ = 0;
  uint32_t messages_ = 0, differences_ = 0;
  uLong sum_ = 0;
  bool faulted_ = false;
  std::vector<nc::ShownMessage> shown_;
};

Programs programsOf(char** paths) {
  Programs programs;
  for (; *paths != nullptr; ++paths) {
    auto program = std::make_unique<Program>(*paths);
    const uint64_t hash = program->engine->program().code_hash;
    programs.emplace(hash, std::move(program));
  }
  return programs;
}

// Whether all was as recorded.
bool play(const char* folder, const Programs& programs) {
  std::string problem;
  const auto reader = runtime::RecordingReader::open(folder, problem);
  if (!reader) throw std::runtime_error(problem);
  Playing playing;
  bool known = true;
  for (const runtime::SegmentFile& file : reader->segments()) {
    std::optional<runtime::SegmentReader> segment = runtime::SegmentReader::open(reader->pathOf(file), problem);
    if (!segment) throw std::runtime_error(problem);
    const auto program = programs.find(segment->head().program);
    known = known && program != programs.end();
    if (program == programs.end()) {
      playing.say("no program " + runtime::programName(segment->head().program));
      continue;
    }
    std::vector<uint8_t> events;
    for (runtime::RecordedBlock block; segment->next(block);)
      events.insert(events.end(), block.events.begin(), block.events.end());
    program->second->begin(segment->head().mode);
    playing.play(*program->second->player, events);
  }
  return playing.summary() && known;
}

} // namespace
} // namespace rung

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: play_recording FOLDER PROGRAM.so...\n"), 2;
  try {
    return rung::play(argv[1], rung::programsOf(argv + 2)) ? 0 : 1;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
