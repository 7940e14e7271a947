#pragma once

#include <hdf5.h>

#include <string>

#include "io/hdf5_driver.hpp"

namespace strutt::hdf5 {

/// Throws InputOutputError with the error that the sink has kept, else the innermost reason on the stack of
/// HDF5.
[[noreturn]] void fail(const Sink& sink);

/// An HDF5 identifier that is closed with its object. A failed close is an error only where `close` is
/// called.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Closer closer, const Sink& sink) : id_(id), closer_(closer) {
    if (id < 0) fail(sink);
  }
  ~Handle() { (void)close(); }
  Handle(Handle&& other) noexcept : id_(other.id_), closer_(other.closer_) { other.id_ = H5I_INVALID_HID; }
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      (void)close();
      id_ = other.id_;
      closer_ = other.closer_;
      other.id_ = H5I_INVALID_HID;
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }

  herr_t close() {
    const hid_t id = id_;
    id_ = H5I_INVALID_HID;
    return id < 0 ? 0 : closer_(id);
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

/// Throws unless the call succeeded and all its bytes arrived.
inline void check(herr_t result, const Sink& sink) {
  if (result < 0 || sink.error_number != 0) fail(sink);
}

/// UTF-8 text as an attribute.
void write_attribute(hid_t object, const char* name, const std::string& text, const Sink& sink);

/// The numbers 0, 1, ..., count - 1 as an attribute of type int8.
void write_flag_values(hid_t object, int count, const Sink& sink);

/// No messages on stderr from here on, in this process.
void silence();

}  // namespace strutt::hdf5
