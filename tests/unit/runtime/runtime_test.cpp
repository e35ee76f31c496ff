// librung-runtime from C++, by its wrapper and by its functions.
#include "rung/runtime.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "tests/unit/runtime/test_image.h"

extern "C" int callEveryFunction(void* no_handle);

namespace {

using rung::test::adopted;

using testing::ElementsAre;
using testing::HasSubstr;

// Byte 0 of R counts passes, IN is latched from INPUT; at 200 the program faults, at 100 it shows message 20, and while
// ASKS is 1 it asks for a service.
constexpr uint32_t kCount = 0, kAsks = 1, kTicket = 2, kState = 3, kLatched = 48, kLamp = 64;

uint32_t work(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  if (++mem[kCount] >= 200) {
    ctx->fault = {1, 0, 10, 0};
    return RUNG_PC_FAULT;
  }
  mem[kLamp] = 1;
  if (mem[kCount] == 100) {
    const rung_message message{RUNG_MESSAGE_SHOW, 20, 0, 0, 7, 0, 0};
    ctx->host->message(ctx, &message);
  }
  const int64_t argument = 42;
  if (mem[kAsks] == 1 && mem[kTicket] == 0)
    mem[kTicket] = static_cast<uint8_t>(ctx->host->service_request(ctx, 0, &argument, 1));
  if (mem[kTicket] != 0) mem[kState] = static_cast<uint8_t>(ctx->host->service_poll(ctx, mem[kTicket]));
  return rung::test::popChunk(ctx);
}

void build(rung::test::TestProgram& program, uint32_t shift = 0) {
  program.addPacked("R", 1, 32, 0);
  program.addPacked("INPUT", 1, 16, 32);
  program.addPacked("IN", 1, 16, kLatched);
  program.addPacked("OUT", 1, 16, kLamp);
  program.addSymbol("COUNT", 0, kCount, RUNG_TYPE_I8);
  program.addSymbol("ASKS", 0, kAsks, RUNG_TYPE_I8);
  program.addSymbol("STATE", 0, kState, RUNG_TYPE_I8);
  program.addSymbol("WORDS", 0, 8 + shift, RUNG_TYPE_I16, 0, 3);
  program.addSymbol("NOTE", 0, 16, RUNG_TYPE_TEXT, 0, 8);
  program.addSymbol("SPEED", 0, 24, RUNG_TYPE_F64);
  program.addSymbol("DOOR", 1, 0, RUNG_TYPE_BIT, 3);
  program.addSymbol("LATCHED_DOOR", 2, 0, RUNG_TYPE_BIT, 3);
  program.addSymbol("LAMP", 3, 0, RUNG_TYPE_BIT, 0);
  program.addConstant("LIMIT", -5);
  program.retains = {{8, 8}};
  program.safeSpans = {{kLamp, 16}};
  program.addTask("MAIN", program.addChunk(&work));
  program.addBeginCopy(0, {RUNG_COPY_ALL, 32, kLatched, 0, 16});
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_RUN, 0, 1}};
  program.link();
}

template <class Call>
int32_t statusOf(Call call) {
  try {
    call();
  } catch (const rung::Error& error) {
    return error.status();
  }
  return RUNG_OK;
}

class Runtime : public testing::Test {
protected:
  Runtime() {
    build(program_);
    image_.emplace(adopted(program_));
  }
  rung::Instance started(const rung_instance_options* options = nullptr) {
    rung::Instance plc(*image_, options);
    plc.powerOn();
    return plc;
  }
  static void scan(rung::Instance& plc, int count = 1) {
    for (int i = 0; i < count; ++i) plc.scan();
  }

  rung::test::TestProgram program_;
  std::optional<rung::Image> image_;
};

TEST_F(Runtime, CallsFromC) {
  std::array<uint64_t, 64> noHandle{};
  EXPECT_EQ(callEveryFunction(noHandle.data()), 0);
  // A handle of another kind is none.
  const rung::Instance plc(*image_);
  EXPECT_EQ(rung_image_close(reinterpret_cast<rung_image*>(plc.handle())), RUNG_BAD_HANDLE);
  EXPECT_EQ(rung_instance_scan(reinterpret_cast<rung_instance*>(image_->handle())), RUNG_BAD_HANDLE);
}

constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

bool isOfTheInterface(std::string_view function) {
  for (const std::string_view kind : {"rung_image_", "rung_instance_", "rung_replacement_", "rung_watch_",
                                      "rung_trace_", "rung_shadow_", "rung_forces_"})
    if (function.starts_with(kind) && function.size() > kind.size()) return true;
  return function == "rung_error_text" || function == "rung_runtime_version";
}

std::set<std::string> functionsIn(const char* path) {
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  std::set<std::string> names;
  for (size_t end = text.find('('); end != std::string::npos; end = text.find('(', end + 1)) {
    const size_t before = end == 0 ? std::string::npos : text.find_last_not_of(kLetters, end - 1);
    const size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string name = text.substr(begin, end - begin);
    if (isOfTheInterface(name)) names.insert(name);
  }
  return names;
}

TEST(RuntimeHeader, EveryFunctionIsCalledFromC) {
  const std::set<std::string> declared = functionsIn(RUNG_TEST_HEADER);
  const std::set<std::string> called = functionsIn(RUNG_TEST_FILE);
  EXPECT_GT(declared.size(), 40u);
  for (const std::string& name : declared) EXPECT_TRUE(called.contains(name)) << name;
}

// Functions and those that are given to others; comments aside.
std::set<std::string> namesIn(const char* path) {
  std::ifstream file(path);
  std::set<std::string> names;
  for (std::string line; std::getline(file, line);) {
    line.resize(std::min(line.find("//"), line.size()));
    for (size_t begin = line.find("rung_"); begin != std::string::npos;) {
      const size_t end = std::min(line.find_first_not_of(kLetters, begin), line.size());
      names.insert(line.substr(begin, end - begin));
      begin = line.find("rung_", end);
    }
  }
  return names;
}

TEST(RuntimeHeader, EveryFunctionIsReachedFromCpp) {
  const std::set<std::string> reached = namesIn(RUNG_TEST_CPP_HEADER);
  for (const std::string& name : functionsIn(RUNG_TEST_HEADER)) EXPECT_TRUE(reached.contains(name)) << name;
}

