// What a host does to its program, recorded in files, read and played by the interpreter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "ir/support/temporary_folder.h"
#include "rtlib/api/host_player.h"
#include "rtlib/record/recording_reader.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/host/bench.h"

namespace rung::host {
namespace {

using compiler::EngineKind;
using runtime::Played;
using testing::Bench;
using ::testing::IsEmpty;
using testing::kMs;

struct Case {
  const char* name;
  const char* file;
  const char* program;
  const char* map; // without [recording]
  int64_t stepNs;
  const char* written; // a cell that clients write
};

constexpr const char* kGsk = R"(dialect gsk
symbol GO X0.0
symbol WAIT X0.1
symbol ASK X0.2
symbol LAMP Y0.0
symbol LATE Y0.1
symbol TOLD R10.0
symbol SCANS D100
symbol SPEED D110
symbol NEVER R9.0
FUNC END1
LD NEVER
LDI NEVER
FUNC ADDB
PRM 0004
PRM SCANS
PRM 1
PRM SCANS
OUT R0.0
LD GO
OUT LAMP
LD WAIT
FUNC TMRB
PRM 1
PRM 40
OUT LATE
LD ASK
FUNC WINDR
PRM D0
PRM R20
OUT TOLD
LD F0.1
OUT R30.0
FUNC END2
)";
constexpr const char* kGskMap = R"([in]
go = { type = "bit", name = "GO" }
wait = { type = "bit", name = "WAIT" }
ask = { type = "bit", name = "ASK" }
speed = { type = "s32", name = "SPEED" }
[out]
lamp = { type = "bit", name = "LAMP" }
)";

constexpr const char* kNct = R"(dialect nct
module MAIN
symbol ARM     INP000.00
symbol POT     INP000.01
symbol COOLANT OUT000.00
symbol COUNT   5005
symbol SPEED   5006
rung
|--[N_FIRSTCC]--+--(S CP_M1ACK)
                +--(S CP_TACK)
rung
|--[CN_M1STB]--+--(R CP_M1ACK)
               +--{ADD COUNT #1 COUNT}
rung
|--[ARM]--[/CP_M1ACK]--(S CP_M1ACK)
rung
|--[ARM]--[N_1SEC]--(COOLANT)
rung
|--[CP_M1ACK]--(CP_FIN)
rung
|--{END}
)";
constexpr const char* kNctMap = R"([in]
arm = { type = "bit", name = "ARM" }
pot = { type = "bit", name = "POT" }
speed = { type = "s32", name = "SPEED" }
[out]
pump = { type = "bit", name = "COOLANT" }
[[send]]
pin = "go"
edge = "rise"
function = "M"
code = 6
done = "changed"
[[abort]]
pin = "wait"
edge = "rise"
)";

constexpr Case kCases[] = {{"Gsk", "mill.pmc", kGsk, kGskMap, kMs, "D120"},
                           {"Nct", "mill.lad", kNct, kNctMap, kMs, "COUNT"}};

// What a recording says, played.
struct Replay {
  Replay(const std::string& folder, const rung_program& program) : image(Image::adopt(program)) {
    std::string problem;
    std::optional<runtime::RecordingReader> recording = runtime::RecordingReader::open(folder, problem);
    EXPECT_TRUE(recording) << problem;
    if (!recording) return;
    for (const runtime::SegmentFile& segment : recording->segments()) play(recording->pathOf(segment));
  }
  void play(const std::string& path) {
    std::string problem;
    std::optional<runtime::SegmentReader> reader = runtime::SegmentReader::open(path, problem);
    ASSERT_TRUE(reader) << problem;
    runtime::RecordedBlock block;
    while (reader->next(block)) {
      player.setEvents(block.events);
      bytes += block.events.size();
      for (Played played = player.play(); played != Played::End; played = player.play()) {
        if (played == Played::Lost) {
          ++losses;
          continue;
        }
        ASSERT_TRUE(played == Played::Part || played == Played::State)
            << static_cast<int>(played) << " at " << player.position() << " of the block at " << block.offset;
        ASSERT_FALSE(player.difference())
            << "after " << parts << ": kind " << static_cast<int>(player.difference()->kind) << ", offset "
            << player.difference()->offset;
        ++(played == Played::Part ? parts : states);
      }
    }
    EXPECT_THAT(reader->problems(), IsEmpty());
    ended = reader->ended();
  }

