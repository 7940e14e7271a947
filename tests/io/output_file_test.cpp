#include "strutt/io/output_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <csignal>
#include <thread>

#include "io/scratch.hpp"
#include "strutt/base/error.hpp"

namespace strutt::test::output_file_test {

namespace {

using test::content_of;
using test::message_of;
using test::ScratchDirectory;

int error_number_of(const std::filesystem::path& path) {
  try {
    OutputFile file(path);
    file.write("x");
    file.commit();
  } catch (const InputOutputError& error) {
    CHECK(std::string(error.what()).find(path.filename().string()) != std::string::npos);
    return error.error_number();
  }
  return 0;
}

/// Acts as an ordinary user where the tests run as root, whom no permission stops.
class OrdinaryUser {
 public:
  OrdinaryUser() : was_root_(::geteuid() == 0) {
    if (was_root_) REQUIRE(::seteuid(65534) == 0);
  }
  ~OrdinaryUser() {
    if (was_root_ && ::seteuid(0) != 0) std::abort();
  }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
  bool was_root_;
};

}  // namespace

TEST_CASE("a result appears under its name with commit only", "[io][output_file]") {
  const ScratchDirectory directory;
  const auto path = directory / "out.csv";
  OutputFile file(path);
  file.write("a,b\n");
  CHECK_FALSE(std::filesystem::exists(path));
  CHECK(file.path().parent_path() == path.parent_path());
  file.write("1,2\n");
  file.commit();
  CHECK(content_of(path) == "a,b\n1,2\n");
  CHECK(directory.names().size() == 1);
  file.commit();  // once more does nothing
  CHECK(content_of(path) == "a,b\n1,2\n");
}

TEST_CASE("without commit nothing is left and an old result stays", "[io][output_file]") {
  const ScratchDirectory directory;
  const auto path = directory.with("out.csv", "old");
  {
    OutputFile file(path);
    file.write(std::string(1 << 20, 'x'));
  }
  CHECK(content_of(path) == "old");
  CHECK(directory.names().size() == 1);
}

TEST_CASE("bytes go where they are told", "[io][output_file]") {
  const ScratchDirectory directory;
  OutputFile file(directory / "out");
  file.write_at(6, "world");
  file.write_at(0, "hello ");
  file.commit();
  CHECK(content_of(directory / "out") == "hello world");
}

TEST_CASE("the mode of a new file follows the umask", "[io][output_file]") {
  const ScratchDirectory directory;
  const auto old = ::umask(027);
  OutputFile file(directory / "out");
  file.commit();
  ::umask(old);
  struct stat status {};
  REQUIRE(::stat((directory / "out").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("places that cannot be written are found at once", "[io][output_file][F9]") {
  const ScratchDirectory directory;
  CHECK(error_number_of(directory / "missing/out.csv") == ENOENT);
  CHECK(error_number_of(directory.path()) == EISDIR);
  directory.with("file", "x");
  CHECK(error_number_of(directory / "file/out.csv") == ENOTDIR);
  std::filesystem::create_symlink(directory / "loop", directory / "loop");
  CHECK(error_number_of(directory / "loop") == ELOOP);
  CHECK_THROWS_AS(OutputFile(""), InputOutputError);
  CHECK_THROWS_AS(OutputFile("/proc/out.csv"), InputOutputError);
}

TEST_CASE("missing permissions are found at once and the old result stays", "[io][output_file][F9]") {
  const ScratchDirectory directory;
  const auto path = directory.with("out.csv", "old");
  std::filesystem::permissions(path, std::filesystem::perms{0444});
  std::filesystem::permissions(directory.path(), std::filesystem::perms{0555});
  {
    const OrdinaryUser user;
    CHECK(error_number_of(path) == EACCES);
    CHECK(error_number_of(directory / "new.csv") == EACCES);
  }
  CHECK(content_of(path) == "old");
  std::filesystem::permissions(directory.path(), std::filesystem::perms{0777});
  {
    const OrdinaryUser user;  // may rename over the file, but its owner has protected it
    CHECK(error_number_of(path) == EACCES);
  }
  CHECK(content_of(path) == "old");
  CHECK(directory.names().size() == 1);
}

TEST_CASE("a full device is an error that names it", "[io][output_file][F7]") {
  OutputFile file("/dev/full");
  file.write("x");
  const auto message = message_of<InputOutputError>([&] { file.commit(); });
  CHECK(message == "cannot write '/dev/full': No space left on device");
  CHECK_THROWS_AS(file.write(std::string(1 << 20, 'x')), InputOutputError);
}

TEST_CASE("a file that grows too large leaves the old result", "[io][output_file][F8]") {
  const ScratchDirectory directory;
  const auto path = directory.with("out", "old");
  struct rlimit old {};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &old) == 0);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = old;
  small.rlim_cur = 1 << 16;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  int error = 0;
  try {
    OutputFile file(path);
    file.write(std::string(1 << 20, 'x'));
    file.commit();
  } catch (const InputOutputError& failure) {
    error = failure.error_number();
  }
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  CHECK(error == EFBIG);
  CHECK(content_of(path) == "old");
  CHECK(directory.names().size() == 1);
}

TEST_CASE("what is not a regular file is written directly", "[io][output_file]") {
  const ScratchDirectory directory;
  const auto pipe = directory / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::string got;
  std::thread reader([&] { got = content_of(pipe); });
  {
    OutputFile file(pipe);
    CHECK(file.path() == pipe);
    CHECK_THROWS_AS(file.write_at(0, "x"), InputOutputError);
    file.write("through the pipe");
    file.commit();
  }
  reader.join();
  CHECK(got == "through the pipe");
  CHECK(directory.names().size() == 1);
}

TEST_CASE("a closed pipe is reported as such", "[io][output_file][F15]") {
  auto* const handler = std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  OutputFile file("/dev/fd/" + std::to_string(ends[1]));
  ::close(ends[0]);
  file.write("x");
  int error = 0;
  try {
    file.commit();
  } catch (const InputOutputError& failure) {
    error = failure.error_number();
  }
  ::close(ends[1]);
  std::signal(SIGPIPE, handler);
  CHECK(error == EPIPE);
}

TEST_CASE("a redirected descriptor is continued, not begun again", "[io][output_file]") {
  const ScratchDirectory directory;
  const auto path = directory.with("log", "before ");
  const int fd = ::open(path.c_str(), O_WRONLY | O_APPEND);
  REQUIRE(fd >= 0);
  {
    OutputFile file("/dev/fd/" + std::to_string(fd));
    file.write("after");
    file.commit();
  }
  ::close(fd);
  CHECK(content_of(path) == "before after");
}

TEST_CASE("a symbolic link stays a link", "[io][output_file]") {
  const ScratchDirectory directory;
  const auto real = directory.with("real.csv", "old");
  std::filesystem::create_symlink(real, directory / "link.csv");
  OutputFile file(directory / "link.csv");
  file.write("new");
  file.commit();
  CHECK(std::filesystem::is_symlink(directory / "link.csv"));
  CHECK(content_of(real) == "new");
}

TEST_CASE("names as long as the file system allows work", "[io][output_file]") {
  const ScratchDirectory directory;
  const std::string name(255, 'n');
  OutputFile file(directory / name);
  file.write("x");
  file.commit();
  CHECK(content_of(directory / name) == "x");
}

}  // namespace strutt::test::output_file_test
