// Blocks of the host: which task takes which bytes, when, and what becomes of them when the program is replaced.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "tests/unit/runtime/test_image.h"

namespace {

using rung::test::adopted;
using testing::ElementsAre;

// X has 12 bytes at 32, of which bytes 4 and 5 are a byte a bit at 128; Y has 8 bytes at 64, of which byte 1 is a byte
// a bit at 160.
//
// A scan: MAIN, whose first part copies X0 to Y0 and whose second part copies X0 to Y2; then FAST, with X4.3 to Y1.5
// and X0 to Y3; then the host's work (what a test does there).
constexpr uint32_t kX = 32, kXBits = 128, kY = 64, kYBits = 160;

struct Host {
  std::array<uint8_t, 12> x{};
  std::array<uint8_t, 8> y{};
};
// Changes what lies in the block while the program runs: as a machine may do.
Host* machine = nullptr;

uint32_t first(uint8_t* mem, rung_ctx*, uint32_t) {
  mem[kY] = mem[kX];
  if (machine != nullptr) machine->x[0] = 77;
  return 1;
}
uint32_t second(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  mem[kY + 2] = mem[kX];
  if (mem[kX] == 200) {
    ctx->fault = {1, 0, 10, 0};
    return RUNG_PC_FAULT;
  }
  return rung::test::popChunk(ctx);
}
uint32_t fast(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  mem[kYBits + 5] = mem[kXBits + 3];
  mem[kY + 3] = mem[kX];
  return rung::test::popChunk(ctx);
}

void build(rung::test::TestProgram& program, bool hasInputs = true) {
  constexpr uint32_t kBits = RUNG_REPR_BYTE_PER_BIT;
  program.addSpace(hasInputs ? "X" : "Z", 1,
                   {{0, 4, kX, RUNG_REPR_PACKED}, {4, 2, kXBits, kBits}, {6, 6, kX + 4, RUNG_REPR_PACKED}},
                   RUNG_SPACE_INPUT);
  program.addSpace("Y", 1, {{0, 1, kY, RUNG_REPR_PACKED}, {1, 1, kYBits, kBits}, {2, 6, kY + 2, RUNG_REPR_PACKED}},
                   RUNG_SPACE_OUTPUT);
  program.addPacked("GIVEN", 1, 8, 192);
  program.addSpace("IMAGE", 1, {{0, 4, 96, RUNG_REPR_PACKED}, {4, 4, 208, RUNG_REPR_PACKED}});
  if (hasInputs) {
    program.addSymbol("INPUT", 0, 0, RUNG_TYPE_I8);
    for (const char* name : {"X1", "X3", "X5", "X11"})
      program.addSymbol(name, 0, static_cast<uint32_t>(std::atoi(name + 1)), RUNG_TYPE_I8);
    program.addSymbol("INSIDE", 0, 1, RUNG_TYPE_BIT, 3);
    program.addSymbol("OUTPUT", 1, 0, RUNG_TYPE_I8);
  }
  program.addSymbol("PLACED", 2, 2, RUNG_TYPE_I16);
  program.addSymbol("PLACED_BIT", 2, 4, RUNG_TYPE_BIT);
  program.spaces[2].flags = RUNG_SPACE_ALLOCATED;
  program.addSymbol("COPIED", 3, 0, RUNG_TYPE_I8);
  program.addConstant("FIXED", 5);
  program.addTask("MAIN", program.addChunk(&first), 1000, {1, RUNG_PC_DONE});
  program.addChunk(&second);
  program.addTask("FAST", program.addChunk(&fast));
  program.addBeginCopy(0, {RUNG_COPY_ALL, 192, 97, 0, 1}); // over IMAGE 1
  program.addReads(0, {{kX, 1}, {192, 1}});
  program.addReads(1, {{kX, 1}, {kXBits + 3, 1}});
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 1000},
                  {RUNG_STEP_PART, 0, 0},
                  {RUNG_STEP_ADVANCE, RUNG_NONE, 1000},
                  {RUNG_STEP_PART, 0, 0},
                  {RUNG_STEP_RUN, 1, 1}};
  program.link();
}

class Blocks : public testing::Test {
protected:
  Blocks() {
    build(program_);
    image_.emplace(adopted(program_));
    plc_.emplace(*image_);
    plc_->bindInputBlock("INPUT", host_.x);
    plc_->bindOutputBlock("OUTPUT", host_.y);
    plc_->powerOn();
  }
  ~Blocks() override { machine = nullptr; }
  int32_t bind(const char* name, void* address, uint32_t bytes, uint32_t direction) {
    const rung_block block{name, address, bytes, direction};
    return rung_instance_bind_blocks(plc_->handle(), &block, 1);
  }

  rung::test::TestProgram program_;
  std::optional<rung::Image> image_;
  Host host_;
  std::optional<rung::Instance> plc_;
};

