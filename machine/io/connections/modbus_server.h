// A Modbus TCP server: clients read the outputs and write the inputs of a connection. Clients that send incomplete
// messages, flood the server or do not read its answers do not affect other clients.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

#include <modbus.h>

#include "machine/host/socket.h"
#include "machine/io/connections/connections.h"
#include "machine/io/connections/modbus_image.h"

namespace rung::io {

class ModbusServer final : public Service {
public:
  // Listens from now on. Throws std::runtime_error if that is not possible.
  ModbusServer(const host::Connection& connection, Exchange& exchange);
  void run(const std::atomic<bool>& ending) noexcept override;

private:
  struct Client {
    host::Socket socket;
    int64_t heardNs = 0;    // time of the last complete message, or of the beginning of the current one
    int64_t refilledNs = 0; // when `allowance` was last increased
    double allowance = 1;   // number of requests that may be answered now
    size_t size = 0;        // received bytes of the current message
    bool ended = false;
    std::array<uint8_t, kLongestMessage> bytes{};
  };
  struct Free {
    void operator()(modbus_t* context) const noexcept { modbus_free(context); }
  };

  void turn();
  int waitFor() const;
  void accept(int64_t now);
  void makeRoom(int64_t now);
  void serve(Client& client, int events, int64_t now); // `events`: of poll
  void refill(Client& client, int64_t now) const;
  void receive(Client& client, int64_t now);
  bool hasMessage(const Client& client) const;
  void answer(Client& client, int64_t now);
  bool reply(const Client& client, int length, int64_t now);
  void published(bool wrote, int64_t now);

  uint32_t mostClients_;
  double requestsPerNs_;
  double burst_; // largest number of requests answered at once
  Exchange& exchange_;
  ModbusImage image_;
  std::unique_ptr<modbus_t, Free> context_;
  host::Listener listening_;
  std::list<Client> clients_;
  int64_t writtenNs_ = 0;
};

} // namespace rung::io
