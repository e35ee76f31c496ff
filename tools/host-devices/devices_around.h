// The real devices of a machine around a program: who answers its requests, and when cells are read and written.
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "rtlib/runtime/surroundings.h"
#include "tools/device-requests/com_requests.h"
#include "tools/device-requests/device_order.h"
#include "tools/device-requests/ethercat_requests.h"
#include "tools/devices/com/port.h"
#include "tools/devices/ethercat/state_requests.h"
#include "tools/devices/shared/shared_areas.h"
#include "tools/host-devices/axis_service.h"
#include "tools/host-devices/can_service.h"
#include "tools/host-devices/table_service.h"

namespace rung::host_devices {

// All devices; they outlive the program.
struct Devices {
  devices::SharedAreas areas;
  std::array<devices::com::Port, devices::com::kMostPorts> ports;
  CanService can;
  TableService tables;
  AxisService axes;
  devices::ethercat::Master* master = &devices::ethercat::noMaster();
  bool programStartsMaster = false; // EtherCATOPViaPLC
  std::atomic<bool> areasBroken{false};
};

class DevicesAround final : public runtime::Surroundings {
public:
  // They have the devices of a program of this dialect, whose first one is `program`.
  DevicesAround(Devices& devices, const rung_program& program);

  nc::Control& control() override { return *control_; }
  const nc::Control& control() const override { return *control_; }
  uint32_t works() const override;
  void powerOn(host::Instance& instance, nc::PowerOn kind) override;
  void beforePart(host::Instance& instance) override;
  void afterPart(host::Instance& instance) override;
  void onHook(host::Instance& instance, uint32_t work) override;
  void onFault(host::Instance& instance) override;
  bool respond(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) override;
  std::unique_ptr<nc::Places> locate(const rung_program& program) const override;
  void exchangePlaces(std::unique_ptr<nc::Places>& places) noexcept override;

private:
  struct Places;
  bool answer(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply);
  devices::com::Port* portOf(const device_requests::DeviceCall& call); // null: there is none of this number
  bool askTable(device_requests::TableOrder order, device_requests::DeviceCall& call);
  bool noteArea(const device_requests::DeviceCall& call); // that has been answered
  void beforeInput(host::Instance& instance);
  void tickMaster(const rt::Memory& memory);
  const Places& places() const;

  Devices& devices_;
  std::unique_ptr<nc::Control> control_;
  std::unique_ptr<nc::Places> places_; // of the program that runs
  device_requests::AnswerBytes bytes_;
  device_requests::EthercatCalls ethercat_;
  devices::ethercat::StateRequests states_;
  devices::ethercat::StateBits stateBits_;
};

} // namespace rung::host_devices
