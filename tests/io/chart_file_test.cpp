#include "strutt/io/chart_file.hpp"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/npy.hpp"
#include "io/sample_chart.hpp"
#include "io/scratch.hpp"
#include "strutt/base/error.hpp"

namespace strutt::test::chart_file_test {

namespace {

using test::cell;
using test::content_of;
using test::description_of;
using test::kAll;
using test::message_of;
using test::ScratchDirectory;
using test::strip_of;
using test::write_chart;

double double_at(const std::string& bytes, std::size_t at) {
  double value = 0.0;
  REQUIRE(at + sizeof value <= bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Makes files that pass 64 KiB fail as on a full disk.
class SmallDisk {
 public:
  SmallDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &old_) == 0);
    rlimit small = old_;
    small.rlim_cur = 1 << 16;
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  struct rlimit old_ {};
  void (*handler_)(int);
};

}  // namespace

TEST_CASE("a chart as CSV", "[io][chart_file]") {
  const ScratchDirectory directory;
  const auto d = description_of(2, 2, {Layer::verdict, Layer::growth, Layer::outcome});
  write_chart(directory / "c.csv", d, 1);
  CHECK(content_of(directory / "c.csv") ==
        "# program: strutt\n# version: 9\n# date: 2001-09-09T01:46:40Z\n# command: strutt chart\n"
        "# units: rad/s,1,,1,\n"
        "support.frequency,mathieu.delta,verdict,growth,outcome\n"
        "1,3,stable,nan,converged\n1.1,3,unstable,0.1,tolerance_not_reached\n"
        "1,-1,unstable,31.670175244226233,step_limit\n1.1,-1,boundary,31.827660925679098,time_limit\n");
}

TEST_CASE("strips of any height give the same files", "[io][chart_file]") {
  const ScratchDirectory directory;
  const std::string ending = GENERATE(".csv", ".npz", ".npy");
  const auto d = description_of(5, 7, ending == ".npy" ? std::vector{Layer::margin} : kAll);
  write_chart(directory / ("a" + ending), d, 1);
  write_chart(directory / ("b" + ending), d, 3);
  write_chart(directory / ("c" + ending), d, 7);
  const auto a = content_of(directory / ("a" + ending));
  CHECK(a.size() > 100);
  CHECK(a == content_of(directory / ("b" + ending)));
  CHECK(a == content_of(directory / ("c" + ending)));
}

TEST_CASE("NPY: header of version 1.0, aligned, then the cells", "[io][chart_file]") {
  const ScratchDirectory directory;
  const auto d = description_of(3, 2, {Layer::growth});
  write_chart(directory / "c.npy", d, 2);
  const auto bytes = content_of(directory / "c.npy");
  CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  CHECK(bytes.substr(10, 60).starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"));
  REQUIRE(bytes.size() == 128 + 6 * 8);
  CHECK(bytes[127] == '\n');
  CHECK(std::isnan(double_at(bytes, 128)));
  CHECK(double_at(bytes, 128 + 8) == 0.1);
  CHECK(double_at(bytes, 128 + 5 * 8) == cell(Layer::growth, 1, 2));
  const auto metadata = nlohmann::json::parse(content_of(directory / "c.npy.json"));
  CHECK(metadata["x"]["parameter"] == "support.frequency");
  CHECK(metadata["x"]["unit"] == "rad/s");
  CHECK(metadata["y"]["from"] == 3.0);
  CHECK(metadata["layers"]["growth"]["unit"] == "1");
  CHECK(metadata["provenance"]["program"] == "strutt");
}

TEST_CASE("NPY headers are aligned for every shape", "[io][chart_file]") {
  for (const std::size_t n : {0UL, 1UL, 10UL, 1000UL, 100'000'000UL, 18'446'744'073'709'551'615UL}) {
    CHECK(npy_header("<f8", {n, n}).size() % 64 == 0);
    CHECK(npy_header("|i1", {n}).size() % 64 == 0);
  }
}

TEST_CASE("several layers do not go into .npy", "[io][chart_file]") {
  const ScratchDirectory directory;
  const auto message = message_of<InvalidInput>([&] {
    make_chart_writer(directory / "c.npy", description_of(2, 2, {Layer::verdict, Layer::growth}));
  });
  CHECK(message.find(".npz") != std::string::npos);
  CHECK(directory.names().empty());
}

TEST_CASE("endings that are not known are refused", "[io][chart_file]") {
  const ScratchDirectory directory;
  for (const std::string name : {"c.txt", "c", "c.png", "csv", ".csv"}) {
    CHECK_THROWS_AS(make_chart_writer(directory / name, description_of(2, 2, kAll)), InvalidInput);
  }
  CHECK(make_chart_writer(directory / "C.HDF5", description_of(2, 2, kAll)) != nullptr);
  CHECK(directory.names().empty());
}

TEST_CASE("a writer that is not committed leaves nothing", "[io][chart_file]") {
  const ScratchDirectory directory;
  const std::string name = GENERATE("c.csv", "c.npy", "c.npz", "c.h5");
  const auto old = directory.with(name, "old");
  const auto d = description_of(4, 4, {Layer::growth});
  {
    const auto writer = make_chart_writer(directory / name, d);
    writer->write(strip_of(d, 0, 2));
  }
  CHECK(content_of(old) == "old");
  CHECK(directory.names().size() == 1);
}

TEST_CASE("strips out of order are a bug that is seen", "[io][chart_file]") {
  const ScratchDirectory directory;
  const std::string name = GENERATE("c.csv", "c.npy", "c.npz", "c.h5");
  const auto d = description_of(4, 4, {Layer::growth});
  const auto writer = make_chart_writer(directory / name, d);
  CHECK_THROWS_AS(writer->write(strip_of(d, 1, 1)), std::logic_error);
  auto padded = strip_of(d, 0, 3);
  padded.layers[0].push_back(0.0);
  padded.values[0] = padded.layers[0];
  CHECK_THROWS_AS(writer->write(padded), std::logic_error);
  writer->write(strip_of(d, 0, 3));
  CHECK_THROWS_AS(writer->write(strip_of(d, 3, 2)), std::logic_error);
  CHECK_THROWS_AS(writer->commit(), std::logic_error);
}

TEST_CASE("a strip with values beyond its rows is a bug that is seen", "[io][chart_file]") {
  const ScratchDirectory directory;
  const std::string name = GENERATE("c.csv", "c.npy", "c.npz", "c.h5");
  const auto writer = make_chart_writer(directory / name, description_of(4, 4, {Layer::growth}));
  auto strip = strip_of(description_of(4, 4, {Layer::growth}), 0, 4);
  strip.rows = 3;
  CHECK_THROWS_AS(writer->write(strip), std::logic_error);
}

TEST_CASE("a place that cannot be written is found before anything is computed", "[io][chart_file][F9]") {
  const ScratchDirectory directory;
  const std::string name = GENERATE("c.csv", "c.npy", "c.npz", "c.h5");
  CHECK_THROWS_AS(make_chart_writer(directory / "missing" / name, description_of(2, 2, {Layer::growth})),
                  InputOutputError);
}

TEST_CASE("a full device is an input/output error", "[io][chart_file][F7]") {
  const auto d = description_of(2, 2, {Layer::growth});
  const auto writer = make_chart_writer("/dev/full", d);
  writer->write(strip_of(d, 0, 2));
  CHECK_THROWS_AS(writer->commit(), InputOutputError);
}

TEST_CASE("a full disk leaves the old result and nothing else", "[io][chart_file][F7]") {
  const ScratchDirectory directory;
  const std::string name = GENERATE("c.csv", "c.npy", "c.npz", "c.h5");
  const auto path = directory.with(name, "old");
  const auto d = description_of(200, 200, {Layer::growth});
  int error = 0;
  {
    const SmallDisk disk;
    try {
      const auto writer = make_chart_writer(path, d);
      for (std::size_t j = 0; j < 200; j += 20) writer->write(strip_of(d, j, 20));
      writer->commit();
    } catch (const InputOutputError& failure) {
      error = failure.error_number();
    }
  }
  CHECK(error == EFBIG);
  CHECK(content_of(path) == "old");
  CHECK(directory.names().size() == 1);
}

TEST_CASE("the disk is full when HDF5 writes its last bytes", "[io][chart_file][F7]") {
  const ScratchDirectory directory;
  auto d = description_of(5, 5, {Layer::growth});
  d.provenance.emplace_back("scene",
                            std::string(1 << 18, 's'));  // a long text that goes to the heap of the file
  {
    const SmallDisk disk;
    CHECK_THROWS_AS(
        [&] {
          const auto writer = make_chart_writer(directory / "c.h5", d);
          writer->write(strip_of(d, 0, 5));
          writer->commit();
        }(),
        InputOutputError);
  }
  CHECK(directory.names().empty());
  write_chart(directory / "c.h5", d, 5);  // and the library is as good as before
}

}  // namespace strutt::test::chart_file_test
