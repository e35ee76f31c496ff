// The objects of a simulated unit or drive, and its answers to SDO requests for them (CiA 301).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "machine/io/can/sdo.h"

namespace rung::sim::technol {

enum class ObjectAccess : uint8_t { ReadWrite, ReadOnly, WriteOnly };

struct CanObject {
  io::sdo::Object place;
  uint32_t bytes = 4; // 1, 2, 4
  uint32_t value = 0;
  ObjectAccess access = ObjectAccess::ReadOnly;
};

class CanObjects {
public:
  // `noSubindex`: the code of an abort where the index has other subindices.
  explicit CanObjects(uint32_t noSubindex) : noSubindex_(noSubindex) {}
  // In place of one that is there.
  void add(const CanObject& object);
  const CanObject* find(io::sdo::Object place) const;
  uint32_t value(io::sdo::Object place) const;
  // Nothing happens where there is no such object.
  void set(io::sdo::Object place, uint32_t value);

  // The answer to a request; `written` is the object that it wrote, or null.
  io::CanPacket answer(uint32_t node, const io::CanPacket& request, const CanObject*& written);

private:
  CanObject* find(io::sdo::Object place);
  uint32_t missing(uint16_t index) const;

  uint32_t noSubindex_;
  std::vector<CanObject> objects_;
};

} // namespace rung::sim::technol
