// play_recording FOLDER PROGRAM.so...: plays the recording of a host with the runtime alone, on whatever machine type
// this process is for, and prints what comes of it: messages, faults, differences, and a sum over the memory block
// after every part. The output of two machine types can be compared line by line.
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <zlib.h>

#include "rtlib/api/host_player.h"
#include "rtlib/record/recording_reader.h"
#include "rung/runtime.hpp"

namespace rung {
namespace {

using runtime::Played;

constexpr uint64_t kPartsOfSum = 1000; // between two lines that show the sum

struct Program {
  explicit Program(const char* path) : image(path), owner(image.handle()), player(image.handle(), owner) {}
  Image image;
  api::ServedOwner owner;
  api::HostPlayer player;
};

class Playing {
public:
  explicit Playing(const std::map<uint64_t, std::unique_ptr<Program>>& programs) : programs_(programs) {}

  // Plays blocks that follow each other and begin with a state.
  void segment(uint64_t program, const std::vector<uint8_t>& events) {
    const auto known = programs_.find(program);
    if (known == programs_.end()) {
      std::printf("no program %016llx\n", static_cast<unsigned long long>(program));
      return;
    }
    api::HostPlayer& player = known->second->player;
    player.setEvents(events);
    for (;;) {
      const Played played = player.play();
      if (player.difference()) std::printf("part %llu: difference\n", number(parts_)), ++differences_;
      switch (played) {
      case Played::Part: part(player.instance()); break;
      case Played::State: std::printf("part %llu: state\n", number(parts_)); break;
      case Played::Lost: break;
      case Played::End: return;
      case Played::Other: std::printf("part %llu: another program\n", number(parts_)); return;
      case Played::NoForces: std::printf("part %llu: forces need a compiler\n", number(parts_)); return;
      case Played::Damaged: std::printf("part %llu: damaged\n", number(parts_)); return;
      }
    }
  }

  void summary() const {
    std::printf("%llu parts, %u messages, %u differences, sum %08lx\n", number(parts_), messages_, differences_, sum_);
  }
  bool good() const { return parts_ != 0 && differences_ == 0; }

private:
  static unsigned long long number(uint64_t value) { return value; }

  void part(runtime::Instance& instance) {
    ++parts_;
    const std::span<const uint8_t> block = instance.block();
    sum_ = crc32(sum_, block.data(), static_cast<uInt>(block.size()));
    if (parts_ % kPartsOfSum == 0) std::printf("part %llu: sum %08lx\n", number(parts_), sum_);
    rung_message message;
    while (instance.messages().pop(message)) {
      ++messages_;
      std::printf("part %llu: message op %u number %u channel %d index %d value %lld\n", number(parts_), message.op,
                  message.number, message.channel, message.index, static_cast<long long>(message.value));
    }
    if (instance.faulted() && !faulted_) std::printf("part %llu: %s\n", number(parts_), instance.faultText().c_str());
    faulted_ = instance.faulted();
  }

  const std::map<uint64_t, std::unique_ptr<Program>>& programs_;
  uint64_t parts_ = 0;
  uint32_t messages_ = 0, differences_ = 0;
  uLong sum_ = 0;
  bool faulted_ = false;
};

int play(const char* folder, char** paths) {
  std::map<uint64_t, std::unique_ptr<Program>> programs;
  for (; *paths != nullptr; ++paths) {
    auto program = std::make_unique<Program>(*paths);
    const uint64_t hash = program->player.instance().program().code_hash;
    programs.emplace(hash, std::move(program));
  }
  std::string problem;
  const auto reader = runtime::RecordingReader::open(folder, problem);
  if (!reader) return std::fprintf(stderr, "%s\n", problem.c_str()), 2;
  Playing playing(programs);
  for (const runtime::SegmentFile& file : reader->segments()) {
    auto segment = runtime::SegmentReader::open(reader->pathOf(file), problem);
    if (!segment) return std::fprintf(stderr, "%s\n", problem.c_str()), 2;
    std::vector<uint8_t> events;
    for (runtime::RecordedBlock block; segment->next(block);)
      events.insert(events.end(), block.events.begin(), block.events.end());
    playing.segment(segment->head().program, events);
  }
  playing.summary();
  return playing.good() ? 0 : 1;
}

} // namespace
} // namespace rung

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: play_recording FOLDER PROGRAM.so...\n"), 2;
  try {
    return rung::play(argv[1], argv + 2);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
