// A host and its pins, as HAL would have them.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/plc_host.h"

namespace rung::host::testing {

constexpr int64_t kMs = 1'000'000;

union PinValue {
  bool bit;
  int32_t s32;
  uint32_t u32;
  double real = 0;
};

inline std::vector<std::string> textsOf(const std::vector<Report>& reports) {
  std::vector<std::string> texts;
  for (const Report& report : reports) texts.push_back(report.text);
  return texts;
}

class Bench {
public:
  Bench(const rung_program& program, std::string_view text, const std::string& retain = {}, uint32_t catchUp = 0) {
    host::File map = host::parseMap(text, "m.map", errors);
    values.resize(map.pins.size());
    for (PinValue& value : values) cells.push_back({.any = &value});
    try {
      host = PlcHost::make(Image::adopt(program), std::move(map), {.retain = retain, .catchUp = catchUp}, errors,
                           warnings);
    } catch (const Error& error) {
      errors.emplace_back(error.what());
    }
    if (host) host->connect(cells.data());
  }

  PinValue& operator[](std::string_view name) {
    for (size_t i = 0; i < values.size(); ++i)
      if (host->pins()[i].name == name) return values[i];
    ADD_FAILURE() << "no pin " << name;
    return values[0];
  }
  // What the program has shown since the last call.
  std::vector<rung_message_info> messages() const {
    std::vector<rung_message_info> list;
    rung_message_info message{};
    while (host->nextMessage(message)) list.push_back(message);
    return list;
  }
  template <class T>
  std::vector<T> messages(T rung_message_info::* member) const {
    std::vector<T> list;
    for (const rung_message_info& message : messages()) list.push_back(message.*member);
    return list;
  }
  // Scans of an 8 ms program.
  void scans(int count) {
    for (int i = 0; i < count; ++i) EXPECT_EQ(host->step(8 * kMs), StepResult::Ran);
  }
  // A thread of 1 ms; the program does not stop.
  void run(int64_t ms) {
    for (int64_t i = 0; i < ms; ++i) EXPECT_NE(host->step(kMs), StepResult::Failed);
  }

  std::vector<std::string> errors;
  std::vector<std::string> warnings;
  std::vector<PinValue> values;
  std::vector<PinCell> cells;
  std::unique_ptr<PlcHost> host;
};

} // namespace rung::host::testing
