#include <hdf5_hl.h>

#include <array>

#include "io/chart_writers.hpp"
#include "io/hdf5.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {
namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Layers as data sets with the axes attached as dimension scales: what netCDF and xarray call a labelled
/// data set.
class Hdf5Writer : public ChartWriter {
 public:
  Hdf5Writer(const std::filesystem::path& path, const ChartDescription& description)
      : output_(path),
        sink_{.name = path.string()},
        request_(description.request),
        order_(description.request) {
    hdf5::silence();
    file_ = create_file();
    describe_file(description);
    const Handle x = create_axis("x", request_.x, description.x);
    const Handle y = create_axis("y", request_.y, description.y);
    for (const Layer layer : request_.layers) layers_.push_back(create_layer(layer, x, y));
  }

  void write(const ChartStrip& strip) override {
    order_.take(strip);
    for (std::size_t l = 0; l < layers_.size(); ++l) write_layer(l, strip);
  }

  void conclude(const Provenance& done) override { write_attribute(file_, "done", json_text(done), sink_); }

  void prepare() override {
    if (prepared_) return;
    order_.finish();
    for (auto& layer : layers_) check(layer.close(), sink_);
    check(H5Fflush(file_, H5F_SCOPE_LOCAL), sink_);
    check(file_.close(), sink_);
    output_.prepare();
    prepared_ = true;
  }

  void commit() override {
    prepare();
    output_.commit();
  }

 private:
  Handle create_file() {
    const Handle access(hdf5::access_properties(sink_), H5Pclose, sink_);
    return {H5Fcreate(output_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, sink_};
  }

  void describe_file(const ChartDescription& description) const {
    const Provenance& provenance = description.provenance;
    write_attribute(file_, "Conventions", "CF-1.10", sink_);
    write_attribute(file_, "title", chart_title(description), sink_);
    write_attribute(file_, "source", entry(provenance, "program") + " " + entry(provenance, "version"),
                    sink_);
    write_attribute(file_, "history", entry(provenance, "date") + ": " + entry(provenance, "command"), sink_);
    write_attribute(file_, "provenance", json_text(provenance), sink_);
  }

  Handle create_data_set(const std::string& name, hid_t type, const std::vector<hsize_t>& shape) const {
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                       sink_);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, sink_);
    // Contiguous, and every cell is written once: no fill values beforehand.
    check(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), sink_);
    // No time of writing: the same chart is the same file. The date stands in the provenance.
    check(H5Pset_obj_track_times(properties, false), sink_);
    return {H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
            sink_};
  }

  Handle create_axis(const char* name, const Axis& axis, const ParameterInfo& info) const {
    const auto values = axis_values(axis);
    Handle set = create_data_set(name, H5T_IEEE_F64LE, {values.size()});
    check(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), sink_);
    check(H5DSset_scale(set, name), sink_);
    write_attribute(set, "parameter", axis.parameter, sink_);
    write_attribute(set, "long_name", info.label, sink_);
    write_attribute(set, "units", unit_of(info), sink_);
    write_attribute(set, "scale", axis.scale == AxisScale::logarithmic ? "log" : "linear", sink_);
    return set;
  }

  Handle create_layer(Layer layer, hid_t x, hid_t y) const {
    const hid_t type = is_categorical(layer) ? H5T_STD_I8LE : H5T_IEEE_F64LE;
    Handle set = create_data_set(std::string(to_string(layer)), type, {request_.y.points, request_.x.points});
    check(H5DSattach_scale(set, y, 0), sink_);
    check(H5DSattach_scale(set, x, 1), sink_);
    write_attribute(set, "long_name", std::string(long_name(layer)), sink_);
    if (is_categorical(layer)) {
      const auto names = category_names(layer);
      hdf5::write_flag_values(set, static_cast<int>(names.size()), sink_);
      write_attribute(set, "flag_meanings", joined(names), sink_);
    } else {
      write_attribute(set, "units", std::string(unit_of(layer)), sink_);
    }
    return set;
  }

  void write_layer(std::size_t l, const ChartStrip& strip) {
    if (strip.rows == 0) return;
    const Layer layer = request_.layers[l];
    const std::array<hsize_t, 2> start{strip.first_row, 0}, count{strip.rows, strip.columns};
    const Handle memory(H5Screate_simple(2, count.data(), nullptr), H5Sclose, sink_);
    const Handle space(H5Dget_space(layers_[l]), H5Sclose, sink_);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), sink_);
    const hid_t type = is_categorical(layer) ? H5T_NATIVE_SCHAR : H5T_NATIVE_DOUBLE;
    const auto bytes = layer_bytes(layer, strip.values[l], buffer_);
    check(H5Dwrite(layers_[l], type, memory, space, H5P_DEFAULT, bytes.data()), sink_);
  }

  OutputFile output_;
  hdf5::Sink sink_;
  ChartRequest request_;
  StripOrder order_;
  Handle file_;
  std::vector<Handle> layers_;
  std::string buffer_;
  bool prepared_ = false;
};

}  // namespace

std::unique_ptr<ChartWriter> make_hdf5_writer(const std::filesystem::path& path,
                                              const ChartDescription& description) {
  return std::make_unique<Hdf5Writer>(path, description);
}

}  // namespace strutt
