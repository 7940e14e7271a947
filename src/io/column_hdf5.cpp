#include "io/chart_writers.hpp"
#include "io/column_writers.hpp"
#include "io/hdf5.hpp"

namespace strutt {
namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::Sink;
using hdf5::write_attribute;

void describe_file(hid_t file, const DataTable& table, const Sink& sink) {
  const Provenance& provenance = table.provenance;
  write_attribute(file, "Conventions", "CF-1.10", sink);
  write_attribute(file, "title", table.title, sink);
  write_attribute(file, "source", entry(provenance, "program") + " " + entry(provenance, "version"), sink);
  write_attribute(file, "history", entry(provenance, "date") + ": " + entry(provenance, "command"), sink);
  write_attribute(file, "provenance", json_text(provenance), sink);
}

void write_column(hid_t file, const DataColumn& column, const Sink& sink) {
  const bool words = !column.categories.empty();
  const hsize_t rows = column.values.size();
  const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, sink);
  Handle set(H5Dcreate2(file, column.name.c_str(), words ? H5T_STD_I8LE : H5T_IEEE_F64LE, space, H5P_DEFAULT,
                        H5P_DEFAULT, H5P_DEFAULT),
             H5Dclose, sink);
  const std::string bytes = column_bytes(column);
  check(H5Dwrite(set, words ? H5T_NATIVE_SCHAR : H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                 bytes.data()),
        sink);
  write_attribute(set, "long_name", column.long_name, sink);
  if (words) {
    std::string meanings;
    for (const auto& word : column.categories) meanings += (meanings.empty() ? "" : " ") + word;
    hdf5::write_flag_values(set, static_cast<int>(column.categories.size()), sink);
    write_attribute(set, "flag_meanings", meanings, sink);
  } else {
    write_attribute(set, "units", column.unit, sink);
  }
  check(set.close(), sink);
}

}  // namespace

void write_hdf5_columns(OutputFile& output, const std::string& name, const DataTable& table) {
  row_count(table);
  hdf5::silence();
  Sink sink{.name = name};
  const Handle access(hdf5::access_properties(sink), H5Pclose, sink);
  Handle file(H5Fcreate(output.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, sink);
  describe_file(file, table, sink);
  for (const auto& column : table.columns) write_column(file, column, sink);
  check(H5Fflush(file, H5F_SCOPE_LOCAL), sink);
  check(file.close(), sink);
  output.commit();
}

}  // namespace strutt
