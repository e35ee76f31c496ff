// Values of scenarios: integers modulo their width, tolerances, ranges; services by the names of their arguments.
#include <gtest/gtest.h>

#include "tools/scenario/values.h"

namespace rung::scenario {
namespace {

Statement statement(const std::string& line) { return parse("t.scn", "program a\n" + line + "\n").statements.at(1); }

Reading integer(uint64_t value, uint32_t width) {
  Reading reading;
  reading.integer = value;
  reading.width = width;
  reading.real = static_cast<double>(value);
  return reading;
}

TEST(ScenarioValues, IntegersCompareModuloTheirWidth) {
  EXPECT_EQ(checkValue(integer(0xFF, 8), statement("expect D0 -1")), "");
  EXPECT_EQ(checkValue(integer(0xFF, 8), statement("expect D0 255")), "");
  EXPECT_NE(checkValue(integer(0xFF, 16), statement("expect D0 -1")), "");
  EXPECT_NE(checkValue(integer(1, 8), statement("expect D0 2")).find("D0 is 1 (0x1), expected 2"), std::string::npos);
}

TEST(ScenarioValues, RealsHaveATolerance) {
  EXPECT_EQ(checkValue(realReading(1.505), statement("expect F ~ 1.5 0.01")), "");
  EXPECT_NE(checkValue(realReading(1.52), statement("expect F ~ 1.5 0.01")), "");
  EXPECT_NE(checkValue(realReading(1.5000001), statement("expect F 1.5")), "");
}

TEST(ScenarioValues, RangesAreUnsignedUnlessTheLowBoundIsNegative) {
  EXPECT_EQ(checkRange(integer(200, 8), statement("expect_range D0 100 250")), "");
  EXPECT_EQ(checkRange(integer(0xFE, 8), statement("expect_range D0 -3 0")), "");
  EXPECT_NE(checkRange(integer(0xFE, 8), statement("expect_range D0 0 100")), "");
}

TEST(ScenarioValues, MessagesCompareTheirProperties) {
  const nc::ShownMessage message{20, 1, 2, 33, false, "Mount tool 7"};
  EXPECT_EQ(
      messageDifference(message, statement("expect_message 20 channel=1 index=2 value=33 text=\"Mount tool 7\"").keys),
      "");
  EXPECT_NE(messageDifference(message, statement("expect_message 20 channel=2").keys), "");
  EXPECT_NE(messageDifference(message, statement("expect_message 20 colour=2").keys).find("no property"),
            std::string::npos);
}

TEST(ScenarioServices, ArgumentsGoByName) {
  const ServiceSignature windr("WINDR function length -> end data");
  rt::ServiceRequest request;
  request.argCount = 2;
  request.args[0] = 5;
  request.args[1] = 4;
  EXPECT_EQ(requestDifference(windr, request, "windr", statement("expect_call windr length=4").keys), "");
  EXPECT_NE(requestDifference(windr, request, "windr", statement("expect_call windr length=2").keys), "");
  EXPECT_NE(requestDifference(windr, request, "windw", {}), "");
  EXPECT_NE(
      requestDifference(windr, request, "windr", statement("expect_call windr colour=2").keys).find("no argument"),
      std::string::npos);
  const rt::ServiceReply reply = replyOf(windr, 9, statement("reply data=77").results);
  EXPECT_EQ(reply.ticket, 9u);
  EXPECT_EQ(reply.resultCount, 2u);
  EXPECT_EQ(reply.results[1], 77);
  EXPECT_EQ(replyOf(windr, 9, statement("reply error=1").results).state, uint32_t{RUNG_SERVICE_ERROR});
}

TEST(ScenarioServices, DataCompareModuloTheLength) {
  const ServiceSignature windw("windw function length data -> end");
  rt::ServiceRequest request;
  request.argCount = 3;
  request.args[0] = 0x105;
  request.args[1] = 2;
  request.args[2] = -2;
  const auto difference = [&](const char* keys) {
    return requestDifference(windw, request, "windw", statement(std::string("expect_call windw ") + keys).keys);
  };
  EXPECT_EQ(difference("data=-2"), "");
  EXPECT_EQ(difference("data=0xFFFE"), "");
  EXPECT_NE(difference("data=0xFFFF"), "");
  EXPECT_NE(difference("function=5"), "") << "the others compare as they are";
  request.args[1] = 4;
  EXPECT_NE(difference("data=0xFFFE"), "");
  EXPECT_EQ(difference("data=4294967294"), "");
  request.args[1] = 0;
  EXPECT_NE(difference("data=4294967294"), "") << "no length";
  request.args[1] = 8;
  EXPECT_EQ(difference("data=-2"), "");
}

TEST(ScenarioServices, KeysAreThoseOfTheService) {
  const ServiceSignature windr("windr function length -> end data");
  const Statement good = statement("prepare windr function=1 LENGTH=2 -> end=0 error=1");
  EXPECT_EQ(keyProblem(windr, good.keys, good.results), "");
  const Statement argument = statement("prepare windr data=1 -> end=0");
  EXPECT_EQ(keyProblem(windr, argument.keys, argument.results), "windr has no argument 'data'");
  const Statement result = statement("prepare windr function=1 -> function=1");
  EXPECT_EQ(keyProblem(windr, result.keys, result.results), "windr has no result 'function'");
}

} // namespace
} // namespace rung::scenario
