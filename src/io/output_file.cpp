#include "strutt/io/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <random>
#include <string>

#include "io/text.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr std::size_t kLongestName = 255;
constexpr int kAttempts = 100;

/// The descriptor N that `path` names as /dev/fd/N, /proc/self/fd/N or /dev/stdout, -1 for other paths. Such
/// a name must not be opened anew: a second opening of a redirected file would begin at its start again.
int named_descriptor(const std::filesystem::path& path) {
  const std::string text = path.lexically_normal().string();
  if (text == "/dev/stdout") return STDOUT_FILENO;
  if (text == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view prefix : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!text.starts_with(prefix)) continue;
    int number = -1;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + prefix.size(), end, number);
    if (error == std::errc{} && stop == end) return number;
  }
  return -1;
}

std::string random_suffix(std::random_device& source) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::string result;
  for (int i = 0; i < 6; ++i) result += letters[source() % letters.size()];
  return result;
}

}  // namespace

struct OutputFile::State {
  std::filesystem::path target;     // as given, for messages
  std::filesystem::path final;      // what the temporary becomes: the target behind symbolic links
  std::filesystem::path temporary;  // empty when the target is written directly
  int fd = -1;
  std::string buffer;
  std::uint64_t position = 0;  // of the first byte in the buffer
  bool prepared = false;

  explicit State(const std::filesystem::path& path) : target(path), final(path) { open(); }
  ~State();

  [[noreturn]] void fail(const char* what, int error) const {
    throw InputOutputError(std::string(what) + " '" + printable(target.string()) + "'", error);
  }
  void open();
  void open_directly(int named);
  void open_temporary();
  void put(std::uint64_t offset, std::string_view bytes);
  void flush();
  void prepare();
  void sync_directory() const;
  void close();
};

OutputFile::State::~State() {
  if (fd >= 0) ::close(fd);
  if (!temporary.empty()) ::unlink(temporary.c_str());
}

void OutputFile::State::open() {
  if (target.empty()) throw InputOutputError("cannot write to a file without a name", ENOENT);
  if (const int named = named_descriptor(target); named >= 0) return open_directly(named);
  struct stat status {};
  if (::stat(target.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail("cannot write", EISDIR);
    if (!S_ISREG(status.st_mode)) return open_directly(-1);
    // The directory alone decides whether a rename works; a write-protected result is meant to stay.
    if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail("cannot write", errno);
    std::error_code ignored;
    const auto resolved = std::filesystem::canonical(target, ignored);
    if (!ignored) final = resolved;
  } else if (errno != ENOENT) {
    fail("cannot write", errno);
  }
  open_temporary();
}

void OutputFile::State::open_directly(int named) {
  fd = named >= 0 ? ::fcntl(named, F_DUPFD_CLOEXEC, 3)
                  : ::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (fd < 0) fail("cannot write", errno);
}

void OutputFile::State::open_temporary() {
  std::random_device source;
  const std::string name = final.filename().string();
  if (name.empty() || name == "." || name == "..") fail("cannot write", EISDIR);
  // Length of ".", "." and the suffix is 8; a longer stem would not be a legal name.
  const std::string stem = "." + name.substr(0, kLongestName - 8) + ".";
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto path = final.parent_path() / (stem + random_suffix(source));
    do {
      fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (fd < 0 && errno == EINTR);
    if (fd >= 0) {
      temporary = path;
      return;
    }
    if (errno != EEXIST) break;
  }
  fail("cannot write", errno);
}

void OutputFile::State::put(std::uint64_t offset, std::string_view bytes) {
  prepared = false;
  while (!bytes.empty()) {
    const ssize_t done = temporary.empty()
                             ? ::write(fd, bytes.data(), bytes.size())
                             : ::pwrite(fd, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("cannot write", errno);
    if (done == 0) fail("cannot write", ENOSPC);
    offset += static_cast<std::uint64_t>(done);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::State::flush() {
  put(position, buffer);
  position += buffer.size();
  buffer.clear();
}

void OutputFile::State::prepare() {
  if (prepared) return;
  flush();
  int result = 0;
  do {
    result = ::fsync(fd);
  } while (result != 0 && errno == EINTR);
  // Pipes, terminals and the like cannot be synchronised: that is no error of theirs.
  const bool unsupported = errno == EINVAL || errno == EROFS || errno == ENOTSUP;
  if (result != 0 && !(temporary.empty() && unsupported)) fail("cannot write", errno);
  prepared = true;
}

void OutputFile::State::close() {
  const int open_fd = fd;
  fd = -1;
  // EINTR: Linux has closed the descriptor all the same, and everything was synchronised before.
  if (::close(open_fd) != 0 && errno != EINTR) fail("cannot close", errno);
}

void OutputFile::State::sync_directory() const {
  const auto parent = final.parent_path();
  const int directory = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;  // A directory that may be written but not read: the rename itself has happened.
  const int result = ::fsync(directory);
  const int error = errno;
  ::close(directory);
  if (result != 0 && error != EINVAL && error != EINTR) fail("cannot synchronise the directory of", error);
}

OutputFile::OutputFile(const std::filesystem::path& target) : state_(std::make_unique<State>(target)) {}
OutputFile::~OutputFile() = default;
OutputFile::OutputFile(OutputFile&&) noexcept = default;

void OutputFile::write(std::string_view bytes) {
  state_->buffer += bytes;
  if (state_->buffer.size() >= kBufferBytes) state_->flush();
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  if (state_->temporary.empty()) state_->fail("cannot write in any order to", ESPIPE);
  state_->put(offset, bytes);
}

void OutputFile::prepare() { state_->prepare(); }

void OutputFile::commit() {
  State& state = *state_;
  if (state.fd < 0) return;
  state.prepare();
  state.close();
  if (state.temporary.empty()) return;
  if (::rename(state.temporary.c_str(), state.final.c_str()) != 0) state.fail("cannot write", errno);
  state.temporary.clear();
  state.sync_directory();
}

const std::filesystem::path& OutputFile::path() const {
  return state_->temporary.empty() ? state_->target : state_->temporary;
}

}  // namespace strutt
