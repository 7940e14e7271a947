#pragma once

#include <cstddef>
#include <string>

#include "strutt/io/column_file.hpp"

namespace strutt {

// One writer per format; `name` is that of the target, for messages. They commit the file.
void write_csv_columns(OutputFile& file, const std::string& name, const DataTable& table);
void write_npz_columns(OutputFile& file, const std::string& name, const DataTable& table);
void write_hdf5_columns(OutputFile& file, const std::string& name, const DataTable& table);

/// The values of a column as the bytes of binary files: int8 for words, otherwise float64.
std::string column_bytes(const DataColumn& column);

/// Number of rows; columns of different length are a bug of the caller (std::logic_error).
std::size_t row_count(const DataTable& table);

}  // namespace strutt
