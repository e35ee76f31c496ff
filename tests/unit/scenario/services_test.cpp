// Requests to services by the names of their arguments, reals and names of quantities. What is said about a wrong key
// is a golden (golden_test.cpp).
#include <gtest/gtest.h>

#include <bit>

#include "rtlib/nc/gsk/services.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/nc/nct/services.h"
#include "tests/support/words.h"
#include "tools/scenario/requests.h"

namespace rung::scenario {
namespace {

using nc::nct::ServiceKind;

Statement statement(const std::string& line) { return parse("t.scn", "program a\n" + line + "\n").statements.at(1); }

TEST(ScenarioServices, ArgumentsGoByName) {
  const ServiceSignature windr(nc::gsk::service(nc::pmc::ServiceKind::ReadWindow));
  core::ServiceRequest request;
  request.argCount = 2;
  request.args[0] = 5;
  request.args[1] = 4;
  EXPECT_EQ(requestDifference(windr, {.request = request}, "windr", statement("expect_call windr length=4").keys), "");
  EXPECT_NE(requestDifference(windr, {.request = request}, "windr", statement("expect_call windr length=2").keys), "");
  EXPECT_NE(requestDifference(windr, {.request = request}, "windw", {}), "");
  EXPECT_NE(requestDifference(windr, {.request = request}, "windr", statement("expect_call windr colour=2").keys)
                .find("no argument"),
            std::string::npos);
  const core::ServiceReply reply = answerOf(windr, {.ticket = 9}, statement("reply data=77").results).reply;
  EXPECT_EQ(reply.ticket, 9u);
  EXPECT_EQ(reply.resultCount, 2u);
  EXPECT_EQ(reply.results[1], 77);
  EXPECT_EQ(answerOf(windr, {.ticket = 9}, statement("reply error=1").results).reply.state,
            uint32_t{RUNG_SERVICE_ERROR});
}

TEST(ScenarioServices, DataCompareModuloTheLength) {
  const ServiceSignature windw(nc::gsk::service(nc::pmc::ServiceKind::WriteWindow));
  core::ServiceRequest request;
  request.argCount = 5;
  request.args[0] = 0x105;
  request.args[1] = 2;
  request.args[4] = -2;
  const auto difference = [&](const char* keys) {
    return requestDifference(windw, {.request = request}, "windw",
                             statement(std::string("expect_call windw ") + keys).keys);
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

TEST(ScenarioServices, RealsTravelAsTheirBits) {
  const ServiceSignature macw(nc::nct::service(ServiceKind::WriteMacro));
  core::ServiceRequest request;
  request.argCount = 3;
  request.args[0] = 500;
  request.args[2] = std::bit_cast<int64_t>(3.0);
  const auto difference = [&](const char* keys) {
    return requestDifference(macw, {.request = request}, "MACW",
                             statement(std::string("expect_call MACW ") + keys).keys);
  };
  EXPECT_EQ(difference("variable=500 value=3"), "");
  EXPECT_EQ(difference("value=3.0"), "");
  EXPECT_EQ(difference("value=3.5"), "MACW: value is 3, expected 3.5");
  EXPECT_FALSE(macw.takesNoAnswer());
  const ServiceSignature macr(nc::nct::service(ServiceKind::ReadMacro));
  EXPECT_EQ(answerOf(macr, {.ticket = 1}, statement("reply value=3").results).reply.results[0],
            std::bit_cast<int64_t>(3.0));
  EXPECT_EQ(answerOf(macr, {.ticket = 1}, statement("reply value=-0.5").results).reply.results[0],
            std::bit_cast<int64_t>(-0.5));
}

TEST(ScenarioServices, WithoutAnArrowNoAnswerIsTaken) {
  const ServiceSignature move(nc::nct::service(ServiceKind::MoveAxis));
  EXPECT_TRUE(move.takesNoAnswer());
  EXPECT_GE(move.argument("Distance"), 0);
  EXPECT_EQ(move.result("distance"), -1);
}

TEST(ScenarioServices, QuantitiesOfScpGoByTheirNames) {
  const ServiceSignature scp(nc::nct::service(ServiceKind::ReadScope));
  core::ServiceRequest request;
  request.argCount = 3;
  request.args[0] = *nc::nct::findScopeSymbol("ActPosAx");
  request.args[1] = 2;
  const auto difference = [&](const char* keys) {
    return requestDifference(scp, {.request = request}, "SCP", statement(std::string("expect_call SCP ") + keys).keys);
  };
  EXPECT_EQ(difference("symbol=ActPosAx p1=2 p2=0"), "");
  EXPECT_EQ(difference("symbol=ComPosAx"), "SCP: symbol is ActPosAx, expected ComPosAx");
  EXPECT_EQ(test::lacking(difference("symbol=Position"), {"'Position'", "SCP"}), "");
}

} // namespace
} // namespace rung::scenario