TEST_F(Runtime, RunsByTheClockOfItsHost) {
  rung::Instance plc(*image_);
  EXPECT_EQ(plc.runDue(0), RUNG_WRONG_STATE) << "off";
  EXPECT_THAT(rung_error_text(), HasSubstr("power_on"));
  plc.powerOn();
  const rung_cell count = plc.find("COUNT");
  EXPECT_EQ(plc.state().wait_ns, 4'000'000);
  for (int ms = 0; ms < 16; ++ms) EXPECT_EQ(plc.runDue(1'000'000), RUNG_OK);
  EXPECT_EQ(plc.read<int>(count), 2);
  EXPECT_EQ(plc.state().scans, 2u);
  EXPECT_EQ(plc.state().now_us, 16000);
  EXPECT_EQ(plc.runDue(240'000'000), RUNG_OK) << "one pass, and the time of all";
  EXPECT_EQ(plc.state().missed, 30u - 1u);
  EXPECT_EQ(plc.state().now_us, 16000 + 240000) << "timers stay right";
  EXPECT_EQ(plc.runDue(-1), RUNG_BAD_ARGUMENT);
}

TEST_F(Runtime, StopsAndStarts) {
  rung::Instance plc = started();
  const rung_cell count = plc.find("COUNT");
  plc.stop();
  scan(plc, 3);
  EXPECT_EQ(plc.read<int>(count), 0);
  EXPECT_EQ(plc.state().flags & RUNG_STATE_STOPPED, uint32_t{RUNG_STATE_STOPPED});
  plc.start();
  scan(plc, 3);
  EXPECT_EQ(plc.read<int>(count), 3);
}

TEST_F(Runtime, OutputsAreOffUntilTheFirstSlice) {
  rung::Instance plc = started();
  bool lamp = false;
  plc.bindOutput("LAMP", lamp);
  scan(plc, 199);
  EXPECT_TRUE(lamp);
  plc.powerOn();
  EXPECT_FALSE(lamp);
}

TEST_F(Runtime, AFaultIsDescribed) {
  rung::Instance plc = started();
  bool lamp = false;
  plc.bindOutput("LAMP", lamp);
  scan(plc, 199);
  EXPECT_TRUE(lamp);
  EXPECT_FALSE(plc.fault());
  EXPECT_EQ(plc.scan(), RUNG_FAULTED);
  EXPECT_EQ(plc.runDue(8'000'000), RUNG_FAULTED);
  EXPECT_FALSE(lamp) << "safe";
  const std::optional<rung_fault_info> fault = plc.fault();
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault->code, "division by zero");
  EXPECT_STREQ(fault->file, "main.pmc");
  EXPECT_STREQ(fault->task, "MAIN");
  EXPECT_EQ(fault->line, 10u);
  EXPECT_STREQ(fault->text, "division by zero (rung 1, main.pmc:10)");
  EXPECT_EQ(plc.state().flags & RUNG_STATE_FAULTED, uint32_t{RUNG_STATE_FAULTED});
  plc.powerOn();
  EXPECT_EQ(plc.scan(), RUNG_OK);
}

