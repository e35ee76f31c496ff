// Short forms of events, and which inputs have changed: against what a simple loop finds.
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtlib/record/events.h"
#include "rtlib/record/input_bits.h"

namespace rung::runtime {
namespace {

using ::testing::ElementsAreArray;

struct Written {
  Places::Run run;
  std::vector<uint8_t> bytes;
};

TEST(ShortForms, AreReadAsTheyWereWritten) {
  std::mt19937 random(3);
  std::vector<uint8_t> buffer(1 << 20);
  EventWriter writer(buffer);
  Places writes, reads;
  std::vector<Written> all;
  size_t full = 0;
  for (int i = 0; i < 20'000; ++i) {
    // Few places often, many seldom: places collide.
    const auto offset = static_cast<uint32_t>(random() % 4 == 0 ? random() % 60'000 : random() % 40 * 7);
    Written one{
        .run = {random() % 2 == 0 ? Event::Bytes : Event::Input, offset, 1 + static_cast<uint32_t>(random() % 12)},
        .bytes = {}};
    for (uint32_t b = 0; b < one.run.count; ++b) one.bytes.push_back(static_cast<uint8_t>(random()));
    putRun(writer, writes, one.run, one.bytes.data());
    full += 4 + one.bytes.size();
    all.push_back(std::move(one));
  }
  ASSERT_TRUE(writer.fits());
  EXPECT_LT(writer.size(), full);
  EventReader reader(writer.written());
  for (const Written& one : all) {
    Places::Run run;
    std::span<const uint8_t> bytes;
    ASSERT_TRUE(takeRun(reader, reads, reader.takeEvent(), run, bytes));
    ASSERT_EQ(run, one.run);
    ASSERT_THAT(bytes, ElementsAreArray(one.bytes));
  }
  EXPECT_TRUE(reader.atEnd());
}

TEST(ShortForms, ContinueFromAList) {
  std::vector<uint8_t> buffer(4096), list(Places::kRoom + 16);
  const uint8_t bytes[] = {1, 2, 3};
  Places places;
  EventWriter writer(buffer);
  for (const uint32_t offset : {70'000u, 5u, 300u}) putRun(writer, places, {Event::Input, offset, 3}, bytes);
  EventWriter listed(list);
  places.list(listed);
  const size_t before = writer.size();
  for (const uint32_t offset : {5u, 300u, 70'000u}) putRun(writer, places, {Event::Input, offset, 3}, bytes);
  EXPECT_EQ(writer.size() - before, 3u * 4);
  Places again;
  EventReader ofList(listed.written()), reader(writer.written().subspan(before));
  ASSERT_TRUE(again.takeList(ofList));
  for (const uint32_t offset : {5u, 300u, 70'000u}) {
    Places::Run run;
    std::span<const uint8_t> taken;
    ASSERT_TRUE(takeRun(reader, again, reader.takeEvent(), run, taken));
    EXPECT_EQ(run, (Places::Run{Event::Input, offset, 3}));
  }
}

TEST(ShortForms, ThatNothingComesBeforeAreRefused) {
  Places places;
  Places::Run run;
  std::span<const uint8_t> bytes;
  const uint8_t unknown[] = {1, 2, 3, 4};
  EventReader reader(unknown);
  EXPECT_FALSE(takeRun(reader, places, static_cast<Event>(Places::kShort + 5), run, bytes));
  const std::vector<std::vector<uint8_t>> lists = {
      {1, 128, 1, 8, 5, 1},       // no such place
      {1, 3, 5, 5, 1},            // not Bytes or Input
      {1, 3, 8, 5, 0},            // no bytes
      {2, 3, 8, 5, 1},            // cut off
      {255, 255, 255, 255, 15, 3} // many
  };
  for (const std::vector<uint8_t>& list : lists) {
    EventReader ofList(list);
    EXPECT_FALSE(places.takeList(ofList));
  }
}

TEST(InputBits, FindsWhatHasChanged) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const size_t size = 16 + random() % 400;
    std::vector<uint8_t> masks(size), block(size), known(size);
    for (size_t i = 0; i < size; ++i)
      if (random() % 5 == 0) masks[i] = static_cast<uint8_t>(random() % 2 == 0 ? 0xFF : random());
    InputBits bits(masks, round % 2 == 0 ? InputBits::Cpu::This : InputBits::Cpu::Any);
    for (int step = 0; step < 20; ++step) {
      for (size_t count = random() % 20; count != 0; --count) block[random() % size] = static_cast<uint8_t>(random());
      std::vector<uint32_t> expected, found;
      for (size_t i = 0; i < size; ++i)
        if (((block[i] ^ known[i]) & masks[i]) != 0) expected.push_back(static_cast<uint32_t>(i));
      bits.compare(bits.firstOther(block.data()), block.data(), [&](uint32_t offset) { found.push_back(offset); });
      ASSERT_EQ(found, expected) << "round " << round << " size " << size;
      for (size_t i = 0; i < size; ++i) known[i] = block[i] & masks[i];
    }
    // A player that reads the list and what is known writes the same.
    std::vector<uint8_t> buffer(bits.listed() + bits.listedKnown()), other(size);
    EventWriter writer(buffer);
    bits.list(writer);
    const size_t list = writer.size();
    bits.listKnown(writer);
    ASSERT_TRUE(writer.fits());
    EventReader reader(writer.written().first(list)), events(writer.written().subspan(list));
    std::optional<InputBits> read = InputBits::fromList(size, reader);
    ASSERT_TRUE(read);
    Places places;
    while (!events.atEnd()) {
      Places::Run run;
      std::span<const uint8_t> bytes;
      ASSERT_TRUE(takeRun(events, places, events.takeEvent(), run, bytes));
      read->set(run.offset, bytes);
    }
    read->write(other.data());
    ASSERT_EQ(other, known) << "round " << round;
  }
}

} // namespace
} // namespace rung::runtime
