#include <zlib.h>

#include "io/chart_writers.hpp"
#include "io/npy.hpp"
#include "io/zip_layout.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {

std::string npy_header(std::string_view type, const std::vector<std::size_t>& shape) {
  constexpr std::size_t alignment = 64, before_dictionary = 10;
  std::string dictionary = "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': (";
  for (std::size_t i = 0; i < shape.size(); ++i)
    dictionary += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  dictionary += shape.size() == 1 ? ",), }" : "), }";
  const std::size_t used = before_dictionary + dictionary.size() + 1;
  dictionary.append((alignment - used % alignment) % alignment, ' ');
  dictionary += '\n';
  std::string header = "\x93NUMPY";
  header += '\x01';
  header += '\x00';
  header += static_cast<char>(dictionary.size() & 0xFF);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

namespace {

std::string layer_header(Layer layer, const ChartRequest& request) {
  return npy_header(is_categorical(layer) ? "|i1" : "<f8", {request.y.points, request.x.points});
}

std::string with_suffix(const std::filesystem::path& path, const char* suffix) {
  return path.string() + suffix;
}

/// One layer, with the metadata in a file beside it.
class NpyWriter : public ChartWriter {
 public:
  NpyWriter(const std::filesystem::path& path, const ChartDescription& description)
      : file_(path),
        metadata_(with_suffix(path, ".json")),
        metadata_path_(with_suffix(path, ".json")),
        description_(description),
        layer_(description.request.layers.front()),
        order_(description.request) {
    file_.write(layer_header(layer_, description.request));
  }

  void write(const ChartStrip& strip) override {
    order_.take(strip);
    file_.write(layer_bytes(layer_, strip.values[0], buffer_));
  }

  void conclude(const Provenance& done) override { done_ = done; }

  void prepare() override {
    if (prepared_) return;
    order_.finish();
    metadata_.write(chart_metadata(description_, done_));
    file_.prepare();
    metadata_.prepare();
    prepared_ = true;
  }

  void commit() override {
    prepare();
    metadata_.commit();
    try {
      file_.commit();
    } catch (...) {
      std::error_code ignored;
      std::filesystem::remove(metadata_path_, ignored);
      throw;
    }
  }

 private:
  OutputFile file_;
  OutputFile metadata_;
  std::filesystem::path metadata_path_;
  ChartDescription description_;
  Provenance done_;
  Layer layer_;
  StripOrder order_;
  std::string buffer_;
  bool prepared_ = false;
};

/// An archive of arrays. All sizes but that of the metadata, which comes last, are known at the beginning,
/// so each strip goes to its place in every member.
class NpzWriter : public ChartWriter {
 public:
  NpzWriter(const std::filesystem::path& path, const ChartDescription& description)
      : file_(path), description_(description), request_(description.request), order_(description.request) {
    const auto x = axis_array(request_.x), y = axis_array(request_.y);
    std::vector<ZipMember> members{{"x.npy", x.size()}, {"y.npy", y.size()}};
    std::vector<std::string> headers;
    for (const Layer layer : request_.layers) {
      headers.push_back(layer_header(layer, request_));
      const std::uint64_t data = std::uint64_t{request_.x.points} * request_.y.points * cell_bytes(layer);
      members.push_back({std::string(to_string(layer)) + ".npy", headers.back().size() + data});
    }
    members_ = std::move(members);
    layout_ = ZipLayout(members_);
    crcs_.resize(layout_.count() + 1);
    written_.resize(layout_.count() + 1);
    append(0, x);
    append(1, y);
    for (std::size_t l = 0; l < headers.size(); ++l) append(kFirstLayer + l, headers[l]);
  }

  void write(const ChartStrip& strip) override {
    order_.take(strip);
    for (std::size_t l = 0; l < request_.layers.size(); ++l) {
      append(kFirstLayer + l, layer_bytes(request_.layers[l], strip.values[l], buffer_));
    }
  }

  void conclude(const Provenance& done) override { done_ = done; }

  void prepare() override {
    if (prepared_) return;
    order_.finish();
    const auto metadata = chart_metadata(description_, done_);
    members_.push_back({"meta.json", metadata.size()});
    layout_ = ZipLayout(members_);  // what was written before stays where it is
    append(members_.size() - 1, metadata);
    for (std::size_t m = 0; m < layout_.count(); ++m) {
      file_.write_at(layout_.header_offset(m), layout_.local_header(m, crcs_[m]));
    }
    file_.write_at(layout_.directory_offset(), layout_.directory(crcs_));
    file_.prepare();
    prepared_ = true;
  }

  void commit() override {
    prepare();
    file_.commit();
  }

 private:
  static constexpr std::size_t kFirstLayer = 2;

  static std::string axis_array(const Axis& axis) {
    const auto values = axis_values(axis);
    return npy_header("<f8", {values.size()}) +
           std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }

  void append(std::size_t member, std::string_view bytes) {
    file_.write_at(layout_.data_offset(member) + written_[member], bytes);
    written_[member] += bytes.size();
    const auto* const data = reinterpret_cast<const Bytef*>(bytes.data());
    crcs_[member] = static_cast<std::uint32_t>(crc32_z(crcs_[member], data, bytes.size()));
  }

  OutputFile file_;
  ChartDescription description_;
  Provenance done_;
  ChartRequest request_;
  StripOrder order_;
  std::vector<ZipMember> members_;
  ZipLayout layout_{{}};
  std::vector<std::uint32_t> crcs_;
  std::vector<std::uint64_t> written_;
  std::string buffer_;
  bool prepared_ = false;
};

}  // namespace

std::unique_ptr<ChartWriter> make_npy_writer(const std::filesystem::path& path,
                                             const ChartDescription& description) {
  if (description.request.layers.size() != 1) {
    throw InvalidInput("a .npy file holds one layer, not " +
                       std::to_string(description.request.layers.size()) +
                       ": choose one, or write a .npz file");
  }
  return std::make_unique<NpyWriter>(path, description);
}

std::unique_ptr<ChartWriter> make_npz_writer(const std::filesystem::path& path,
                                             const ChartDescription& description) {
  return std::make_unique<NpzWriter>(path, description);
}

}  // namespace strutt
