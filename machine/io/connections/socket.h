// A socket that is closed with its object.
#pragma once
#include <unistd.h>

#include <utility>

namespace rung::io {

class Socket {
public:
  explicit Socket(int number = -1) noexcept : number_(number) {}
  Socket(Socket&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Socket() {
    if (number_ >= 0) close(number_);
  }
  int number() const noexcept { return number_; }

private:
  int number_;
};

} // namespace rung::io