TEST_F(Runtime, NamesAndValues) {
  rung::Instance plc = started();
  const rung_cell words = plc.find("WORDS", rung::Access::Write);
  EXPECT_EQ(words, plc.find("WORDS", rung::Access::Write)) << "the same name";
  plc.write(words, -2, 0);
  plc.write(words, 70000, 2); // its lowest 16 bits
  EXPECT_EQ(plc.read<int>(words, 0), -2);
  EXPECT_EQ(plc.read<uint16_t>(words, 0), 65534);
  EXPECT_EQ(plc.read<int>(words, 2), 70000 - 65536);
  EXPECT_EQ(plc.read<int>(plc.find("WORDS[2]")), 70000 - 65536);
  EXPECT_EQ(statusOf([&] { plc.read<int>(words, 3); }), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(statusOf([&] { plc.write(plc.find("WORDS"), 1); }), RUNG_WRONG_TYPE) << "found for reading";

  const rung_cell speed = plc.find("SPEED", rung::Access::Write);
  plc.write(speed, 1.5);
  EXPECT_EQ(plc.read<double>(speed), 1.5);
  EXPECT_EQ(plc.read<int>(plc.find("LIMIT")), -5);
  EXPECT_EQ(statusOf([&] { plc.find("LIMIT", rung::Access::Write); }), RUNG_WRONG_TYPE);
  EXPECT_EQ(statusOf([&] { plc.find("NOBODY"); }), RUNG_NOT_FOUND);
  EXPECT_EQ(statusOf([&] { plc.read<int>(12345); }), RUNG_BAD_ARGUMENT);

  const rung_cell note = plc.find("NOTE", rung::Access::Write);
  plc.setText(note, "a long text");
  EXPECT_EQ(plc.text(note), "a long t");
  EXPECT_EQ(statusOf([&] { plc.read<int>(note); }), RUNG_WRONG_TYPE);
  EXPECT_EQ(statusOf([&] { plc.text(speed); }), RUNG_WRONG_TYPE);
  char cut[4];
  EXPECT_EQ(rung_instance_read_text(plc.handle(), note, cut, sizeof cut), RUNG_OK);
  EXPECT_STREQ(cut, "a l");

  const rung_cell_info info = plc.describe(plc.find("DOOR", rung::Access::Write));
  EXPECT_EQ(info.type, uint32_t{RUNG_TYPE_BIT});
  EXPECT_STREQ(info.address, "INPUT+0.3");
}

TEST_F(Runtime, CellsThatAreReleasedTakeNoRoom) {
  rung::Instance plc = started();
  const rung_cell count = plc.find("COUNT");
  EXPECT_EQ(plc.find("COUNT"), count);
  EXPECT_EQ(rung_instance_release(plc.handle(), count), RUNG_OK);
  EXPECT_EQ(plc.read<int>(count), 0) << "it was found twice";
  EXPECT_EQ(rung_instance_release(plc.handle(), count), RUNG_OK);
  EXPECT_EQ(rung_instance_release(plc.handle(), count), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(statusOf([&] { plc.read<int>(count); }), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(plc.find("DOOR"), count) << "its number is free";
  const rung_cell last = plc.find("SPEED");
  for (int i = 0; i < 100'000; ++i) {
    const rung_cell words = plc.find("WORDS");
    ASSERT_EQ(words, last + 1);
    ASSERT_EQ(rung_instance_release(plc.handle(), words), RUNG_OK);
  }
}

TEST_F(Runtime, CellsOfOthersStay) {
  rung::Instance plc = started();
  const rung_cell count = plc.find("COUNT");
  const rung::Watch watch(plc, {{count}});
  EXPECT_EQ(rung_instance_release(plc.handle(), count), RUNG_OK);
  EXPECT_EQ(plc.read<int>(count), 0) << "the watch has it";
}

TEST_F(Runtime, WhatALatchOverwritesIsNotWritten) {
  rung::Instance plc = started();
  EXPECT_EQ(statusOf([&] { plc.find("LATCHED_DOOR", rung::Access::Write); }), RUNG_OVERWRITTEN);
  EXPECT_THAT(rung_error_text(), HasSubstr("INPUT+0.3 (DOOR)"));
  EXPECT_EQ(plc.read<bool>(plc.find("LATCHED_DOOR")), false);
}

TEST_F(Runtime, ManyCellsInOneCall) {
  rung::Instance plc = started();
  const rung_cell cells[] = {plc.find("ASKS", rung::Access::Write), plc.find("SPEED", rung::Access::Write)};
  rung_value values[] = {{.integer = 3}, {.real = 2.5}};
  ASSERT_EQ(rung_instance_write_all(plc.handle(), cells, 2, values), RUNG_OK);
  rung_value read[2] = {};
  ASSERT_EQ(rung_instance_read_all(plc.handle(), cells, 2, read), RUNG_OK);
  EXPECT_EQ(read[0].integer, 3);
  EXPECT_EQ(read[1].real, 2.5);
  const rung_cell bad[] = {cells[0], 999};
  values[0].integer = 9;
  EXPECT_EQ(rung_instance_write_all(plc.handle(), bad, 2, values), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(plc.read<int>(cells[0]), 3) << "all or nothing";
}

TEST_F(Runtime, SymbolsOfAnImage) {
  auto symbol = rung::sized<rung_symbol_info>();
  std::vector<std::string> names;
  for (uint32_t i = 0; rung_image_symbol(image_->handle(), i, &symbol) == RUNG_OK; ++i) names.emplace_back(symbol.name);
  EXPECT_THAT(names,
              ElementsAre("ASKS", "COUNT", "DOOR", "LAMP", "LATCHED_DOOR", "LIMIT", "NOTE", "SPEED", "STATE", "WORDS"));
  ASSERT_EQ(rung_image_symbol(image_->handle(), 5, &symbol), RUNG_OK);
  EXPECT_EQ(symbol.space, RUNG_NONE);
  EXPECT_EQ(symbol.value, -5);
}

TEST_F(Runtime, BoundVariables) {
  rung::Instance plc(*image_);
  bool door = true;
  float speed = 2.5;
  uint8_t passes = 0;
  double shown = 0;
  int16_t rounded = 0;
  plc.bindInput("DOOR", door);
  plc.bindInput("SPEED", speed, 1000);
  plc.bindOutput("COUNT", passes);
  plc.bindOutput("SPEED", shown, 1000);
  plc.bindOutput("SPEED", rounded);
  int64_t limit = 0;
  plc.bindOutput("LIMIT", limit);
  plc.powerOn();
  scan(plc, 3);
  EXPECT_TRUE(plc.read<bool>(plc.find("LATCHED_DOOR")));
  EXPECT_EQ(plc.read<double>(plc.find("SPEED")), 2500);
  EXPECT_EQ(passes, 3);
  EXPECT_EQ(shown, 2.5);
  EXPECT_EQ(rounded, 2500);
  EXPECT_EQ(limit, -5) << "a constant";
  plc.powerOff();
  EXPECT_EQ(passes, 0) << "off";
  EXPECT_EQ(statusOf([&] { plc.bindInput("NOTE", door); }), RUNG_WRONG_TYPE);
  EXPECT_EQ(statusOf([&] { plc.bindInput("LATCHED_DOOR", door); }), RUNG_OVERWRITTEN);
  int32_t words[2];
  rung_variable odd{"COUNT", reinterpret_cast<char*>(words) + 1, RUNG_HOST_I32, RUNG_FROM_PROGRAM, 0};
  EXPECT_EQ(rung_instance_bind(plc.handle(), &odd, 1), RUNG_BAD_ARGUMENT);
  odd = {"COUNT", words, 77, RUNG_FROM_PROGRAM, 0};
  EXPECT_EQ(rung_instance_bind(plc.handle(), &odd, 1), RUNG_BAD_ARGUMENT);
}

// The next program copies another place over the cell: the host reads it all the same.
TEST_F(Runtime, ABoundOutputStaysOneWhereItIsOverwritten) {
  rung::test::TestProgram plain;
  build(plain);
  plain.tasks[0].begin_count = 0;
  plain.link();
  const rung::Image image = adopted(plain);
  rung::Instance plc(image);
  bool latched = false;
  plc.bindOutput("LATCHED_DOOR", latched);
  plc.powerOn();
  const rung::Replacement change(plc, *image_);
  ASSERT_EQ(plc.replace(change), RUNG_OK);
  plc.write(plc.find("DOOR", rung::Access::Write), true);
  scan(plc);
  EXPECT_TRUE(latched);
}

TEST_F(Runtime, Messages) {
  rung::Instance plc = started();
  EXPECT_FALSE(plc.nextMessage());
  scan(plc, 100);
  const std::optional<rung_message_info> message = plc.nextMessage();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->op, uint32_t{RUNG_MESSAGE_SHOW});
  EXPECT_EQ(message->value.integer, 7);
  EXPECT_STREQ(message->text, "20 Mount tool");
  EXPECT_FALSE(plc.nextMessage());
}

struct Answering {
  int32_t how = RUNG_REFUSE;
  std::string service;
  int64_t argument = 0;
  int faults = 0;
  int32_t written = 0, read = 0;
  rung_cell cell = 0;

  rung_instance_options options() {
    auto given = rung::sized<rung_instance_options>();
    given.user = this;
    given.request = [](void* user, rung_instance* plc, const rung_request* request, rung_reply* reply) {
      auto& self = *static_cast<Answering*>(user);
      self.service = request->service;
      self.argument = request->args[0];
      rung_value value{};
      self.read = rung_instance_read(plc, self.cell, 0, 1, &value);
      self.written = rung_instance_write(plc, self.cell, 0, 1, &value);
      reply->result_count = 1;
      return self.how;
    };
    given.fault = [](void* user, rung_instance* plc) {
      auto fault = rung::sized<rung_fault_info>();
      if (rung_instance_fault(plc, &fault) == RUNG_OK) ++static_cast<Answering*>(user)->faults;
    };
    return given;
  }
};

TEST_F(Runtime, RequestsAreAnsweredInTheScan) {
  Answering host{.how = RUNG_ANSWER};
  const rung_instance_options options = host.options();
  rung::Instance plc = started(&options);
  host.cell = plc.find("ASKS", rung::Access::Write);
  plc.write(host.cell, 1);
  scan(plc);
  EXPECT_EQ(host.service, "WINDR");
  EXPECT_EQ(host.argument, 42);
  EXPECT_EQ(host.read, RUNG_OK);
  EXPECT_EQ(host.written, RUNG_WRONG_STATE) << "a callback may only read";
  EXPECT_EQ(plc.read<int>(plc.find("STATE")), RUNG_SERVICE_DONE);
  scan(plc, 200);
  EXPECT_EQ(host.faults, 1);
}

TEST_F(Runtime, RequestsWaitForAnAnswer) {
  auto options = rung::sized<rung_instance_options>();
  options.flags = RUNG_QUEUE_REQUESTS;
  rung::Instance plc = started(&options);
  plc.write(plc.find("ASKS", rung::Access::Write), 1);
  auto request = rung::sized<rung_request>();
  EXPECT_EQ(rung_instance_next_request(plc.handle(), &request), RUNG_EMPTY);
  scan(plc);
  ASSERT_EQ(rung_instance_next_request(plc.handle(), &request), RUNG_OK);
  EXPECT_STREQ(request.service, "WINDR");
  scan(plc);
  EXPECT_EQ(plc.read<int>(plc.find("STATE")), RUNG_SERVICE_PENDING);
  auto reply = rung::sized<rung_reply>();
  reply.ticket = request.ticket;
  reply.error = 1;
  EXPECT_EQ(rung_instance_answer(plc.handle(), &reply), RUNG_OK);
  scan(plc);
  EXPECT_EQ(plc.read<int>(plc.find("STATE")), RUNG_SERVICE_ERROR);
  reply.result_count = 17;
  EXPECT_EQ(rung_instance_answer(plc.handle(), &reply), RUNG_BAD_ARGUMENT);
}

TEST_F(Runtime, WithoutAHostRequestsAreRefused) {
  rung::Instance plc = started();
  plc.write(plc.find("ASKS", rung::Access::Write), 1);
  scan(plc);
  EXPECT_EQ(plc.read<int>(plc.find("STATE")), RUNG_SERVICE_ERROR);
}

TEST_F(Runtime, MemoryOfTheHost) {
  alignas(64) std::array<uint8_t, 256> block{};
  auto options = rung::sized<rung_instance_options>();
  options.memory = block.data();
  options.memory_bytes = block.size() - 1;
  EXPECT_EQ(statusOf([&] { rung::Instance(*image_, &options); }), RUNG_BAD_ARGUMENT);
  options.memory_bytes = block.size();
  rung::Instance plc = started(&options);
  scan(plc, 5);
  EXPECT_EQ(block[kCount], 5);
}

TEST_F(Runtime, TouchingChangesNothing) {
  alignas(64) std::array<uint8_t, 256> block{};
  auto options = rung::sized<rung_instance_options>();
  options.memory = block.data();
  options.memory_bytes = block.size();
  rung::Instance plc(*image_, &options);
  EXPECT_EQ(rung_instance_prefetch(plc.handle(), INT64_MAX), RUNG_OK); // before the power-on, too
  plc.powerOn();
  scan(plc, 3);
  const std::array<uint8_t, 256> before = block;
  for (const int64_t until : {INT64_MIN, int64_t{0}, INT64_MAX})
    EXPECT_EQ(rung_instance_prefetch(plc.handle(), until), RUNG_OK);
  EXPECT_EQ(block, before);
  EXPECT_EQ(plc.state().scans, 3u);
}

// A disk that fails, and works again.
TEST_F(Runtime, WhyMemoryIsNotSavedIsToBeRead) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "rung_runtime_unsaved";
  std::filesystem::create_directory(folder);
  rung::Instance plc(*image_);
  plc.keep((folder / "retained").string());
  plc.powerOn();
  char text[256] = "nothing";
  EXPECT_EQ(rung_instance_unsaved(plc.handle(), text, sizeof text), RUNG_EMPTY);
  EXPECT_EQ(rung_instance_unsaved(plc.handle(), text, 0), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_instance_unsaved(plc.handle(), nullptr, 1), RUNG_BAD_ARGUMENT);
  std::filesystem::remove_all(folder);
  scan(plc);
  EXPECT_EQ(rung_instance_flush(plc.handle()), RUNG_FAILED);
  EXPECT_NE(plc.state().flags & RUNG_STATE_UNSAVED, 0u);
  EXPECT_EQ(rung_instance_unsaved(plc.handle(), text, sizeof text), RUNG_OK);
  EXPECT_THAT(text, HasSubstr("rung_runtime_unsaved"));
  EXPECT_EQ(rung_instance_unsaved(plc.handle(), text, 4), RUNG_OK);
  EXPECT_EQ(std::strlen(text), 3u);
  std::filesystem::create_directory(folder);
  scan(plc);
  EXPECT_EQ(rung_instance_flush(plc.handle()), RUNG_OK);
  EXPECT_EQ(rung_instance_unsaved(plc.handle(), text, sizeof text), RUNG_EMPTY);
}

TEST_F(Runtime, RetainedMemoryIsKept) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "rung_runtime_keep";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  const auto run = [&](int value) {
    rung::Instance plc(*image_);
    plc.keep((folder / "retained").string());
    plc.powerOn();
    const rung_cell words = plc.find("WORDS", rung::Access::Write);
    const int before = plc.read<int>(words);
    plc.write(words, value);
    scan(plc);
    EXPECT_EQ(rung_instance_flush(plc.handle()), RUNG_OK);
    EXPECT_GE(plc.state().saves, 1u);
    plc.powerOff();
    return before;
  };
  EXPECT_EQ(run(11), 0);
  EXPECT_EQ(run(12), 11);
  rung::Instance plc(*image_);
  plc.keep((folder / "nowhere" / "retained").string());
  EXPECT_EQ(statusOf([&] { plc.powerOn(); }), RUNG_FAILED);
  EXPECT_THAT(rung_error_text(), HasSubstr("nowhere"));
  std::filesystem::remove_all(folder);
}

TEST_F(Runtime, AnotherProgramTakesOver) {
  rung::Instance plc = started();
  uint8_t passes = 0;
  plc.bindOutput("COUNT", passes);
  const rung_cell words = plc.find("WORDS", rung::Access::Write);
  const rung_cell speed = plc.find("SPEED");
  plc.write(words, 77);
  scan(plc, 4);
  rung::test::TestProgram next;
  build(next, 2); // WORDS has moved
  std::erase_if(next.symbols, [](const rung_symbol& s) { return std::strcmp(s.name, "SPEED") == 0; });
  next.link();
  const rung::Image image = adopted(next);
  rung::Replacement change(plc, image);
  EXPECT_EQ(change.report().changes, 2u);
  std::vector<std::string> changed;
  for (const rung_change& c : change.changes()) changed.emplace_back(c.name);
  EXPECT_THAT(changed, ElementsAre("SPEED", "WORDS"));
  const rung_cell later = plc.find("STATE"); // found while the change is prepared
  plc.slice();
  EXPECT_EQ(plc.replace(change), RUNG_LATER);
  EXPECT_STREQ(rung_error_text(), "the program is within a scan");
  scan(plc);
  ASSERT_EQ(plc.replace(change), RUNG_OK);
  EXPECT_EQ(plc.state().generation, 1u);
  EXPECT_EQ(plc.describe(words).byte, 10u);
  EXPECT_EQ(plc.read<int>(words), 77);
  EXPECT_EQ(plc.read<int>(later), 0);
  EXPECT_EQ(statusOf([&] { plc.read<double>(speed); }), RUNG_NOT_FOUND) << "the new program does not have it";
  scan(plc);
  EXPECT_EQ(passes, 6);
  ASSERT_EQ(plc.replace(change), RUNG_OK) << "back again";
  EXPECT_EQ(plc.describe(words).byte, 8u);
  EXPECT_EQ(plc.read<double>(speed), 0);
}

// The machine's clock is not waited for: a slice of a thousand million steps is too long everywhere.
TEST_F(Runtime, AProgramThatMayBeLateIsRefused) {
  rung::Instance plc = started();
  rung::test::TestProgram next;
  build(next);
  next.tasks[0].longest = 1'000'000'000;
  next.link();
  const rung::Image image = adopted(next);
  rung::Replacement change(plc, image);
  EXPECT_EQ(change.report().steps, 1'000'000'000u);
  EXPECT_EQ(change.report().period_ns, 4'000'000u);
  EXPECT_GT(change.report().slice_ns, change.report().period_ns);
  EXPECT_EQ(plc.replace(change), RUNG_REFUSED);
  EXPECT_THAT(rung_error_text(), HasSubstr("1000000000 steps of "));
  EXPECT_THAT(rung_error_text(), HasSubstr("the period is 4 ms"));
  change.allowLate();
  ASSERT_EQ(plc.replace(change), RUNG_OK);
  ASSERT_EQ(plc.replace(change), RUNG_OK) << "back again";
  rung::Replacement there(plc, image);
  there.allowLate();
  ASSERT_EQ(plc.replace(there), RUNG_OK);
}

uint32_t workOtherwise(uint8_t* mem, rung_ctx* ctx, uint32_t chunk) {
  const uint32_t next = work(mem, ctx, chunk);
  mem[kLamp] = mem[kCount] < 7 ? 1 : 0;
  return next;
}

TEST_F(Runtime, AProgramRunsBesideTheOneThatRuns) {
  rung::Instance plc = started();
  rung::test::TestProgram next;
  build(next, 2); // WORDS has moved
  next.functions[0] = &workOtherwise;
  next.link();
  const rung::Image image = adopted(next);
  rung::Shadow shadow(plc, image, 20, 4);
  EXPECT_FALSE(shadow.work());
  EXPECT_EQ(shadow.report().state, RUNG_SHADOW_PREPARED);
  scan(plc, 2);
  ASSERT_EQ(plc.beginShadow(shadow), RUNG_OK);
  EXPECT_EQ(plc.beginShadow(shadow), RUNG_WRONG_STATE) << "it has one";
  plc.write(plc.find("ASKS", rung::Access::Write), 1);
  for (int i = 0; i < 8; ++i) {
    scan(plc);
    EXPECT_TRUE(shadow.work());
    EXPECT_FALSE(shadow.work());
  }
  const rung_shadow_info report = shadow.report();
  EXPECT_EQ(report.state, RUNG_SHADOW_RUNNING);
  EXPECT_EQ(report.runs, 8u);
  EXPECT_STREQ(report.fault, "");
  const std::vector<rung_difference> differences = shadow.differences();
  ASSERT_EQ(differences.size(), report.differences);
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_STREQ(differences[0].name, "LAMP");
  EXPECT_EQ(differences[0].type, RUNG_TYPE_BIT);
  EXPECT_EQ(differences[0].running.integer, 1);
  EXPECT_EQ(differences[0].next.integer, 0);
  EXPECT_EQ(differences[0].runs, 4u);
  EXPECT_EQ(differences[0].first_us, 7 * 8000);
  EXPECT_EQ(plc.read<int>(plc.find("LAMP")), 1);
  ASSERT_EQ(plc.endShadow(), RUNG_OK);
  EXPECT_EQ(shadow.report().state, RUNG_SHADOW_STOPPED);
  EXPECT_EQ(plc.beginShadow(shadow), RUNG_WRONG_STATE) << "once";
}

TEST_F(Runtime, AShadowFitsItsInstance) {
  rung::Instance plc = started();
  rung::Instance other = started();
  rung::test::TestProgram next, foreign;
  build(next);
  build(foreign);
  foreign.dialect = "other";
  foreign.link();
  next.scan[0].arg = 5000;
  next.link();
  const rung::Image image = adopted(next);
  const rung::Image strange = adopted(foreign);
  EXPECT_EQ(statusOf([&] { rung::Shadow(plc, image, 1); }), RUNG_REFUSED);
  EXPECT_THAT(rung_error_text(), HasSubstr("schedule"));
  EXPECT_EQ(statusOf([&] { rung::Shadow(plc, strange, 1); }), RUNG_REFUSED);
  EXPECT_EQ(statusOf([&] { rung::Shadow(plc, *image_, 0); }), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(statusOf([&] { rung::Shadow(plc, *image_, 1, 5000); }), RUNG_BAD_ARGUMENT);
  const rung::Shadow shadow(plc, *image_, 1);
  EXPECT_EQ(other.beginShadow(shadow), RUNG_BAD_ARGUMENT);
  plc.slice();
  EXPECT_EQ(plc.beginShadow(shadow), RUNG_LATER);
  plc.slice();
  EXPECT_EQ(plc.beginShadow(shadow), RUNG_OK);
  plc.powerOn();
  rung_shadow_info report{.size = sizeof report};
  ASSERT_EQ(rung_shadow_report(shadow.handle(), &report), RUNG_OK);
  EXPECT_EQ(report.state, RUNG_SHADOW_STOPPED);
}

TEST_F(Runtime, RetainedMemoryOfANewProgram) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "rung_runtime_change";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  rung::test::TestProgram next;
  build(next);
  next.retains = {{6, 12}}; // more than the first program
  next.link();
  const rung::Image image = adopted(next);
  {
    rung::Instance plc(*image_);
    plc.keep((folder / "retained").string());
    plc.powerOn();
    plc.write(plc.find("WORDS", rung::Access::Write), 5);
    rung::Replacement change(plc, image);
    scan(plc);
    ASSERT_EQ(plc.replace(change), RUNG_OK);
    plc.write(plc.find("WORDS", rung::Access::Write), 6);
    plc.setText(plc.find("NOTE", rung::Access::Write), "ab");
    scan(plc);
    plc.powerOff();
  }
  rung::Instance plc(image);
  plc.keep((folder / "retained").string());
  plc.powerOn();
  EXPECT_EQ(plc.read<int>(plc.find("WORDS")), 6);
  EXPECT_EQ(plc.text(plc.find("NOTE")), "ab");
  std::filesystem::remove_all(folder);
}

TEST_F(Runtime, AReplacementFitsItsInstance) {
  rung::Instance plc = started();
  rung::Instance other = started();
  rung::test::TestProgram next, foreign;
  build(next);
  build(foreign);
  foreign.dialect = "other";
  foreign.link();
  const rung::Image image = adopted(next);
  const rung::Image foreignImage = adopted(foreign);
  rung::Replacement change(plc, image), second(plc, image);
  EXPECT_EQ(other.replace(change), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(statusOf([&] { rung::Replacement(plc, foreignImage); }), RUNG_REFUSED);
  ASSERT_EQ(plc.replace(change), RUNG_OK);
  EXPECT_EQ(plc.replace(second), RUNG_WRONG_STATE) << "made for the former program";
}

TEST_F(Runtime, ImagesStayAsLongAsTheyAreUsed) {
  int released = 0;
  rung_image* image = nullptr;
  ASSERT_EQ(rung_image_adopt(
                &program_.program, nullptr, [](void* owner) { ++*static_cast<int*>(owner); }, &released, &image),
            RUNG_OK);
  {
    const rung::Image handle(image);
    rung_instance* plc = nullptr;
    ASSERT_EQ(rung_instance_new(image, nullptr, &plc), RUNG_OK);
    rung_instance_free(plc);
    EXPECT_EQ(released, 0);
  }
  EXPECT_EQ(released, 1);
  rung::test::TestProgram wrong;
  build(wrong);
  wrong.program.abi_version = 3;
  EXPECT_EQ(rung_image_adopt(&wrong.program, nullptr, [](void*) { FAIL(); }, nullptr, &image), RUNG_REFUSED);
  EXPECT_THAT(rung_error_text(), HasSubstr("ABI version 3"));
}

TEST_F(Runtime, FilesThatAreNoPrograms) {
  EXPECT_EQ(statusOf([] { rung::Image("/nowhere/program.so"); }), RUNG_REFUSED);
  EXPECT_THAT(rung_error_text(), HasSubstr("/nowhere/program.so"));
}

TEST_F(Runtime, TextsAreCutBetweenCharacters) {
  rung::Instance plc = started();
  std::string name;
  while (name.size() < 400) name += "\u010d\u20ac"; // two and three bytes
  for (const std::string before : {"", "a", "ab", "abc", "abcd"}) {
    EXPECT_EQ(statusOf([&] { plc.find(before + name); }), RUNG_NOT_FOUND);
    const std::string said = rung_error_text();
    EXPECT_GT(said.size(), 310u);
    EXPECT_TRUE(said.ends_with("\u010d") || said.ends_with("\u20ac")) << said;
  }
}

TEST_F(Runtime, SizesOfStructs) {
  rung::Instance plc = started();
  rung_state state{};
  EXPECT_EQ(rung_instance_state(plc.handle(), &state), RUNG_BAD_ARGUMENT) << "no size";
  EXPECT_EQ(rung_instance_state(plc.handle(), nullptr), RUNG_BAD_ARGUMENT);
  struct {
    rung_state known;
    uint64_t unknown;
  } newer{};
  newer.known.size = sizeof newer;
  newer.unknown = 5;
  EXPECT_EQ(rung_instance_state(plc.handle(), &newer.known), RUNG_OK);
  EXPECT_EQ(newer.unknown, 0u) << "what the library does not know";
  EXPECT_EQ(newer.known.size, sizeof newer);
  struct {
    uint32_t size, flags;
    uint64_t behind;
  } older{8, 0, 0x1234};
  EXPECT_EQ(rung_instance_state(plc.handle(), reinterpret_cast<rung_state*>(&older)), RUNG_OK);
  EXPECT_EQ(older.flags & RUNG_STATE_ON, uint32_t{RUNG_STATE_ON});
  EXPECT_EQ(older.behind, 0x1234u) << "what the host does not know";
}

// Half of a pointer is none.
TEST_F(Runtime, ASizeThatCutsAPointer) {
  auto options = rung::sized<rung_instance_options>();
  options.log = [](void*, int32_t, const char*) {};
  constexpr size_t kLog = offsetof(rung_instance_options, log);
  for (size_t size = kLog; size <= kLog + sizeof options.log; ++size) {
    options.size = static_cast<uint32_t>(size);
    rung_instance* made = nullptr;
    const bool isWhole = size == kLog || size == kLog + sizeof options.log;
    EXPECT_EQ(rung_instance_new(image_->handle(), &options, &made), isWhole ? RUNG_OK : RUNG_BAD_ARGUMENT) << size;
    EXPECT_EQ(rung_instance_free(made), RUNG_OK);
  }
}

TEST_F(Runtime, OneThreadAtATime) {
  std::atomic<bool> inside{false}, go{false};
  struct Waiting {
    std::atomic<bool>*inside, *go;
  } waiting{&inside, &go};
  auto options = rung::sized<rung_instance_options>();
  options.user = &waiting;
  options.request = [](void* user, rung_instance*, const rung_request*, rung_reply*) -> int32_t {
    auto& both = *static_cast<Waiting*>(user);
    *both.inside = true;
    while (!*both.go) std::this_thread::yield();
    return RUNG_REFUSE;
  };
  rung::Instance plc = started(&options);
  plc.write(plc.find("ASKS", rung::Access::Write), 1);
  std::thread scanning([&] { plc.scan(); });
  while (!inside) std::this_thread::yield();
  EXPECT_EQ(rung_instance_scan(plc.handle()), RUNG_WRONG_THREAD);
  EXPECT_EQ(rung_instance_free(plc.handle()), RUNG_WRONG_THREAD);
  EXPECT_FALSE(plc.nextMessage()) << "any thread may take messages";
  EXPECT_EQ(plc.describe(plc.find("COUNT")).type, uint32_t{RUNG_TYPE_I8}) << "and look up names";
  rung::test::TestProgram next;
  build(next);
  const rung::Image image = adopted(next);
  const rung::Replacement change(plc, image); // prepared meanwhile
  go = true;
  scanning.join();
  EXPECT_EQ(rung_instance_scan(plc.handle()), RUNG_OK);
}

TEST_F(Runtime, APassIsALineOfATrace) {
  const std::string path = testing::TempDir() + "rung_runtime_trace.vcd";
  rung::Instance plc = started();
  const rung_cell cells[] = {plc.find("COUNT"), plc.find("SPEED", rung::Access::Write), plc.find("LATCHED_DOOR")};
  rung::Watch watch(plc, cells, 2);
  rung::Trace trace(watch, path);
  EXPECT_FALSE(trace.write());
  scan(plc, 2);
  EXPECT_TRUE(trace.write());
  plc.write(cells[1], 0.5);
  scan(plc, 3); // of which one has no room
  trace.end();
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), R"($version rungc $end
$timescale 1 us $end
$scope module test $end
$scope module R $end
$var wire 8 ! COUNT $end
$var real 64 " SPEED $end
$upscope $end
$scope module IN $end
$var wire 1 # LATCHED_DOOR $end
$upscope $end
$upscope $end
$enddefinitions $end
#8000
$dumpvars
b1 !
r0 "
0#
$end
#16000
b10 !
$comment 1 scans are missing here $end
#24000
b11 !
r0.5 "
#32000
b100 !
)");
  rung_trace* none = nullptr;
  EXPECT_EQ(rung_trace_new(watch.handle(), "/nowhere/trace.vcd", &none), RUNG_FAILED);
  EXPECT_EQ(rung_trace_new(watch.handle(), nullptr, &none), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_trace_new(rung::Watch(plc, cells).handle(), path.c_str(), &none), RUNG_BAD_ARGUMENT);
  std::filesystem::remove(path);
}

TEST_F(Runtime, CellsAreWatched) {
  rung::Instance plc = started();
  const rung_cell cells[] = {plc.find("COUNT"), plc.find("SPEED", rung::Access::Write), plc.find("LIMIT")};
  plc.write(cells[1], 2.5);
  rung::Watch watch(plc, cells, 3);
  EXPECT_FALSE(watch.newest());
  EXPECT_FALSE(watch.next());
  plc.slice();
  EXPECT_FALSE(watch.newest()) << "within a scan";
  scan(plc, 5);
  const auto newest = watch.newest();
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->head.scan, 5u);
  EXPECT_EQ(newest->head.now_us, 40000);
  EXPECT_EQ(newest->values[0].integer, 5);
  EXPECT_EQ(newest->values[1].real, 2.5);
  EXPECT_EQ(newest->values[2].integer, -5);
  for (const int64_t count : {1, 2, 3}) {
    const auto sample = watch.next();
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->values[0].integer, count);
  }
  EXPECT_FALSE(watch.next());
  scan(plc);
  const auto after = watch.next();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->head.scan, 6u);
  EXPECT_EQ(after->head.lost, 2u);

  const rung_cell note = plc.find("NOTE"), none = 77;
  rung_watch* wrong = nullptr;
  EXPECT_EQ(rung_watch_new(plc.handle(), &note, 1, 0, &wrong), RUNG_WRONG_TYPE);
  EXPECT_EQ(rung_watch_new(plc.handle(), &none, 1, 0, &wrong), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_watch_new(plc.handle(), cells, 0, 0, &wrong), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_watch_new(plc.handle(), cells, 1, 1'000'001, &wrong), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(rung_watch_newest(watch.handle(), nullptr, nullptr), RUNG_BAD_ARGUMENT);
  std::vector<rung::Watch> more;
  for (uint32_t i = 1; i < RUNG_MOST_WATCHES; ++i) more.emplace_back(plc, cells);
  EXPECT_EQ(rung_watch_new(plc.handle(), cells, 1, 0, &wrong), RUNG_WRONG_STATE);
}

