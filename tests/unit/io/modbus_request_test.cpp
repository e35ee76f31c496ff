// Requests as bytes: how long a message is, and what a wrong one is answered.
#include "machine/io/connections/modbus_image.h"

#include <gtest/gtest.h>

#include <vector>

namespace rung::io {
namespace {

using host::Area;
using Bytes = std::vector<uint8_t>;

// With its header.
Bytes message(const Bytes& pdu) {
  Bytes bytes = {0, 1, 0, 0, 0, static_cast<uint8_t>(pdu.size() + 1), 1};
  bytes.insert(bytes.end(), pdu.begin(), pdu.end());
  return bytes;
}

Exception problemOf(const Bytes& pdu) {
  Request request;
  return parseRequest(message(pdu), request);
}

TEST(ModbusMessage, IsAsLongAsItsHeaderSays) {
  EXPECT_EQ(messageLength(Bytes{0, 1, 0, 0, 0}), 0u);
  EXPECT_EQ(messageLength(Bytes{0, 1, 0, 0, 0, 6}), 12u);
  EXPECT_EQ(messageLength(Bytes{0, 1, 0, 0, 0, 254}), 260u);
  EXPECT_EQ(messageLength(message({3, 0, 0, 0, 1})), 12u);
}

TEST(ModbusMessage, OfAnotherProtocolIsNone) {
  for (const Bytes& bytes :
       {Bytes{0, 1, 0, 1, 0, 6}, Bytes{0, 1, 1, 0, 0, 6}, Bytes{0, 1, 0, 0, 0, 0}, Bytes{0, 1, 0, 0, 0, 1},
        Bytes{0, 1, 0, 0, 0, 255}, Bytes{0, 1, 0, 0, 1, 2}, message({0x83, 2})})
    EXPECT_FALSE(messageLength(bytes));
}

TEST(ModbusRequest, SaysWhatIsRead) {
  Request request;
  EXPECT_EQ(parseRequest(message({4, 1, 2, 0, 125}), request), Exception::None);
  EXPECT_EQ(request.area, Area::InputRegister);
  EXPECT_FALSE(request.writes);
  EXPECT_EQ(request.first, 0x102u);
  EXPECT_EQ(request.count, 125u);
}

TEST(ModbusRequest, SaysWhatIsWritten) {
  Request request;
  const Bytes two = message({16, 0, 5, 0, 2, 4, 1, 2, 3, 4}), one = message({6, 0, 5, 7, 8});
  EXPECT_EQ(parseRequest(two, request), Exception::None);
  EXPECT_EQ(request.area, Area::HoldingRegister);
  EXPECT_TRUE(request.writes);
  EXPECT_EQ(request.first, 5u);
  EXPECT_EQ(request.count, 2u);
  EXPECT_EQ(Bytes(request.values.begin(), request.values.end()), (Bytes{1, 2, 3, 4}));
  EXPECT_EQ(parseRequest(one, request), Exception::None);
  EXPECT_EQ(Bytes(request.values.begin(), request.values.end()), (Bytes{7, 8}));
}

TEST(ModbusRequest, OfEveryWrongKindHasItsException) {
  EXPECT_EQ(problemOf({7}), Exception::Function);
  EXPECT_EQ(problemOf({23, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0}), Exception::Function);
  EXPECT_EQ(problemOf({3}), Exception::Value);
  EXPECT_EQ(problemOf({3, 0, 0, 0}), Exception::Value);
  EXPECT_EQ(problemOf({3, 0, 0, 0, 1, 0}), Exception::Value);
  EXPECT_EQ(problemOf({3, 0, 0, 0, 0}), Exception::Value);
  EXPECT_EQ(problemOf({3, 0, 0, 0, 126}), Exception::Value);
  EXPECT_EQ(problemOf({3, 0xFF, 0xFF, 0, 2}), Exception::Address);
  EXPECT_EQ(problemOf({3, 0xFF, 0xFF, 0, 1}), Exception::None);
  EXPECT_EQ(problemOf({1, 0, 0, 0x07, 0xD1}), Exception::Value);
  EXPECT_EQ(problemOf({5, 0, 0, 0xFF, 1}), Exception::Value);
  EXPECT_EQ(problemOf({15, 0, 0, 0, 9, 1, 0}), Exception::Value);
  EXPECT_EQ(problemOf({15, 0, 0, 0, 9, 2, 0, 0}), Exception::None);
  EXPECT_EQ(problemOf({16, 0, 0, 0, 1, 2, 0}), Exception::Value);
  EXPECT_EQ(problemOf({16, 0, 0, 0, 1}), Exception::Value);
}

} // namespace
} // namespace rung::io
