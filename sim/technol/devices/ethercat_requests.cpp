// Requests of the simulated EtherCAT master (see ethercat_requests.h).
#include "sim/technol/devices/ethercat_requests.h"

#include <algorithm>

namespace rung::sim::technol {

EthercatRequest* EthercatRequests::add(const io::ethercat::Station& station, EthercatRequest::Kind kind,
                                       std::span<const uint8_t> data) {
  const auto free = std::ranges::find(slots_, 0u, &EthercatRequest::ticket);
  if (free == slots_.end()) return nullptr;
  if (++lastTicket_ == 0) ++lastTicket_;
  free->kind = kind;
  free->station = station;
  free->ticket = lastTicket_;
  free->ageMs = 0;
  free->isDone = free->isForgotten = false;
  free->code = 0;
  free->size = static_cast<uint32_t>(data.size());
  std::copy_n(data.begin(), std::min(data.size(), free->data.size()), free->data.begin());
  order_[count_++] = static_cast<uint8_t>(free - slots_.begin());
  return &*free;
}

const EthercatRequest* EthercatRequests::find(uint32_t ticket) const {
  if (ticket == 0) return nullptr;
  const auto found = std::ranges::find(slots_, ticket, &EthercatRequest::ticket);
  return found == slots_.end() ? nullptr : &*found;
}

void EthercatRequests::forget(uint32_t ticket) {
  if (ticket == 0) return;
  const auto found = std::ranges::find(slots_, ticket, &EthercatRequest::ticket);
  if (found != slots_.end()) found->isForgotten = true;
  dropForgotten();
}

void EthercatRequests::finish(EthercatRequest& request, uint32_t code) {
  request.isDone = true;
  request.code = code;
}

void EthercatRequests::dropForgotten() {
  uint32_t left = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    EthercatRequest& request = slots_[order_[i]];
    if (request.isDone && request.isForgotten)
      request.ticket = 0;
    else
      order_[left++] = order_[i];
  }
  count_ = left;
}

void EthercatRequests::clear() {
  for (EthercatRequest& request : slots_) request.ticket = 0;
  count_ = 0;
}

} // namespace rung::sim::technol
