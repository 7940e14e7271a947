#include "strutt/io/chart_file.hpp"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/scratch.hpp"
#include "io/npy.hpp"
#include "io/zip_layout.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

using test::content_of;
using test::message_of;
using test::ScratchDirectory;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNan = std::numeric_limits<double>::quiet_NaN();

ChartDescription description_of(std::size_t nx, std::size_t ny, std::vector<Layer> layers) {
  ChartDescription d;
  d.x = {"support.frequency", "rad/s", "support frequency"};
  d.y = {"mathieu.delta", "", "delta"};
  d.request.x = {"support.frequency", 1.0, 1.0 + 0.1 * static_cast<double>(nx - 1), nx, AxisScale::linear};
  d.request.y = {"mathieu.delta", 3.0, nx == 1 ? 3.0 : -1.0, ny, AxisScale::linear};
  if (ny == 1) d.request.y.to = 3.0;
  d.request.layers = std::move(layers);
  d.provenance = {{"program", "strutt"}, {"version", "9"}, {"date", "2001-09-09T01:46:40Z"}, {"command", "strutt chart"}};
  return d;
}

/// A value that tells layer, row and column.
double cell(Layer layer, std::size_t j, std::size_t i) {
  if (layer == Layer::verdict) return static_cast<double>((i + j) % 4);
  if (layer == Layer::outcome) return static_cast<double>((i + 2 * j) % 8);
  if (i == 0 && j == 0) return kNan;
  if (i == 1 && j == 0) return layer == Layer::discriminant ? -kInfinity : 0.1;
  return std::sqrt(static_cast<double>(2 + static_cast<int>(layer) + 10 * i + 1000 * j));
}

ChartStrip strip_of(const ChartDescription& d, std::size_t first, std::size_t rows) {
  ChartStrip strip{first, rows, d.request.x.points, {}};
  for (const Layer layer : d.request.layers) {
    auto& values = strip.values.emplace_back();
    for (std::size_t j = first; j < first + rows; ++j) {
      for (std::size_t i = 0; i < strip.columns; ++i) values.push_back(cell(layer, j, i));
    }
  }
  return strip;
}

void write_chart(const std::filesystem::path& path, const ChartDescription& d, std::size_t rows_per_strip) {
  const auto writer = make_chart_writer(path, d);
  for (std::size_t j = 0; j < d.request.y.points; j += rows_per_strip) {
    writer->write(strip_of(d, j, std::min(rows_per_strip, d.request.y.points - j)));
  }
  CHECK_FALSE(std::filesystem::exists(path));
  writer->commit();
}

const std::vector<Layer> kAll{Layer::verdict, Layer::growth, Layer::winding, Layer::discriminant, Layer::margin,
                              Layer::outcome};

/// Runs a script with Debian's Python in `directory`; false (and a warning) if the modules are not there.
bool python(const ScratchDirectory& directory, const std::string& modules, const std::string& script) {
  const std::string probe = "/usr/bin/python3 -c 'import " + modules + "' >/dev/null 2>&1";
  if (std::system(probe.c_str()) != 0) {
    WARN("skipped: /usr/bin/python3 lacks one of " << modules);
    return false;
  }
  // What cell() says, in Python.
  const std::string prelude =
      "import sys, math, json, numpy as np\n"
      "L = ['verdict', 'growth', 'winding', 'discriminant', 'margin', 'outcome']\n"
      "def cell(l, j, i):\n"
      "    if l == 'verdict': return (i + j) % 4\n"
      "    if l == 'outcome': return (i + 2 * j) % 8\n"
      "    if i == 0 and j == 0: return math.nan\n"
      "    if i == 1 and j == 0: return -math.inf if l == 'discriminant' else 0.1\n"
      "    return math.sqrt(2 + L.index(l) + 10 * i + 1000 * j)\n"
      "def check(l, a, ny, nx):\n"
      "    assert a.shape == (ny, nx), a.shape\n"
      "    assert a.dtype == (np.int8 if l in ('verdict', 'outcome') else np.float64), a.dtype\n"
      "    e = np.array([[cell(l, j, i) for i in range(nx)] for j in range(ny)])\n"
      "    assert np.array_equal(a.astype(float), e, equal_nan=True), (l, a, e)\n";
  directory.with("check.py", prelude + script);
  const std::string command = "cd '" + directory.path().string() + "' && /usr/bin/python3 check.py > log 2>&1";
  const int status = std::system(command.c_str());
  INFO(content_of(directory / "log"));
  CHECK(status == 0);
  return true;
}

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
  const auto message = message_of<InvalidInput>(
      [&] { make_chart_writer(directory / "c.npy", description_of(2, 2, {Layer::verdict, Layer::growth})); });
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
  padded.values[0].push_back(0.0);
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
  d.provenance.emplace_back("scene", std::string(1 << 18, 's'));  // a long text that goes to the heap of the file
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

