#pragma once

#include <hdf5.h>

#include <string>

namespace strutt::hdf5 {

/// Where HDF5's bytes go. Once a write has failed, HDF5 is told that this and all further ones succeed, and
/// the error is kept here: with a failure of its own the library can neither close the file nor leave the
/// process without a crash.
struct Sink {
  std::string name;      ///< of the target, for messages
  int error_number = 0;  ///< errno of the first failure
};

/// File access properties (to be closed by the caller) that send a file to its path by way of `sink`, which
/// must live until the file is closed.
hid_t access_properties(Sink& sink);

}  // namespace strutt::hdf5