TEST_F(Blocks, ATaskTakesItsBytesWhereItBegins) {
  host_.x = {1, 2, 3, 4, 0x08, 6};
  machine = &host_;
  plc_->scan();
  EXPECT_THAT(host_.y, ElementsAre(1, 0x20, 1, 77, 0, 0, 0, 0))
      << "once for both parts of MAIN; what came meanwhile is for FAST";
}

TEST_F(Blocks, WhatNoTaskReadsIsTakenBeforeASlice) {
  host_.x = {1, 2, 3, 4, 5, 0xA6, 7, 8, 9, 10, 11, 12};
  plc_->slice();
  for (const auto& [name, value] : {std::pair("X1", 2), {"X3", 4}, {"X5", 0xA6}, {"X11", 12}}) {
    std::array<uint8_t, 1> byte{};
    plc_->bindOutputBlock(name, byte);
    plc_->slice();
    EXPECT_EQ(byte[0], value) << name;
    plc_.reset();
    plc_.emplace(*image_);
    plc_->bindInputBlock("INPUT", host_.x);
    plc_->powerOn();
    plc_->slice();
  }
}

TEST_F(Blocks, OutputsAre0AfterAFaultAndThePowerOff) {
  host_.x[0] = 9;
  plc_->scan();
  EXPECT_EQ(host_.y[0], 9);
  plc_->powerOff();
  EXPECT_THAT(host_.y, testing::Each(0));
  plc_->powerOn();
  host_.x[0] = 200;
  EXPECT_EQ(rung_instance_scan(plc_->handle()), RUNG_FAULTED);
  EXPECT_THAT(host_.y, testing::Each(0));
}

TEST_F(Blocks, GoOverToAnotherProgram) {
  rung::test::TestProgram without;
  build(without, false);
  const rung::Image next = adopted(without);
  rung::Replacement change(*plc_, next);
  std::array<uint8_t, 1> late{};
  plc_->bindOutputBlock("OUTPUT", late); // the replacement gets it, too
  host_.x[0] = 9;
  plc_->scan();
  EXPECT_EQ(host_.y[0], 9);
  EXPECT_EQ(late[0], 9);
  EXPECT_EQ(plc_->replace(change), RUNG_OK);
  plc_->scan();
  EXPECT_THAT(host_.y, testing::Each(0)) << "it has no such names";
  EXPECT_EQ(late[0], 0);
  EXPECT_EQ(plc_->replace(change), RUNG_OK);
  plc_->scan();
  EXPECT_EQ(host_.y[0], 9);
  EXPECT_EQ(late[0], 9);
}

TEST_F(Blocks, WhatCannotBeBound) {
  uint8_t bytes[16] = {};
  EXPECT_EQ(bind(nullptr, bytes, 1, RUNG_TO_PROGRAM), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(bind("INPUT", nullptr, 1, RUNG_TO_PROGRAM), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(bind("INPUT", bytes, 0, RUNG_TO_PROGRAM), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(bind("INPUT", bytes, 1, 2), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(bind("NOTHING", bytes, 1, RUNG_TO_PROGRAM), RUNG_NOT_FOUND);
  EXPECT_STREQ(rung_error_text(), "NOTHING is not a name of the program test, an address of its dialect or a signal of "
                                  "the NC's interface");
  EXPECT_EQ(bind("INPUT", bytes, 13, RUNG_TO_PROGRAM), RUNG_BAD_ARGUMENT);
  EXPECT_STREQ(rung_error_text(), "there are not 13 bytes from INPUT on for a block");
  EXPECT_EQ(bind("PLACED", bytes, 3, RUNG_TO_PROGRAM), RUNG_BAD_ARGUMENT)
      << "what follows it may be elsewhere tomorrow";
  EXPECT_EQ(bind("PLACED", bytes, 2, RUNG_TO_PROGRAM), RUNG_OK);
  EXPECT_EQ(bind("INSIDE", bytes, 1, RUNG_TO_PROGRAM), RUNG_BAD_ARGUMENT);
  EXPECT_STREQ(rung_error_text(), "INSIDE does not begin with a byte: a block is made of whole bytes");
  EXPECT_EQ(bind("PLACED_BIT", bytes, 1, RUNG_FROM_PROGRAM), RUNG_BAD_ARGUMENT) << "its neighbours are others";
  EXPECT_EQ(bind("FIXED", bytes, 1, RUNG_FROM_PROGRAM), RUNG_WRONG_TYPE);
  EXPECT_EQ(bind("COPIED", bytes, 1, RUNG_TO_PROGRAM), RUNG_OK);
  EXPECT_EQ(bind("COPIED", bytes, 2, RUNG_TO_PROGRAM), RUNG_OVERWRITTEN);
  EXPECT_EQ(bind("COPIED", bytes, 2, RUNG_FROM_PROGRAM), RUNG_OK);
}

} // namespace
