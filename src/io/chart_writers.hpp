#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strutt/io/chart_file.hpp"

namespace strutt {

// One writer per format, each in the file chart_<format>.cpp.
std::unique_ptr<ChartWriter> make_csv_writer(const std::filesystem::path& path,
                                             const ChartDescription& description);
std::unique_ptr<ChartWriter> make_npy_writer(const std::filesystem::path& path,
                                             const ChartDescription& description);
std::unique_ptr<ChartWriter> make_npz_writer(const std::filesystem::path& path,
                                             const ChartDescription& description);
std::unique_ptr<ChartWriter> make_hdf5_writer(const std::filesystem::path& path,
                                              const ChartDescription& description);

/// Sees that strips come in order of rows and cover the chart; anything else is a bug of the caller
/// (std::logic_error).
class StripOrder {
 public:
  explicit StripOrder(const ChartRequest& request);
  void take(const ChartStrip& strip);
  void finish() const;

 private:
  std::size_t layers_;
  std::size_t columns_;
  std::size_t rows_;
  std::size_t next_row_ = 0;
};

/// All values of an axis.
std::vector<double> axis_values(const Axis& axis);

/// The value of a categorical cell as the small integer of binary files.
std::int8_t category_value(double value);

/// A row or more of a layer as the bytes of binary files: int8 for categorical layers (through `buffer`),
/// otherwise float64. Little-endian, like every machine this is built for.
std::string_view layer_bytes(Layer layer, std::span<const double> values, std::string& buffer);

/// Bytes of one cell of the layer in binary files.
std::size_t cell_bytes(Layer layer);

/// `support.frequency`, `rad/s` and so on, names of categories, provenance, and what was done, as JSON text.
std::string chart_metadata(const ChartDescription& description, const Provenance& done);

/// What the chart shows, in words; takes the entries `title` or `model` of the provenance if there are any.
std::string chart_title(const ChartDescription& description);

/// What the layer holds, in words.
std::string_view long_name(Layer layer);

/// The entry of this name, or an empty text.
std::string entry(const Provenance& provenance, std::string_view name);

}  // namespace strutt
