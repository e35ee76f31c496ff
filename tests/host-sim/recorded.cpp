// See recorded.h.
#include "tests/host-sim/recorded.h"

#include <optional>

#include "ir/support/check.h"
#include "rtlib/load/program_info.h"
#include "rtlib/record/recording_reader.h"
#include "tests/host-sim/world.h"

namespace rung::host_sim {
namespace {

using runtime::Played;

// A file on a disk that becomes full.
class OnDisk final : public runtime::AppendedFile {
public:
  OnDisk(std::unique_ptr<runtime::AppendedFile> file, const MemoryDisk& disk) : file_(std::move(file)), disk_(disk) {}
  bool append(std::span<const uint8_t> bytes, std::string& error) override {
    if (disk_.full) return error = "No space left on device", false;
    return file_->append(bytes, error);
  }

private:
  std::unique_ptr<runtime::AppendedFile> file_;
  const MemoryDisk& disk_;
};

// One version of the program, and the player of what was recorded of it.
struct Version {
  explicit Version(Image of) : image(std::move(of)) {}
  Image image;
  api::ServedOwner owner{image.handle()};
  api::HostPlayer player{image.handle(), owner};
};

class Playing {
public:
  explicit Playing(const Programs& programs) {
    for (size_t i = 0; i < programs.versions().size(); ++i)
      versions_.push_back(std::make_unique<Version>(programs.image(i)));
  }

  // "", or the problem.
  std::string play(const std::string& path) {
    std::string problem;
    std::optional<runtime::SegmentReader> reader = runtime::SegmentReader::open(path, problem);
    if (!reader) return problem;
    runtime::RecordedBlock block;
    while (reader->next(block))
      if (std::string wrong = playBlock(block); !wrong.empty()) return path + ": " + wrong;
    return reader->problems().empty() ? "" : reader->problems().front();
  }

private:
  std::string playBlock(const runtime::RecordedBlock& block) {
    std::span<const uint8_t> events = block.events;
    now().setEvents(events);
    for (Played played = now().play(); played != Played::End; played = now().play()) {
      const std::string at = "part " + std::to_string(parts_) + ", byte " + std::to_string(now().position());
      if (played == Played::Other) {
        events = events.subspan(now().position());
        if (!enter(events)) return "no version of the program has the hash that the recording names";
        now().setEvents(events);
      } else if (played == Played::Part) {
        ++parts_;
      } else if (played != Played::State && played != Played::Lost) {
        return "not played: " + std::to_string(static_cast<int>(played)) + " at " + at;
      }
      if (now().difference())
        return "played otherwise: " + std::to_string(static_cast<int>(now().difference()->kind)) + ", offset " +
               placeOf(now().difference()->offset) + " at " + at;
    }
    return {};
  }

  bool enter(std::span<const uint8_t> events) {
    runtime::EventReader reader(events);
    (void)reader.takeEvent();
    const uint64_t hash = reader.takeNumber();
    for (now_ = 0; now_ < versions_.size(); ++now_)
      if (now().instance().program().code_hash == hash) return true;
    return false;
  }
  std::string placeOf(uint32_t offset) {
    const rung_program& program = now().instance().program();
    const std::optional<runtime::LogicalByte> byte = runtime::byteAt(program, offset);
    return byte ? std::string(program.spaces[byte->space].name) + " " + std::to_string(byte->byte)
                : std::to_string(offset);
  }
  api::HostPlayer& now() { return versions_[now_]->player; }

  std::vector<std::unique_ptr<Version>> versions_;
  size_t now_ = 0;
  uint64_t parts_ = 0;
};

} // namespace

void Recorded::begin(rung_instance& instance, const MemoryDisk& disk) {
  const auto open = [&disk](const std::string& path, std::string& error) -> std::unique_ptr<runtime::AppendedFile> {
    auto file = runtime::openAppended(path, error);
    return file == nullptr ? nullptr : std::make_unique<OnDisk>(std::move(file), disk);
  };
  instance.recording = std::make_unique<api::InstanceRecording>(
      instance, runtime::RecordingOptions{.folder = (folder_ / "recording").string(), .segmentBytes = 16'384},
      runtime::RecorderOptions{.stateEveryUs = 500'000}, open);
}

void Recorded::look(rung_instance& instance) { instance.recording->writer().look(); }

std::string Recorded::play() const {
  Playing playing(programs_);
  std::string problem;
  const std::string folder = (folder_ / "recording").string();
  const std::optional<runtime::RecordingReader> recording = runtime::RecordingReader::open(folder, problem);
  if (!recording) return {}; // the disk was full from the beginning
  if (!recording->problems().empty()) return recording->problems().front();
  for (const runtime::SegmentFile& segment : recording->segments())
    if (std::string wrong = playing.play(recording->pathOf(segment)); !wrong.empty()) return wrong;
  return {};
}

} // namespace rung::host_sim