// Bytes 0 and 8 of R count passes: no sample has two different counts, and watches may come and go meanwhile.
TEST_F(Runtime, ASampleIsOfOnePass) {
  rung::test::TestProgram counting;
  build(counting);
  counting.functions[0] = [](uint8_t* mem, rung_ctx* ctx, uint32_t) {
    ++mem[0];
    return mem[8] = mem[0], rung::test::popChunk(ctx);
  };
  counting.link();
  const rung::Image image = adopted(counting);
  rung::Instance plc(image);
  plc.powerOn();
  const rung_cell cells[] = {plc.find("COUNT"), plc.find("WORDS")};
  std::atomic<bool> stop{false};
  std::thread scanning([&] {
    while (!stop) plc.scan();
  });
  for (int round = 0; round < 50; ++round) {
    rung::Watch watch(plc, cells, 16);
    uint64_t last = 0;
    for (int seen = 0; seen < 100;) {
      const auto newest = watch.newest();
      if (!newest) continue;
      ++seen;
      ASSERT_EQ(static_cast<uint8_t>(newest->values[0].integer), static_cast<uint8_t>(newest->values[1].integer));
      while (const auto next = watch.next()) {
        ASSERT_GT(next->head.scan, last);
        ASSERT_EQ(static_cast<uint8_t>(next->head.scan), static_cast<uint8_t>(next->values[0].integer));
        last = next->head.scan;
      }
    }
  }
  stop = true;
  scanning.join();
}

