#include "strutt/io/column_file.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "io/scratch.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/table.hpp"

namespace strutt::test::column_file_test {

namespace {

using test::content_of;
using test::message_of;
using test::ScratchDirectory;

DataTable table_of_three() {
  return {.title = "a test",
          .columns = {{"curve", "1", "number", {}, {0.0, 0.0, 1.0}},
                      {"kind", "", "what it is", {"red", "green"}, {1.0, 1.0, 0.0}},
                      {"angle", "rad", "where it is", {}, {0.1, -1.0 / 3.0, 1e-300}}},
          .provenance = {{"program", "strutt"}, {"version", "9"}, {"command", "strutt test"}}};
}

void write(const std::filesystem::path& path, const DataTable& table) { ColumnFile(path).write(table); }

/// Runs a check in Debian's Python; false if it lacks the modules.
bool python(const ScratchDirectory& directory, const std::string& modules, const std::string& script) {
  if (std::system(("/usr/bin/python3 -c 'import " + modules + "' >/dev/null 2>&1").c_str()) != 0) {
    WARN("skipped: /usr/bin/python3 lacks one of " << modules);
    return false;
  }
  directory.with("check.py", "import " + modules + "\n" + script);
  const std::string command =
      "cd '" + directory.path().string() + "' && /usr/bin/python3 check.py > log 2>&1";
  const int status = std::system(command.c_str());
  INFO(content_of(directory / "log"));
  CHECK(status == 0);
  return true;
}

}  // namespace

TEST_CASE("columns as CSV: provenance, units, names, words, numbers to the bit", "[io][column_file]") {
  const ScratchDirectory scratch;
  write(scratch / "a.CSV", table_of_three());
  CHECK(content_of(scratch / "a.CSV") ==
        "# program: strutt\n# version: 9\n# command: strutt test\n# units: 1,,rad\ncurve,kind,angle\n"
        "0,green,0.1\n0,green,-0.3333333333333333\n1,red,1e-300\n");
}

TEST_CASE("columns as NPZ are read by NumPy", "[io][column_file][python]") {
  const ScratchDirectory scratch;
  write(scratch / "a.npz", table_of_three());
  python(scratch, "json, numpy, zipfile", R"(
assert zipfile.ZipFile('a.npz').testzip() is None
a = numpy.load('a.npz')
assert sorted(a.files) == ['angle', 'curve', 'kind', 'meta.json'], a.files
assert a['kind'].dtype == numpy.int8 and list(a['kind']) == [1, 1, 0]
assert a['angle'].dtype == numpy.float64 and list(a['angle']) == [0.1, -1/3, 1e-300]
assert list(a['curve']) == [0, 0, 1]
meta = json.loads(bytes(a['meta.json']))
assert meta['title'] == 'a test' and meta['provenance']['command'] == 'strutt test'
assert meta['columns']['kind']['values'] == {'red': 0, 'green': 1}
assert meta['columns']['angle']['unit'] == 'rad'
)");
}

TEST_CASE("columns as HDF5 are read by h5py", "[io][column_file][python]") {
  const ScratchDirectory scratch;
  write(scratch / "a.h5", table_of_three());
  python(scratch, "json, h5py", R"(
text = lambda value: value.decode() if isinstance(value, bytes) else str(value)
f = h5py.File('a.h5')
assert sorted(f) == ['angle', 'curve', 'kind']
assert list(f['angle'][:]) == [0.1, -1/3, 1e-300] and text(f['angle'].attrs['units']) == 'rad'
assert text(f['angle'].attrs['long_name']) == 'where it is'
assert f['kind'].dtype == 'int8' and list(f['kind'][:]) == [1, 1, 0]
assert text(f['kind'].attrs['flag_meanings']) == 'red green' and list(f['kind'].attrs['flag_values']) == [0, 1]
assert text(f.attrs['title']) == 'a test' and json.loads(f.attrs['provenance'])['version'] == '9'
)");
}

TEST_CASE("a table of columns without rows has a header only", "[io][column_file]") {
  const ScratchDirectory scratch;
  auto table = table_of_three();
  for (auto& column : table.columns) column.values.clear();
  write(scratch / "a.csv", table);
  CHECK(content_of(scratch / "a.csv").ends_with("curve,kind,angle\n"));
  for (const char* name : {"a.npz", "a.h5"}) CHECK_NOTHROW(write(scratch / name, table));
}

TEST_CASE("a file of columns is refused before anything is written, or is not kept",
          "[io][column_file][misuse]") {
  const ScratchDirectory scratch;
  CHECK(message_of<InvalidInput>([&] { ColumnFile(scratch / "a.npy"); }).find(".csv, .npz, .h5") !=
        std::string::npos);
  CHECK_THROWS_AS(ColumnFile(scratch / "none/a.csv"), InputOutputError);
  { const ColumnFile unwritten(scratch / "a.csv"); }
  auto ragged = table_of_three();
  ragged.columns.back().values.pop_back();
  for (const char* name : {"a.csv", "a.npz", "a.h5"})
    CHECK_THROWS_AS(write(scratch / name, ragged), std::logic_error);
  CHECK(scratch.names().empty());
}

TEST_CASE("a full device is an error of every format", "[io][column_file]") {
  CHECK_THROWS_AS(write("/dev/full", table_of_three()), InputOutputError);
}

}  // namespace strutt::test::column_file_test
