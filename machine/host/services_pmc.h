// Requests of the PMC family: windows, whose functions and codes each dialect has of its own, and the control's
// requests for PMC axis control.
#pragma once
#include "machine/host/services.h"
#include "rtlib/nc/pmc/services.h"
#include "rtlib/nc/pmc/window_functions.h"

namespace rung::host {

// A window request of a dialect, and the answers to it in the dialect's form. Constants alone implement it.
class WindowDialect {
public:
  // The arguments of a request.
  struct Window {
    const rung_request* request;
    bool write;
    uint64_t code, length, number, attribute;
    const nc::pmc::WindowFunction* function; // null: the dialect does not know the code
  };

  // PMC axis control.
  struct Axes {
    double stepsPerMm = 0;          // steps of distances and coordinates in a mm or degree
    bool rapidWithoutSpeed = false; // a rapid command of speed 0 has that of the CNC
  };

  explicit constexpr WindowDialect(const Axes& axes) : axes_(axes) {}
  const Axes& axes() const { return axes_; }

  virtual const nc::pmc::WindowFunction* find(uint64_t code) const noexcept = 0;
  // What is wrong with a request, as an end code; 0: nothing.
  virtual int64_t mistakeOf(const Window& window) const noexcept = 0;
  // The answer to a correct high-speed request from the last reported state.
  virtual rung_reply highSpeed(const Window& window, const Live& live) const noexcept = 0;
  // The quantity of a correct low-speed request; nothing: CNCs do not offer it.
  virtual std::optional<Operation> operationOf(const Window& window) const = 0;
  virtual rung_reply given(const Window& window, double value) const noexcept = 0; // to a read
  virtual rung_reply ended(const Window& window, int64_t end) const noexcept = 0;
  virtual int64_t endOf(Outcome outcome, bool write) const noexcept = 0;

protected:
  ~WindowDialect() = default;

private:
  Axes axes_;
};

class PmcTranslation final : public Translation {
public:
  // The dialect outlives it.
  explicit constexpr PmcTranslation(const WindowDialect& dialect) : dialect_(&dialect) {}

  int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept override;
  std::optional<Operation> operationOf(const rung_request& request, rung_reply& refusal) const override;
  rung_reply replyOf(const rung_request& request, const NcAnswer& answer) const override;

private:
  WindowDialect::Window windowOf(const rung_request& request) const noexcept;
  int32_t windowAtOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept;
  std::optional<Operation> moveOf(const int64_t* args) const noexcept;

  const WindowDialect* dialect_;
};

// Whether the value is one of so many signed bytes.
bool fitsBytes(double value, uint64_t bytes) noexcept;

} // namespace rung::host
