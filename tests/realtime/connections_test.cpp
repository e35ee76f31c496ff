// What rung-run does with its connections in a step, while all of them are served: a server, a client whose device does
// not answer, shared memory.
#include <gtest/gtest.h>

#include <unistd.h>

#include <thread>
#include <vector>

#include "machine/io/connections/connections.h"
#include "rtlib/run/realtime.h"
#include "tests/realtime/guard.h"
#include "tests/support/faultless_map.h"

namespace rung::test {
namespace {

host::File mapOf() {
  const std::string port = std::to_string(20000 + getpid() % 10000); // two of this program run side by side
  host::File map = faultlessMap(R"([in]
a = { type = "bit", name = "X0.0" }
b = { type = "s32", name = "D0:2" }
c = { type = "float", name = "D4:4" }
ok = { type = "bit", name = "X0.7" }
[out]
d = { type = "u32", name = "D8:4" }
[modbus-server]
status = "ok"
coils = { a = 0 }
input-registers = { d = 0 }
port = )" + port + R"(
[[modbus-client]]
host = "127.0.0.1"
period = 0.001
holding-registers = { b = 0, d = 1 }
port = )" + port);
  const host::File memory =
      faultlessMap("[in]\nc = { type = \"float\", name = \"D4:4\" }\n[shared-memory]\nname = \"rt-" +
                   std::to_string(getpid()) + "\"\nperiod = 0.001\npins = { c = 0 }\n");
  host::Connection shared = memory.connections.at(0);
  shared.pins.at(0).pin = 2;
  map.connections.push_back(std::move(shared));
  return map;
}

TEST(ConnectionsInAStep, WaitForNobody) {
  const host::File map = mapOf();
  std::vector<host::Value> values(map.pins.size());
  std::vector<host::PinCell> cells;
  for (host::Value& value : values) cells.push_back({.any = &value});
  io::Connections connections(map);
  connections.writeOutputs(cells.data());
  connections.start();
  Guard guard;
  for (int i = 0; i < 200; ++i) {
    const int64_t now = runtime::monotonicNs();
    {
      const Guarded guarded(guard);
      connections.readInputs(cells.data(), now);
      values[4].u32 = static_cast<uint32_t>(i);
      connections.writeOutputs(cells.data());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(guard.offences(), "");
  connections.end();
}

} // namespace
} // namespace rung::test
