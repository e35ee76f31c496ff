// Windows and axis requests of FANUC programs as operations of a CNC, and its answers as completion codes and data.
#include <gtest/gtest.h>

#include <vector>

#include "machine/host/services.h"
#include "rtlib/nc/fanuc/services.h"
#include "rtlib/nc/pmc/axis_commands.h"

namespace rung::host {
namespace {

using nc::fanuc::kReadDataAt;
using nc::pmc::ServiceKind;

constexpr int64_t kAll = 0xFFFF; // -1

rung_request requestOf(ServiceKind kind, const std::vector<int64_t>& args) {
  rung_request request{.size = sizeof(rung_request), .ticket = 7, .kind = static_cast<uint32_t>(kind)};
  request.arg_count = static_cast<uint32_t>(args.size());
  std::copy(args.begin(), args.end(), request.args);
  return request;
}

class FanucServices : public testing::Test {
protected:
  FanucServices() {
    live_.known = true;
    live_.line = 120;
    live_.axes = 3;
    for (uint32_t axis = 0; axis < 3; ++axis) live_.machine[axis] = -1.2345 * axis;
  }
  int32_t atOnce(ServiceKind kind, const std::vector<int64_t>& args) {
    reply_ = {};
    return translation_.atOnce(requestOf(kind, args), live_, reply_);
  }
  std::optional<Operation> operation(ServiceKind kind, const std::vector<int64_t>& args) {
    reply_ = {};
    return translation_.operationOf(requestOf(kind, args), reply_);
  }
  rung_reply replied(ServiceKind kind, const std::vector<int64_t>& args, const NcAnswer& answer) {
    return translation_.replyOf(requestOf(kind, args), answer);
  }

