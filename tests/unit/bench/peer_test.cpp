// What peers are made from: the text in their language, and how a shared object of them runs beside the others.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "codegen/cpp/cpp_emitter.h"
#include "ir/support/temporary_folder.h"
#include "tools/bench/generated/peer.h"
#include "tools/bench/generated/structured_text.h"

namespace rung {
namespace {

using bench::Op;

constexpr uint32_t kRungs = 50;
constexpr int kScans = 100;
constexpr int kMsAScan = 10;

// The statement of one element, in a program with nothing else.
std::string statementOf(const bench::Element& element) {
  bench::Work work;
  work.elements = {element};
  const Result<std::string> text = structuredText(work);
  if (!text.ok()) return text.error();
  const size_t begin = text.value().find("END_VAR\n") + 8;
  return text.value().substr(begin, text.value().find("\nEND_PROGRAM") - begin);
}

TEST(StructuredText, DeclaresWhatTheWorkNumbers) {
  bench::Work work;
  work.inputs = work.coils = 1;
  work.indices = work.realOperands = work.timers = work.counters = 1;
  work.hasTables = true;
  work.elements = {{.op = Op::Logic, .coil = 1}};
  const Result<std::string> text = structuredText(work);
  ASSERT_TRUE(text.ok()) << text.error();
  EXPECT_EQ(text.value(), R"(PROGRAM MAIN
VAR
  b0 : BOOL;
  b1 : BOOL;
  w0 : UDINT;
  r0 : LREAL;
  t0 : TON;
  c0 : DINT;
  e0 : BOOL;
  a0 : ARRAY [0..15] OF UDINT;
  a1 : ARRAY [0..15] OF UDINT;
  a2 : ARRAY [0..15] OF UDINT;
  a3 : ARRAY [0..15] OF UDINT;
END_VAR
b1 := (b0 AND b0) AND b0;
END_PROGRAM

CONFIGURATION config
  RESOURCE resource1 ON PLC
    TASK task0(INTERVAL := T#10ms, PRIORITY := 0);
    PROGRAM instance0 WITH task0 : MAIN;
  END_RESOURCE
END_CONFIGURATION
)");
}

TEST(StructuredText, HasAStatementForEachOperation) {
  EXPECT_EQ(
      statementOf({.op = Op::Logic, .parallel = true, .first = {1, true}, .second = {2}, .third = {3}, .coil = 4}),
      "b4 := (NOT b1 OR b2) AND b3;");
  EXPECT_EQ(statementOf({.op = Op::Timer, .first = {1}, .coil = 2, .number = 3, .preset = 40}),
            "t3(IN := b1, PT := T#40ms); b2 := t3.Q;");
  EXPECT_EQ(statementOf({.op = Op::Counter, .first = {1}, .second = {2}, .coil = 3, .number = 4, .preset = 5}),
            "IF b1 AND NOT e4 THEN IF c4 = 5 THEN c4 := 0; ELSE c4 := c4 + 1; END_IF; END_IF; "
            "IF b2 THEN c4 := 0; END_IF; e4 := b1; b3 := c4 = 5;");
  EXPECT_EQ(statementOf({.op = Op::Subtract, .first = {1}, .a = 2, .b = 3, .to = 4}),
            "IF b1 THEN w4 := w2 - w3; END_IF;");
  EXPECT_EQ(statementOf({.op = Op::Less, .first = {1}, .coil = 2, .a = 3, .b = 4}),
            "b2 := b1 AND (UDINT_TO_DINT(w3) < UDINT_TO_DINT(w4));");
  EXPECT_EQ(statementOf({.op = Op::RealMultiply, .first = {1}, .a = 2, .b = 3, .to = 4}),
            "IF b1 THEN r4 := r2 * r3; END_IF;");
  EXPECT_EQ(statementOf({.op = Op::TableRead, .first = {1}, .a = 2, .b = 3, .to = 4}),
            "IF b1 THEN w4 := a3[w2]; END_IF;");
  EXPECT_EQ(statementOf({.op = Op::TableWrite, .first = {1}, .a = 2, .b = 3, .to = 4}),
            "IF b1 THEN a3[w2] := w4; END_IF;");
}

TEST(StructuredText, RefusesMechanisms) {
  EXPECT_EQ(structuredText(bench::drawWork(bench::Kind::Mechanisms, 1)).error(), "Structured Text has no mechanisms");
}

TEST(PeerRungs, AreOfBitLogicAlone) {
  bench::Work work;
  work.elements = {{.op = Op::Logic, .parallel = true, .first = {1, true}, .second = {2}, .third = {3}, .coil = 4},
                   {.op = Op::Logic, .first = {5}, .second = {6, true}, .third = {7}, .coil = 8}};
  EXPECT_EQ(peerRungs(work).value(), "LOGIC(1, 1, 1, 2, 0, 3, 0, 4)\nLOGIC(0, 5, 0, 6, 1, 7, 0, 8)\n");
  work.elements.push_back({.op = Op::Timer});
  EXPECT_EQ(peerRungs(work).error(), "only bit logic is written as rungs");
}

std::string built(const std::string& source, const TemporaryFolder& folder, const char* name) {
  codegen::CppBuildOptions options;
  options.compiler = "g++";
  options.optimisation = "-O0";
  options.debugInfo = false;
  const auto image = codegen::buildCppSharedObject(source, options);
  EXPECT_TRUE(image.ok()) << image.error();
  const std::string path = (folder / name).string();
  if (image.ok()) std::ofstream(path, std::ios::binary) << image.value();
  return path;
}

// Exports what a peer does, of the straight-line form.
std::string asPeer(const bench::Work& work) {
  return straightSource(work, bench::BitForm::Byte) + R"(
#define EXPORTED extern "C" __attribute__((visibility("default")))
static Memory memory;
EXPORTED void peer_begin() { memory = {}; }
EXPORTED void peer_scan(int ms) { scan(&memory, ms); }
#define BIT(number) &memory.bit[number],
#define WORD(number) &memory.word[number],
#define ENTRY(table_, index) &memory.table[table_][index],
#define REAL(number) &memory.real[number],
EXPORTED void* peer_places[];
void* peer_places[] = {
)" + peerPlaces(work) +
         "};\n";
}

// Two sides of the same changes; the first difference.
std::string compared(const bench::Work& work, const std::string& peerSource) {
  const TemporaryFolder folder;
  auto peer = bench::Peer::load(built(peerSource, folder, "peer.so"), work, kMsAScan);
  auto straight = bench::Straight::load(built(straightSource(work, bench::BitForm::Byte), folder, "straight.so"), work,
                                        bench::BitForm::Byte, kMsAScan);
  if (!peer.ok()) return peer.error();
  if (!straight.ok()) return straight.error();
  for (int round = 0; round < 2; ++round) { // the second one begins anew
    bench::Machine machine(work);
    peer.value()->begin(machine);
    straight.value()->begin(machine);
    for (int scan = 0; scan < kScans; ++scan) {
      const bench::Change change = machine.next();
      for (bench::Side* side :
           {static_cast<bench::Side*>(peer.value().get()), static_cast<bench::Side*>(straight.value().get())}) {
        side->apply(change);
        side->scan();
      }
      if (peer.value()->values() != straight.value()->values()) return fmt::format("scan {} differs", scan);
    }
  }
  return {};
}

TEST(Peer, RunsAsTheStraightLineFormThatItIsMadeOf) {
  for (const auto kind : {bench::Kind::Full, bench::Kind::Reals, bench::Kind::Indexed}) {
    const bench::Work work = bench::drawWork(kind, kRungs);
    EXPECT_EQ(compared(work, asPeer(work)), "");
  }
}

TEST(Peer, ThatDoesSomethingElseIsFound) {
  const bench::Work work = bench::drawWork(bench::Kind::Full, kRungs);
  bench::Work other = work;
  other.elements.front().parallel = !other.elements.front().parallel;
  EXPECT_NE(compared(work, asPeer(other)), "");
}

TEST(Peer, WithoutWhatItMustExportIsRefused) {
  const TemporaryFolder folder;
  const bench::Work work = bench::drawWork(bench::Kind::Bits, 1);
  const std::string path = built(straightSource(work, bench::BitForm::Byte), folder, "straight.so");
  EXPECT_NE(bench::Peer::load(path, work, kMsAScan).error().find("peer_begin"), std::string::npos);
}

} // namespace
} // namespace rung
