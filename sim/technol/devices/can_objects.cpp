// Objects and SDO (see can_objects.h).
#include "sim/technol/devices/can_objects.h"

#include <algorithm>

namespace rung::sim::technol {

namespace sdo = io::sdo;

void CanObjects::add(const CanObject& object) {
  if (CanObject* const old = find(object.place))
    *old = object;
  else
    objects_.push_back(object);
}

CanObject* CanObjects::find(sdo::Object place) {
  const auto found =
      std::find_if(objects_.begin(), objects_.end(), [&](const CanObject& object) { return object.place == place; });
  return found == objects_.end() ? nullptr : &*found;
}

const CanObject* CanObjects::find(sdo::Object place) const {
  const auto found =
      std::find_if(objects_.begin(), objects_.end(), [&](const CanObject& object) { return object.place == place; });
  return found == objects_.end() ? nullptr : &*found;
}

uint32_t CanObjects::value(sdo::Object place) const {
  const CanObject* const object = find(place);
  return object == nullptr ? 0 : object->value;
}

void CanObjects::set(sdo::Object place, uint32_t value) {
  if (CanObject* const object = find(place)) object->value = value;
}

uint32_t CanObjects::missing(uint16_t index) const {
  const bool known = std::any_of(objects_.begin(), objects_.end(),
                                 [&](const CanObject& object) { return object.place.index == index; });
  return known ? noSubindex_ : sdo::kNoSuchObject;
}

io::CanPacket CanObjects::answer(uint32_t node, const io::CanPacket& request, const CanObject*& written) {
  written = nullptr;
  const sdo::Object place = sdo::object(request);
  CanObject* const object = find(place);
  const bool reads = sdo::command(request) == sdo::kRead;
  if (!reads && !sdo::isWrite(request)) return sdo::abort(node, place, sdo::kUnknownCommand);
  if (object == nullptr) return sdo::abort(node, place, missing(place.index));
  if (reads && object->access == ObjectAccess::WriteOnly) return sdo::abort(node, place, sdo::kWriteOnly);
  if (reads) return sdo::answer(node, place, object->bytes, object->value);
  if (object->access == ObjectAccess::ReadOnly) return sdo::abort(node, place, sdo::kReadOnly);
  if (sdo::bytes(request) != object->bytes) return sdo::abort(node, place, sdo::kWrongLength);
  object->value = io::numberAt(request.data + 4, object->bytes);
  written = object;
  return sdo::written(node, place);
}

} // namespace rung::sim::technol