TEST_F(Runtime, AfterAFaultTheFormerProgramIsPutBack) {
  rung::test::TestProgram next;
  build(next, 2);
  next.faults = {"other", "dead-loop", "division by zero"};
  next.files = {"new.pmc"};
  next.functions[0] = [](uint8_t* mem, rung_ctx* ctx, uint32_t) -> uint32_t {
    if (++mem[kCount] < 10) return rung::test::popChunk(ctx);
    ctx->fault = {0, 0, 12, 0};
    return RUNG_PC_FAULT;
  };
  next.link();
  const rung::Image image = adopted(next);
  for (const bool confirmed : {false, true}) {
    SCOPED_TRACE(confirmed);
    rung::Instance plc = started();
    uint8_t count = 0;
    plc.bindOutput("COUNT", count);
    const rung_cell words = plc.find("WORDS", rung::Access::Write);
    plc.write(words, 77);
    scan(plc, 3);
    std::optional<rung::Replacement> change;
    change.emplace(plc, image);
    ASSERT_EQ(plc.replace(*change), RUNG_OK);
    if (confirmed) change.reset();
    scan(plc, 6);
    EXPECT_EQ(count, 9);
    EXPECT_EQ(plc.scan(), RUNG_FAULTED);
    EXPECT_EQ(count, 0) << "safe";
    EXPECT_EQ(plc.state().generation, confirmed ? 1u : 2u);
    EXPECT_EQ(plc.describe(words).byte, confirmed ? 10u : 8u);
    EXPECT_EQ(plc.read<int>(words), 77);
    EXPECT_STREQ(plc.fault()->text, "other (rung 1, new.pmc:12)") << "of the new program";
    EXPECT_EQ(plc.scan(), RUNG_FAULTED) << "it waits for the reset";
    plc.powerOn(rung::Power::Cold);
    scan(plc, 12);
    EXPECT_EQ(plc.fault().has_value(), confirmed);
  }
}