  const Translation& translation_ = translationOf("fanuc");
  Live live_;
  rung_reply reply_{};
};

TEST_F(FanucServices, HighSpeedFunctionsAreAnsweredAtOnce) {
  EXPECT_EQ(atOnce(ServiceKind::ReadWindow, {25, 4, 0, 0}), RUNG_ANSWER);
  EXPECT_EQ(reply_.result_count, kReadDataAt + nc::fanuc::kWindowWords);
  EXPECT_EQ(reply_.results[0], 0);
  EXPECT_EQ(reply_.results[1], 4);
  EXPECT_EQ(reply_.results[kReadDataAt], 120);
  EXPECT_EQ(atOnce(ServiceKind::ReadWindow, {28, 12, 0, kAll}), RUNG_ANSWER);
  EXPECT_EQ(reply_.results[1], 12);
  EXPECT_EQ(reply_.results[kReadDataAt + 1], -1235); // 0.001 mm
  EXPECT_EQ(reply_.results[kReadDataAt + 2], -2469);
  EXPECT_EQ(atOnce(ServiceKind::ReadWindow, {28, 4, 0, 4}), RUNG_ANSWER);
  EXPECT_EQ(reply_.results[0], 3);
  EXPECT_EQ(atOnce(ServiceKind::ReadWindow, {26, 2, 0, 0}), RUNG_ANSWER); // not reported
  EXPECT_EQ(reply_.results[0], 2);
  live_.known = false;
  EXPECT_EQ(atOnce(ServiceKind::ReadWindow, {25, 4, 0, 0}), RUNG_REFUSE);
}

TEST_F(FanucServices, MistakesAreAnsweredAtOnce) {
  const struct {
    std::vector<int64_t> args;
    int64_t end;
  } kCases[] = {{{9999, 4, 0, 0}, 1}, {{14, 4, 1, 0}, 1}, {{33, 4, 300, 6}, 2},  {{13, 4, 0, 0}, 3},
                {{13, 4, 1, 4}, 3},   {{15, 4, 1, 0}, 3}, {{15, 4, 1, kAll}, 3}, {{21, 6, 100, 8}, 2}};
  for (const auto& c : kCases) {
    EXPECT_EQ(atOnce(ServiceKind::ReadWindow, c.args), RUNG_ANSWER) << c.args[0];
    EXPECT_EQ(reply_.results[0], c.end) << c.args[0];
  }
}

TEST_F(FanucServices, LowSpeedFunctionsAreOperations) {
  EXPECT_EQ(atOnce(ServiceKind::ReadWindow, {13, 4, 5, 2}), RUNG_QUEUE);
  const auto offset = operation(ServiceKind::ReadWindow, {13, 4, 5, 2});
  ASSERT_TRUE(offset);
  EXPECT_EQ(offset->quantity, Quantity::ToolLengthWear);
  EXPECT_EQ(offset->number, 5u);
  EXPECT_FALSE(offset->write);
  const auto origin = operation(ServiceKind::WriteWindow, {16, 4, 1, 3, 0xFFFFFFFF & -1500});
  ASSERT_TRUE(origin);
  EXPECT_EQ(origin->quantity, Quantity::WorkOffset);
  EXPECT_EQ(origin->axis, 2u);
  EXPECT_EQ(origin->value, -1.5);
  EXPECT_EQ(operation(ServiceKind::WriteWindow, {14, 2, 1, 3, 0x5555FFFF})->value, -0.001); // two bytes count
  const auto macro = operation(ServiceKind::WriteWindow, {22, 6, 500, 0, 1234, 2});
  ASSERT_TRUE(macro);
  EXPECT_EQ(macro->quantity, Quantity::MacroVariable);
  EXPECT_EQ(macro->value, 12.34);
  EXPECT_FALSE(operation(ServiceKind::ReadWindow, {17, 2, 1420, 1})); // CNCs do not offer parameters
  EXPECT_EQ(reply_.results[0], 2);
}

TEST_F(FanucServices, Answers) {
  const rung_reply read = replied(ServiceKind::ReadWindow, {21, 6, 500, 2}, {Outcome::Done, 12.345});
  EXPECT_EQ(read.ticket, 7u);
  EXPECT_EQ(read.results[0], 0);
  EXPECT_EQ(read.results[1], 6);
  EXPECT_EQ(read.results[kReadDataAt], 1235);
  EXPECT_EQ(read.results[kReadDataAt + 1], 2);
  const rung_reply written = replied(ServiceKind::WriteWindow, {14, 4, 1, 0, 5}, {Outcome::Done, 0});
  EXPECT_EQ(written.result_count, 1u);
  EXPECT_EQ(written.results[0], 0);
  const rung_reply large = replied(ServiceKind::ReadWindow, {13, 4, 1, 0}, {Outcome::Done, 1e9});
  EXPECT_EQ(large.results[0], 5);
  EXPECT_EQ(large.results[1], 0);
  const std::pair<Outcome, int64_t> kEnds[] = {{Outcome::NoQuantity, 2},
                                               {Outcome::NoNumber, 3},
                                               {Outcome::NoAxis, 3},
                                               {Outcome::BadValue, 5},
                                               {Outcome::NotNow, 2}};
  for (const auto& [outcome, end] : kEnds)
    EXPECT_EQ(replied(ServiceKind::ReadWindow, {13, 4, 1, 0}, {outcome, 0}).results[0], end);
}

TEST_F(FanucServices, MovesAreInMicrometres) {
  const auto move = operation(ServiceKind::MoveAxis, {1, nc::pmc::kAxisFeed, 600, -2500});
  ASSERT_TRUE(move);
  EXPECT_EQ(move->motion, MotionKind::By);
  EXPECT_EQ(move->axis, 1u);
  EXPECT_EQ(move->value, -2.5);
  EXPECT_EQ(move->speed, 600);
  const auto rapid = operation(ServiceKind::MoveAxis, {0, nc::pmc::kAxisRapid, 0, 1000});
  ASSERT_TRUE(rapid);
  EXPECT_EQ(rapid->speed, 0); // that of the CNC
  EXPECT_FALSE(operation(ServiceKind::MoveAxis, {0, nc::pmc::kAxisFeed, 0, 1000}));
  EXPECT_EQ(atOnce(ServiceKind::MoveAxis, {1, nc::pmc::kAxisFeed, 600, -2500}), RUNG_QUEUE);
}

} // namespace
} // namespace rung::host
