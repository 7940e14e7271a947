#include "io/hdf5.hpp"

#include <numeric>
#include <vector>

#include "io/text.hpp"
#include "strutt/base/error.hpp"

namespace strutt::hdf5 {
namespace {

extern "C" herr_t strutt_innermost_reason(unsigned depth, const H5E_error2_t* error, void* data) {
  if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(data) = error->desc;
  return 0;
}

/// A fixed-length text must fit into an object header of 64 KiB; longer ones live on the heap of the file.
constexpr std::size_t kLongestFixedText = 32000;

Handle text_type(std::size_t size, const Sink& sink) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, sink);
  check(H5Tset_size(type, size), sink);
  check(H5Tset_cset(type, H5T_CSET_UTF8), sink);
  return type;
}

void write_scalar(hid_t object, const char* name, hid_t type, const void* data, const Sink& sink) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, sink);
  Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, sink);
  check(H5Awrite(attribute, type, data), sink);
  check(attribute.close(), sink);
}

}  // namespace

void fail(const Sink& sink) {
  const std::string what = "cannot write '" + printable(sink.name) + "'";
  if (sink.error_number != 0) throw InputOutputError(what, sink.error_number);
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, strutt_innermost_reason, &reason);
  throw InputOutputError(what + " (HDF5: " + printable(reason) + ")", 0);
}

void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

void write_attribute(hid_t object, const char* name, const std::string& text, const Sink& sink) {
  if (text.size() > kLongestFixedText) {
    const Handle type = text_type(H5T_VARIABLE, sink);
    const char* const data = text.c_str();
    write_scalar(object, name, type, &data, sink);
  } else {
    // At least one byte: a text of length 0 is no HDF5 type.
    write_scalar(object, name, text_type(text.size() + 1, sink), text.c_str(), sink);
  }
}

void write_flag_values(hid_t object, int count, const Sink& sink) {
  std::vector<signed char> values(static_cast<std::size_t>(count));
  std::iota(values.begin(), values.end(), static_cast<signed char>(0));
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, sink);
  Handle attribute(H5Acreate2(object, "flag_values", H5T_STD_I8LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                   sink);
  check(H5Awrite(attribute, H5T_NATIVE_SCHAR, values.data()), sink);
  check(attribute.close(), sink);
}

}  // namespace strutt::hdf5
