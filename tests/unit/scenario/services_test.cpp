// Requests to services by the names of their arguments, reals, names of quantities and operand blocks.
#include <gtest/gtest.h>

#include <bit>

#include "rtlib/nc/nct/scope_symbols.h"
#include "tools/scenario/services.h"

namespace rung::scenario {
namespace {

Statement statement(const std::string& line) { return parse("t.scn", "program a\n" + line + "\n").statements.at(1); }

TEST(ScenarioServices, ArgumentsGoByName) {
  const ServiceSignature windr("WINDR function length -> end data");
  rt::ServiceRequest request;
  request.argCount = 2;
  request.args[0] = 5;
  request.args[1] = 4;
  EXPECT_EQ(requestDifference(windr, {.request = request}, "windr", statement("expect_call windr length=4").keys), "");
  EXPECT_NE(requestDifference(windr, {.request = request}, "windr", statement("expect_call windr length=2").keys), "");
  EXPECT_NE(requestDifference(windr, {.request = request}, "windw", {}), "");
  EXPECT_NE(requestDifference(windr, {.request = request}, "windr", statement("expect_call windr colour=2").keys)
                .find("no argument"),
            std::string::npos);
  const rt::ServiceReply reply = answerOf(windr, {.ticket = 9}, statement("reply data=77").results).reply;
  EXPECT_EQ(reply.ticket, 9u);
  EXPECT_EQ(reply.resultCount, 2u);
  EXPECT_EQ(reply.results[1], 77);
  EXPECT_EQ(answerOf(windr, {.ticket = 9}, statement("reply error=1").results).reply.state,
            uint32_t{RUNG_SERVICE_ERROR});
}

TEST(ScenarioServices, DataCompareModuloTheLength) {
  const ServiceSignature windw("windw function length data -> end");
  rt::ServiceRequest request;
  request.argCount = 3;
  request.args[0] = 0x105;
  request.args[1] = 2;
  request.args[2] = -2;
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

TEST(ScenarioServices, KeysAreThoseOfTheService) {
  const ServiceSignature windr("windr function length -> end data");
  const Statement good = statement("prepare windr function=1 LENGTH=2 -> end=0 error=1");
  EXPECT_EQ(keyProblem(windr, good.keys, good.results), "");
  const Statement argument = statement("prepare windr data=1 -> end=0");
  EXPECT_EQ(keyProblem(windr, argument.keys, argument.results),
            "windr has no argument 'data': it has function, length");
  const Statement result = statement("prepare windr function=1 -> function=1");
  EXPECT_EQ(keyProblem(windr, result.keys, result.results), "windr has no result 'function': it has end, data, error");
}

TEST(ScenarioServices, RealsTravelAsTheirBits) {
  const ServiceSignature macw("MACW variable channel value:f ->");
  rt::ServiceRequest request;
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
  const ServiceSignature macr("MACR variable channel -> value:f");
  EXPECT_EQ(answerOf(macr, {.ticket = 1}, statement("reply value=3").results).reply.results[0],
            std::bit_cast<int64_t>(3.0));
  EXPECT_EQ(answerOf(macr, {.ticket = 1}, statement("reply value=-0.5").results).reply.results[0],
            std::bit_cast<int64_t>(-0.5));
}

TEST(ScenarioServices, WithoutAnArrowNoAnswerIsTaken) {
  const ServiceSignature move("MOVCMND axis code speed:f distance:f");
  EXPECT_TRUE(move.takesNoAnswer());
  EXPECT_GE(move.argument("Distance"), 0);
  EXPECT_EQ(move.result("distance"), -1);
}

TEST(ScenarioServices, QuantitiesOfScpGoByTheirNames) {
  const ServiceSignature scp("SCP symbol p1 p2 -> value:f");
  rt::ServiceRequest request;
  request.argCount = 3;
  request.args[0] = *nc::nct::findScopeSymbol("ActPosAx");
  request.args[1] = 2;
  const auto difference = [&](const char* keys) {
    return requestDifference(scp, {.request = request}, "SCP", statement(std::string("expect_call SCP ") + keys).keys);
  };
  EXPECT_EQ(difference("symbol=ActPosAx p1=2 p2=0"), "");
  EXPECT_EQ(difference("symbol=ComPosAx"), "SCP: symbol is ActPosAx, expected ComPosAx");
  EXPECT_EQ(difference("symbol=Position"), "'Position' is not a symbol of SCP");
  const Statement prepared = statement("prepare SCP symbol=Position -> value=1");
  EXPECT_EQ(keyProblem(scp, prepared.keys, prepared.results), "'Position' is not a symbol of SCP");
}

TEST(ScenarioServices, WordsOfBlocksAreKeys) {
  const ServiceSignature mr("MR function address block -> code");
  const auto problem = [&](const char* line) {
    const Statement prepare = statement(line);
    return keyProblem(mr, prepare.keys, prepare.results);
  };
  EXPECT_EQ(problem("prepare MR function=10 address=7000 w1=3 D2=1.5 -> code=0 w4=7 d5=2"), "");
  EXPECT_EQ(problem("prepare MR w0=3 -> code=0"), "MR has no argument 'w0': it has function, address, wN, dN");
  EXPECT_EQ(problem("prepare MR w1=3 -> w512=0"), "MR has no result 'w512': it has code, wN, dN, error");
  EXPECT_EQ(problem("prepare MR d511=3 -> code=0"), "MR has no argument 'd511': it has function, address, wN, dN");
  EXPECT_EQ(problem("prepare MR w1=3 -> w4=1.5"), "w4 is one word: expected an integer, not 1.5");
  const ServiceSignature macr("MACR variable channel -> value:f");
  const Statement noBlock = statement("prepare MACR w4=1 -> value=1");
  EXPECT_EQ(keyProblem(macr, noBlock.keys, noBlock.results), "MACR has no argument 'w4': it has variable, channel");
}

} // namespace
} // namespace rung::scenario
