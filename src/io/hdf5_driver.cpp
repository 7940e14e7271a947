#include "io/hdf5_driver.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>

namespace strutt::hdf5 {
namespace {

/// What the access properties carry; HDF5 copies it byte by byte.
struct DriverInfo {
  Sink* sink = nullptr;
};

/// The open file; begins with what HDF5 keeps about every file.
struct File {
  H5FD_t base{};
  int fd = -1;
  Sink* sink = nullptr;
  haddr_t allocated = 0;  // end of the addresses in use
  haddr_t size = 0;       // end of what was written
};

File& file_of(H5FD_t* file) { return *reinterpret_cast<File*>(file); }
const File& file_of(const H5FD_t* file) { return *reinterpret_cast<const File*>(file); }

void keep_error(File& file, int error) {
  if (file.sink->error_number == 0) file.sink->error_number = error;
}

// The callbacks of the driver; HDF5 is C, so nothing may be thrown.
extern "C" {

static H5FD_t* strutt_h5_open(const char* name, unsigned, hid_t access, haddr_t) {
  const auto* const info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  auto file = std::unique_ptr<File>(new (std::nothrow) File);
  if (!file) return nullptr;
  file->sink = info->sink;
  file->fd = ::open(name, O_RDWR | O_CLOEXEC);
  if (file->fd < 0) {
    keep_error(*file, errno);
    return nullptr;
  }
  return &file.release()->base;
}

static herr_t strutt_h5_close(H5FD_t* base) {
  const std::unique_ptr<File> file(&file_of(base));
  if (::close(file->fd) != 0 && errno != EINTR) keep_error(*file, errno);
  return 0;
}

static herr_t strutt_h5_query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

static haddr_t strutt_h5_get_eoa(const H5FD_t* file, H5FD_mem_t) { return file_of(file).allocated; }

static herr_t strutt_h5_set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  file_of(file).allocated = address;
  return 0;
}

static haddr_t strutt_h5_get_eof(const H5FD_t* file, H5FD_mem_t) { return file_of(file).size; }

static herr_t strutt_h5_read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
  File& file = file_of(base);
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t got = ::pread(file.fd, to, size, static_cast<off_t>(address));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) keep_error(file, errno);
    if (got <= 0) {  // beyond the end: zeros, as HDF5 expects
      std::fill_n(to, size, '\0');
      return 0;
    }
    to += got;
    address += static_cast<haddr_t>(got);
    size -= static_cast<size_t>(got);
  }
  return 0;
}

static herr_t strutt_h5_write(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, size_t size,
                              const void* buffer) {
  File& file = file_of(base);
  const auto* from = static_cast<const char*>(buffer);
  file.size = std::max<haddr_t>(file.size, address + size);
  while (size > 0 && file.sink->error_number == 0) {
    const ssize_t done = ::pwrite(file.fd, from, size, static_cast<off_t>(address));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) {
      keep_error(file, done < 0 ? errno : ENOSPC);
      break;
    }
    from += done;
    address += static_cast<haddr_t>(done);
    size -= static_cast<size_t>(done);
  }
  return 0;
}

static herr_t strutt_h5_truncate(H5FD_t* base, hid_t, hbool_t) {
  File& file = file_of(base);
  if (file.size == file.allocated) return 0;
  if (file.sink->error_number == 0 && ::ftruncate(file.fd, static_cast<off_t>(file.allocated)) != 0) {
    keep_error(file, errno);
  }
  file.size = file.allocated;
  return 0;
}

}  // extern "C"

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(H5FD_RESERVED + 100);
#endif
  driver.name = "strutt";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max());
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = strutt_h5_open;
  driver.close = strutt_h5_close;
  driver.query = strutt_h5_query;
  driver.get_eoa = strutt_h5_get_eoa;
  driver.set_eoa = strutt_h5_set_eoa;
  driver.get_eof = strutt_h5_get_eof;
  driver.read = strutt_h5_read;
  driver.write = strutt_h5_write;
  driver.truncate = strutt_h5_truncate;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), driver.fl_map);
  return driver;
}

}  // namespace

hid_t access_properties(Sink& sink) {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = H5FDregister(&driver);
  const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
  const DriverInfo info{&sink};
  if (properties < 0 || id < 0 || H5Pset_driver(properties, id, &info) < 0 ||
      H5Pset_fclose_degree(properties, H5F_CLOSE_STRONG) < 0) {
    if (properties >= 0) H5Pclose(properties);
    return H5I_INVALID_HID;
  }
  return properties;
}

}  // namespace strutt::hdf5
