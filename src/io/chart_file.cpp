#include "strutt/io/chart_file.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "io/chart_writers.hpp"
#include "io/file_ending.hpp"
#include "io/text.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/outcome.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

static_assert(std::endian::native == std::endian::little, "binary charts are written as they lie in memory");

using Maker = std::unique_ptr<ChartWriter> (*)(const std::filesystem::path&, const ChartDescription&);

struct Format {
  std::string_view ending;
  Maker make;
};

constexpr Format kFormats[] = {{".csv", make_csv_writer},
                               {".npy", make_npy_writer},
                               {".npz", make_npz_writer},
                               {".h5", make_hdf5_writer},
                               {".hdf5", make_hdf5_writer}};

}  // namespace

StripOrder::StripOrder(const ChartRequest& request)
    : layers_(request.layers.size()), columns_(request.x.points), rows_(request.y.points) {}

void StripOrder::take(const ChartStrip& strip) {
  if (strip.first_row != next_row_ || strip.columns != columns_ || strip.values.size() != layers_ ||
      strip.rows > rows_ - next_row_) {
    throw std::logic_error("a strip of a chart is out of order");
  }
  for (const auto& values : strip.values) {
    if (values.size() == strip.rows * columns_) continue;
    throw std::logic_error("a strip of a chart has a wrong number of values");
  }
  next_row_ += strip.rows;
}

void StripOrder::finish() const {
  if (next_row_ != rows_) throw std::logic_error("a chart is finished before its last row");
}

std::unique_ptr<ChartWriter> make_chart_writer(const std::filesystem::path& path,
                                               const ChartDescription& description) {
  if (path == "-") return make_csv_writer("/dev/stdout", description);
  const std::string ending = ending_of(path);
  const auto* const format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                          [&](const Format& f) { return f.ending == ending; });
  if (format != std::end(kFormats)) return format->make(path, description);
  if (is_device(path)) return make_csv_writer(path, description);
  throw InvalidInput("the format of '" + printable(path.string()) +
                     "' is not known: a chart file ends with .csv, .npy, .npz, .h5 or .hdf5");
}

std::string unit_of(const ParameterInfo& info) { return info.unit.empty() ? "1" : info.unit; }

std::vector<std::string> category_names(Layer layer) {
  std::vector<std::string> names;
  if (layer == Layer::verdict) {
    for (int i = 0; i < kVerdictCount; ++i) names.emplace_back(to_string(static_cast<Verdict>(i)));
  } else if (layer == Layer::outcome) {
    for (int i = 0; i < kOutcomeCount; ++i) names.emplace_back(to_string(static_cast<Outcome>(i)));
  }
  return names;
}

std::vector<double> axis_values(const Axis& axis) {
  std::vector<double> values(axis.points);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = axis.value(i);
  return values;
}

std::int8_t category_value(double value) { return static_cast<std::int8_t>(value); }

std::size_t cell_bytes(Layer layer) { return is_categorical(layer) ? sizeof(std::int8_t) : sizeof(double); }

std::string_view layer_bytes(Layer layer, std::span<const double> values, std::string& buffer) {
  if (!is_categorical(layer))
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
  buffer.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) buffer[i] = static_cast<char>(category_value(values[i]));
  return buffer;
}

}  // namespace strutt
