// libFuzzer target: any bytes as what a client sends to a server of Modbus TCP. What is taken of them libmodbus carries
// out: it neither reads nor writes beyond what there is, changes inputs alone, and answers at once.
#include <sys/socket.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "ir/support/check.h"
#include "machine/host/socket.h"
#include "machine/io/connections/modbus_image.h"
#include "tests/support/faultless_map.h"

namespace {

using namespace rung;
using namespace rung::io;

host::File mapOf() {
  return test::faultlessMap(R"([in]
run = { type = "bit", name = "X0.0" }
door = { type = "bit", name = "X0.1" }
speed = { type = "s32", name = "D0:2" }
turns = { type = "u32", name = "D4:4" }
load = { type = "float", name = "D8:4" }
[out]
lamp = { type = "bit", name = "Y0.0" }
level = { type = "s32", name = "D0:2" }
[modbus-server]
coils = { run = 0, door = 1, lamp = 2 }
[modbus-server.holding-registers]
speed = 0
turns = { at = 1, format = "u32", order = "low-first" }
load = { at = 3, format = "f32", order = "high-first" }
level = 5
)");
}

struct Server {
  Server() {
    int ends[2] = {};
    RUNG_CHECK(socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "there are sockets");
    near = host::Socket(ends[0]);
    far = host::Socket(ends[1]);
    modbus_set_socket(context, near.number());
  }

  host::File map = mapOf();
  Exchange exchange{map, map.connections.at(0)};
  ModbusImage image{exchange};
  modbus_t* context = modbus_new_tcp(nullptr, 502);
  host::Socket near, far;
};

// A whole answer to the transaction of the request.
void checkAnswer(const Server& server, std::span<const uint8_t> message) {
  uint8_t answer[kLongestMessage + 1];
  const ssize_t size = recv(server.far.number(), answer, sizeof answer, MSG_DONTWAIT);
  RUNG_CHECK(size >= 9 && messageLength({answer, 6}) == static_cast<size_t>(size), "an answer is whole");
  RUNG_CHECK(std::memcmp(answer, message.data(), 4) == 0, "an answer has the number of its request");
}

void serve(Server& server, std::span<const uint8_t> message) {
  Request request;
  Exception wrong = parseRequest(message, request);
  if (wrong == Exception::None) wrong = server.image.check(request);
  const auto length = static_cast<int>(message.size());
  if (wrong != Exception::None) {
    modbus_reply_exception(server.context, message.data(), static_cast<unsigned>(wrong));
  } else {
    RUNG_CHECK(modbus_reply(server.context, message.data(), length, server.image.tables()) > 0, "it is carried out");
    RUNG_CHECK(server.image.tables()->tab_bits[2] == 0 && server.image.tables()->tab_registers[5] == 0,
               "outputs are not written");
    for (const double value : server.image.inputs()) RUNG_CHECK(std::abs(value) <= 1e39, "inputs are numbers");
  }
  checkAnswer(server, message);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static Server server;
  std::vector<uint8_t> bytes(data, data + size); // of its own size, for the sanitizer
  std::span<const uint8_t> rest(bytes);
  for (;;) {
    const std::optional<size_t> length = messageLength(rest.first(std::min(rest.size(), kLongestMessage)));
    if (!length || *length == 0 || *length > rest.size()) return 0;
    const std::vector<uint8_t> message(rest.begin(), rest.begin() + static_cast<int64_t>(*length));
    serve(server, message);
    rest = rest.subspan(*length);
  }
}