TEST_F(Runtime, WhatWasPutBackByHandIsNotReplacedByAFault) {
  rung::test::TestProgram next;
  build(next, 2);
  const rung::Image image = adopted(next);
  rung::Instance plc = started();
  const rung::Replacement change(plc, image);
  for (int i = 0; i < 2; ++i) ASSERT_EQ(plc.replace(change), RUNG_OK);
  scan(plc, 200);
  EXPECT_TRUE(plc.fault());
  EXPECT_EQ(plc.state().generation, 2u);
}

// A scan thread that is given one program after the other, while others look on and look up names.
TEST_F(Runtime, ProgramsAreChangedWhileOthersLookOn) {
  constexpr int kChanges = 2000;
  std::array<rung::test::TestProgram, 4> programs;
  std::vector<rung::Image> images;
  for (uint32_t i = 0; i < programs.size(); ++i) {
    build(programs[i], 2 * i);
    programs[i].functions[0] = [](uint8_t* mem, rung_ctx* ctx, uint32_t) {
      return ++mem[0], rung::test::popChunk(ctx);
    };
    programs[i].link();
    images.push_back(adopted(programs[i]));
  }
  rung::Instance plc(images[0]);
  const rung_cell words = plc.find("WORDS", rung::Access::Write), count = plc.find("COUNT");
  plc.powerOn();
  plc.write(words, 4711);
  std::atomic<rung_replacement*> next{nullptr};
  std::atomic<int> changes{0};
  std::thread scanning([&] {
    for (uint8_t passes = 1; changes < kChanges; ++passes) {
      plc.scan();
      EXPECT_EQ(plc.read<uint8_t>(count), passes);
      EXPECT_EQ(plc.read<int>(words), 4711);
      rung_replacement* change = next.exchange(nullptr);
      if (change == nullptr) continue;
      EXPECT_EQ(rung_instance_replace(plc.handle(), change), RUNG_OK);
      ++changes;
    }
  });
  std::thread looking([&] {
    const rung_cell cells[] = {words, count};
    while (changes < kChanges) {
      rung::Watch watch(plc, cells, 4);
      for (int seen = 0; seen < 10 && changes < kChanges;)
        if (const auto sample = watch.next()) {
          EXPECT_EQ(sample->values[0].integer, 4711);
          ++seen;
        }
    }
  });
  for (int i = 1; i <= kChanges; ++i) {
    const rung::Replacement change(plc, images[static_cast<size_t>(i) % images.size()]);
    next = change.handle();
    while (changes < i) std::this_thread::yield();
  }
  scanning.join();
  looking.join();
  EXPECT_EQ(plc.state().generation, static_cast<uint32_t>(kChanges));
}

TEST_F(Runtime, RungsAreProfiled) {
  rung::Instance plain = started();
  EXPECT_EQ(statusOf([&] { plain.worstRung(); }), RUNG_WRONG_STATE);
  rung::test::TestProgram counting;
  counting.instrumented = true;
  build(counting);
  const rung::Image image = adopted(counting);
  rung::Instance plc(image);
  plc.powerOn();
  EXPECT_FALSE(plc.worstRung()) << "nothing has run";
  auto profile = rung::sized<rung_profile>();
  EXPECT_EQ(rung_instance_profile(plc.handle(), 0, &profile), RUNG_OK);
  EXPECT_EQ(rung_instance_profile(plc.handle(), 1, &profile), RUNG_EMPTY);
  plc.clearProfile();
  EXPECT_EQ(statusOf([&] { plain.clearProfile(); }), RUNG_WRONG_STATE);
}

TEST_F(Runtime, TimesOfPasses) {
  auto options = rung::sized<rung_instance_options>();
  options.flags = RUNG_MEASURE;
  rung::Instance plc = started(&options);
  scan(plc, 10);
  EXPECT_GT(plc.state().worst_ns, 0);
  EXPECT_LE(plc.state().last_ns, plc.state().worst_ns);
}

} // namespace
