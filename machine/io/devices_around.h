// The real devices of a machine around a program: who answers its requests, and when cells are read and written.
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "machine/io/axes/axis_service.h"
#include "machine/io/can/can_service.h"
#include "machine/io/com/com_requests.h"
#include "machine/io/com/port.h"
#include "machine/io/device_order.h"
#include "machine/io/ethercat/ethercat_requests.h"
#include "machine/io/ethercat/state_requests.h"
#include "machine/io/shared/shared_areas.h"
#include "machine/io/tables/table_service.h"
#include "rtlib/api/surroundings.h"

namespace rung::io {

// All devices; they outlive the program.
struct Devices {
  SharedAreas areas;
  std::array<com::Port, com::kMostPorts> ports;
  CanService can;
  TableService tables;
  AxisService axes;
  ethercat::Master* master = &ethercat::noMaster();
  bool programStartsMaster = false; // EtherCATOPViaPLC
  std::atomic<bool> areasBroken{false};
};

class DevicesAround final : public api::Surroundings {
public:
  // They have the devices of a program of this dialect, whose first one is `program`.
  DevicesAround(Devices& devices, const rung_program& program);

  nc::Control& control() override { return *control_; }
  const nc::Control& control() const override { return *control_; }
  uint32_t works() const override;
  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override;
  void beforePart(runtime::Instance& instance) override;
  void afterPart(runtime::Instance& instance) override;
  void onHook(runtime::Instance& instance, uint32_t work) override;
  void onFault(runtime::Instance& instance) override;
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;
  std::unique_ptr<nc::Places> locate(const rung_program& program) const override;
  void exchangePlaces(std::unique_ptr<nc::Places>& places) noexcept override;

private:
  struct Places;
  bool answer(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);
  com::Port* portOf(const DeviceCall& call); // null: there is none of this number
  bool askTable(TableOrder order, DeviceCall& call);
  bool noteArea(const DeviceCall& call); // that has been answered
  void beforeInput(runtime::Instance& instance);
  void tickMaster(const core::Memory& memory);
  const Places& places() const;

  Devices& devices_;
  std::unique_ptr<nc::Control> control_;
  std::unique_ptr<nc::Places> places_; // of the program that runs
  AnswerBytes bytes_;
  EthercatCalls ethercat_;
  ethercat::StateRequests states_;
  ethercat::StateBits stateBits_;
};

} // namespace rung::io