TEST_CASE("NumPy reads .npy and .npz", "[io][chart_file][python]") {
  const ScratchDirectory directory;
  write_chart(directory / "c.npz", description_of(5, 7, kAll), 3);
  write_chart(directory / "one.npz", description_of(1, 1, kAll), 1);
  write_chart(directory / "g.npy", description_of(5, 7, {Layer::growth}), 3);
  write_chart(directory / "v.npy", description_of(5, 7, {Layer::verdict}), 3);
  python(directory, "numpy",
         "import zipfile\n"
         "z = np.load('c.npz')\n"
         "assert zipfile.ZipFile('c.npz').testzip() is None\n"
         "assert set(z.files) == set(L) | {'x', 'y', 'meta.json'}, z.files\n"
         "for l in L: check(l, z[l], 7, 5)\n"
         "assert z['x'].shape == (5,) and z['x'][0] == 1.0 and z['y'][-1] == -1.0\n"
         "meta = json.loads(z['meta.json'])\n"
         "assert meta['layers']['verdict']['values'] == {'stable': 0, 'unstable': 1, 'boundary': 2, 'unresolved': 3}\n"
         "assert meta['provenance']['command'] == 'strutt chart'\n"
         "assert np.load('one.npz')['verdict'].shape == (1, 1)\n"
         "check('growth', np.load('g.npy'), 7, 5)\n"
         "check('verdict', np.load('v.npy', mmap_mode='r'), 7, 5)\n");
}

TEST_CASE("an archive beyond 4 GiB uses ZIP64 fields", "[io][chart_file][python]") {
  const ScratchDirectory directory;
  const std::vector<std::string> contents{"abc", std::string(300, 'x'), "end"};
  const std::vector<std::uint32_t> crcs{0x352441C2, 0, 0};
  std::vector<ZipMember> members;
  for (const auto& content : contents) members.push_back({"m" + std::to_string(members.size()), content.size()});
  const ZipLayout layout(members, 100);  // as if 100 bytes were 4 GiB
  std::string bytes(layout.directory_offset(), '\0');
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const auto header = layout.local_header(i, crcs[i]);
    CHECK(layout.header_offset(i) + header.size() == layout.data_offset(i));
    bytes.replace(layout.header_offset(i), header.size(), header);
    bytes.replace(layout.data_offset(i), contents[i].size(), contents[i]);
  }
  directory.with("a.zip", bytes + layout.directory(crcs));
  python(directory, "zipfile",
         "import zipfile\n"
         "z = zipfile.ZipFile('a.zip')\n"
         "assert z.namelist() == ['m0', 'm1', 'm2']\n"
         "assert z.read('m0') == b'abc'\n"
         "i = z.infolist()\n"
         "assert i[1].file_size == 300 and i[2].header_offset > 300, i\n"
         "assert open('a.zip', 'rb').read().count(b'PK\\x06\\x06') == 1\n");
}

TEST_CASE("h5py reads .h5 with labelled axes", "[io][chart_file][python]") {
  const ScratchDirectory directory;
  auto d = description_of(5, 7, kAll);
  d.provenance.emplace_back("scene", std::string(100'000, 's'));
  write_chart(directory / "c.h5", d, 3);
  write_chart(directory / "one.h5", description_of(1, 1, kAll), 1);
  python(directory, "numpy,h5py",
         "import h5py\n"
         "f = h5py.File('c.h5')\n"
         "text = lambda v: v if isinstance(v, str) else v.decode()\n"
         "for l in L:\n"
         "    check(l, f[l][()], 7, 5)\n"
         "    assert f[l].dims[0][0].name == '/y' and f[l].dims[1][0].name == '/x'\n"
         "assert list(f['verdict'].attrs['flag_values']) == [0, 1, 2, 3]\n"
         "assert text(f['verdict'].attrs['flag_meanings']) == 'stable unstable boundary unresolved'\n"
         "assert text(f['x'].attrs['parameter']) == 'support.frequency'\n"
         "assert all(h5py.h5g.get_objinfo(f.id, n.encode()).mtime == 0 for n in f)\n"
         "assert text(f['x'].attrs['units']) == 'rad/s' and text(f['y'].attrs['units']) == '1'\n"
         "assert text(f.attrs['Conventions']) == 'CF-1.10'\n"
         "assert len(json.loads(text(f.attrs['provenance']))['scene']) == 100000\n"
         "assert h5py.File('one.h5')['growth'].shape == (1, 1)\n");
}

TEST_CASE("xarray reads .h5 as a labelled data set, square charts too", "[io][chart_file][python]") {
  const ScratchDirectory directory;
  write_chart(directory / "c.h5", description_of(5, 5, kAll), 2);
  python(directory, "numpy,xarray,h5netcdf",
         "import xarray\n"
         "d = xarray.open_dataset('c.h5', engine='h5netcdf', mask_and_scale=False)\n"
         "assert d['growth'].dims == ('y', 'x'), d\n"
         "assert float(d['x'][0]) == 1.0 and float(d['y'][0]) == 3.0\n"
         "check('growth', d['growth'].values, 5, 5)\n"
         "check('verdict', d['verdict'].values, 5, 5)\n"
         "assert d['x'].attrs['units'] == 'rad/s'\n"
         "assert d['growth'].sel(x=1.0, y=-1.0, method='nearest').shape == ()\n");
}

}  // namespace strutt
