// Chart files as the libraries of Python read them.
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>

#include "io/sample_chart.hpp"
#include "io/scratch.hpp"
#include "io/zip_layout.hpp"

namespace strutt::test::chart_in_python_test {

namespace {

using test::content_of;
using test::description_of;
using test::kAll;
using test::ScratchDirectory;
using test::write_chart;

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
  const std::string command =
      "cd '" + directory.path().string() + "' && /usr/bin/python3 check.py > log 2>&1";
  const int status = std::system(command.c_str());
  INFO(content_of(directory / "log"));
  CHECK(status == 0);
  return true;
}

}  // namespace

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
         "assert meta['layers']['verdict']['values'] == {'stable': 0, 'unstable': 1, 'boundary': 2, "
         "'unresolved': 3}\n"
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
  for (const auto& content : contents)
    members.push_back({"m" + std::to_string(members.size()), content.size()});
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

}  // namespace strutt::test::chart_in_python_test