  struct Owner final : runtime::PlayerOwner {
    void marked(std::string_view text) override { marks.emplace_back(text); }
    std::vector<std::string> marks;
  };
  Image image;
  Owner owner;
  api::HostPlayer player{image.handle(), owner};
  uint32_t parts = 0, states = 0, losses = 0;
  size_t bytes = 0;
  bool ended = false;
};

class Recorded : public ::testing::TestWithParam<Case> {
protected:
  Recorded() {
    EXPECT_THAT(b.errors, IsEmpty());
    EXPECT_THAT(b.warnings, IsEmpty());
  }
  std::string mapText() const {
    return std::string(GetParam().map) + "[recording]\nfolder = \"" + (folder / "rec").string() + "\"\n";
  }
  // Pins that change at random, and what clients do.
  void work(uint32_t steps) {
    for (uint32_t i = 0; i < steps; ++i) {
      if (random() % 16 == 0) {
        PinValue& pin = b.values[random() % b.values.size()];
        if (b.host->pins()[static_cast<size_t>(&pin - b.values.data())].type == PinType::Bit)
          pin.bit = random() % 2 != 0;
        else
          pin.s32 = static_cast<int32_t>(random());
      }
      (void)b.host->step(GetParam().stepNs);
      if (random() % 64 == 0) act();
      (void)b.messages();
    }
  }
  void act() {
    rung_instance* plc = b.host->instance();
    rung_request request{};
    switch (random() % 5) {
    case 0: {
      rung_cell cell = 0;
      const rung_value value{.integer = static_cast<int64_t>(random() % 100)};
      EXPECT_EQ(rung_instance_find(plc, GetParam().written, RUNG_WRITE, &cell), RUNG_OK);
      EXPECT_EQ(rung_instance_write(plc, cell, 0, 1, &value), RUNG_OK);
      break;
    }
    case 1: (void)rung_instance_stop(plc); break;
    case 2: (void)rung_instance_start(plc); break;
    case 3: b.host->live().served = random() % 2 != 0; break;
    case 4:
      while (b.host->nextRequest(request)) {
        const rung_reply reply{.size = sizeof reply, .ticket = request.ticket, .result_count = 1, .results = {7}};
        b.host->answer(reply);
      }
      break;
    }
  }

  using PinValue = testing::PinValue;
  TemporaryFolder folder;
  rung::testing::CompiledProgram program{GetParam().file, GetParam().program, EngineKind::Jit};
  rung::testing::CompiledProgram again{GetParam().file, GetParam().program, EngineKind::Interp};
  Bench b{program.program(), mapText()};
  std::minstd_rand random{7};
};

TEST_P(Recorded, IsPlayedByTheInterpreter) {
  work(30'000);
  EXPECT_EQ(rung_instance_mark(b.host->instance(), "here"), RUNG_OK);
  work(5'000);
  b.host->close();
  auto info = sized<rung_recording_info>();
  ASSERT_EQ(rung_instance_recording(b.host->instance(), &info), RUNG_OK);
  EXPECT_EQ(info.losses, 0u);
  EXPECT_STREQ(info.problem, "");
  b.host.reset();
  const Replay replay((folder / "rec").string(), again.program());
  EXPECT_GT(replay.parts, 4'000u);
  EXPECT_GE(replay.states, 3u);
  EXPECT_EQ(replay.losses, 0u);
  EXPECT_TRUE(replay.ended);
  EXPECT_THAT(replay.owner.marks, ::testing::ElementsAre("here"));
}

INSTANTIATE_TEST_SUITE_P(Dialects, Recorded, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace rung::host
